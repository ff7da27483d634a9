// Meshes over a region's posts, whoever made them, and how far they lie from the posts that they leave out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/terrain/drawn_heights.h"

namespace oro {

struct MeshPost {
    int row{};
    int column{};
    friend bool operator==(const MeshPost&, const MeshPost&) = default;
};
// Corners clockwise on the map: twice_area() is positive.
using MeshTriangle = std::array<MeshPost, 3>;

// Regions up to so many posts along an axis: with them all products below, and the in-circle test of a
// triangulation, are exact in 64 bits.
inline constexpr int most_mesh_posts = 16384;

// Twice the area of a triangle, in cells; negative when it runs the other way round, 0 for three in a line.
[[nodiscard]] constexpr std::int64_t twice_area(const MeshPost& a, const MeshPost& b, const MeshPost& c) {
    return static_cast<std::int64_t>(b.column - a.column) * (c.row - a.row) -
           static_cast<std::int64_t>(b.row - a.row) * (c.column - a.column);
}

// The post in a triangle (its edges included) that is farthest from its plane, vertically in metres; 0 for a
// triangle that all its posts lie on, at one of its corners. Exact but for one rounding. No post may be void.
struct WorstPost {
    double error_m{};
    MeshPost post;
};
[[nodiscard]] WorstPost worst_post(const DrawnHeights& heights, const MeshTriangle& triangle);

// The place of a triangle, its edges included, that is farthest from the full resolution, vertically in
// metres: a post, or where an edge of the triangle crosses an edge of the grid (a row, a column, or a cell's
// diagonal), which is between two posts. The triangle is at least as far off at one of these as it is
// anywhere. Within 1e-6 m. No post may be void.
struct WorstPlace {
    double error_m{};
    MeshPost from;
    MeshPost to;  // the same for a post
};
[[nodiscard]] WorstPlace worst_place(const DrawnHeights& heights, const MeshTriangle& triangle);

// A mesh held against every post by brute force, apart from what made it: each post in each triangle's
// bounding box is asked whether it lies in the triangle, and how far from its plane.
struct MeshCheck {
    double largest_error_m{};
    std::size_t posts_beyond{};     // found in a triangle farther than error_m from it
    std::size_t posts_uncovered{};  // in no triangle
};
// Triangles either way round, none without an area; no post may be void.
[[nodiscard]] MeshCheck check_mesh(const DrawnHeights& heights, std::span<const MeshTriangle> mesh,
                                   double error_m);

}  // namespace oro
