// Which diagonal splits a cell of posts into its two triangles: the one place that says so, for whatever
// asks.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/terrain/floor_within.h"
#include "core/terrain/post_grid.h"

namespace oro {

// From the north-west post to the south-east one, or from the south-west to the north-east one.
enum class Diagonal : unsigned char { nw_se, sw_ne };

// A cell's two triangles: that with the cell's western edge and that with its eastern one.
//     nw_se: west = north-west, south-west, south-east     east = north-west, south-east, north-east
//     sw_ne: west = north-west, south-west, north-east     east = south-west, south-east, north-east
// Anticlockwise, seen from above; by offsets (row, column) from the cell's north-west post. The shaders
// number them 0 and 1 (shaders/place/place.glsl).
using CellCorners = std::array<std::array<int, 2>, 3>;
[[nodiscard]] constexpr CellCorners cell_corners(Diagonal diagonal, bool west) {
    if (diagonal == Diagonal::nw_se)
        return west ? CellCorners{{{0, 0}, {1, 0}, {1, 1}}} : CellCorners{{{0, 0}, {1, 1}, {0, 1}}};
    return west ? CellCorners{{{0, 0}, {1, 0}, {0, 1}}} : CellCorners{{{1, 0}, {1, 1}, {0, 1}}};
}
// How far a place, (down, right) of the north-west post in 0 .. 1, is on the western triangle's side of the
// diagonal: in cells, across.
[[nodiscard]] constexpr double west_of_diagonal(Diagonal diagonal, double down, double right) {
    return diagonal == Diagonal::nw_se ? down - right : 1.0 - down - right;
}

// A triangle's plane in (down, right): h = at_corner + down * change_down + right * change_right.
struct CellPlane {
    double at_corner;
    double change_down;
    double change_right;
};
// The plane of a triangle of a cell with all four posts.
[[nodiscard]] constexpr CellPlane cell_plane(Diagonal diagonal, bool west, double north_west,
                                             double north_east, double south_west, double south_east) {
    if (diagonal == Diagonal::nw_se)
        return west ? CellPlane{north_west, south_west - north_west, south_east - south_west}
                    : CellPlane{north_west, south_east - north_east, north_east - north_west};
    return west ? CellPlane{north_west, south_west - north_west, north_east - north_west}
                : CellPlane{south_west - (south_east - north_east), south_east - north_east,
                            south_east - south_west};
}

// H of a post in whole steps of 2^-11 m, so that what is decided is the same everywhere.
inline constexpr std::int32_t no_decisive_steps = INT32_MIN;  // of a post without a height
[[nodiscard]] inline std::int32_t decisive_steps(float H_m) {
    if (is_void(H_m)) return no_decisive_steps;
    constexpr double steps_per_m = 2048.0, limit = 1 << 30;
    return floor_within(static_cast<double>(H_m) * steps_per_m + 0.5, limit);
}

// One row of the 4 x 4 posts around a cell, weighted; no_weighed_steps where one has no height. Source of the
// weights -1, 9, 9, -1 of 16, a smooth surface through posts half way between them: R. Keys, Cubic
// convolution interpolation for digital image processing, IEEE Transactions on Acoustics, Speech, and Signal
// Processing 29(6), 1981.
inline constexpr std::int64_t no_weighed_steps = INT64_MIN;
[[nodiscard]] constexpr std::int64_t weighed_steps(std::int32_t a, std::int32_t b, std::int32_t c,
                                                   std::int32_t d) {
    if (a == no_decisive_steps || b == no_decisive_steps || c == no_decisive_steps || d == no_decisive_steps)
        return no_weighed_steps;
    return 9 * (std::int64_t{b} + c) - a - d;
}

// The diagonal whose middle is nearer to that of the smooth surface through the 4 x 4 posts around a cell;
// is nw_se where both are as near, and where a post has no height. weighed: of the four rows, from the north;
// the others are the cell's own posts. In whole numbers: exact.
[[nodiscard]] constexpr Diagonal nearer_diagonal(const std::array<std::int64_t, 4>& weighed,
                                                 std::int32_t north_west, std::int32_t north_east,
                                                 std::int32_t south_west, std::int32_t south_east) {
    for (const std::int64_t row : weighed)
        if (row == no_weighed_steps) return Diagonal::nw_se;
    // All three as 256 times the height in the middle: below 2^40.
    const std::int64_t smooth = 9 * (weighed[1] + weighed[2]) - weighed[0] - weighed[3];
    const std::int64_t nw_se = 128 * (std::int64_t{north_west} + south_east) - smooth;
    const std::int64_t sw_ne = 128 * (std::int64_t{north_east} + south_west) - smooth;
    return (sw_ne < 0 ? -sw_ne : sw_ne) < (nw_se < 0 ? -nw_se : nw_se) ? Diagonal::sw_ne : Diagonal::nw_se;
}

// The diagonal of a cell by its north-west post, where the posts' H come from steps(row, column), which are
// asked -1 .. 2 from there on: decisive_steps(), or no_decisive_steps outside the region.
template <class Steps>
[[nodiscard]] Diagonal diagonal_of(const Steps& steps, int row, int column) {
    std::array<std::array<std::int32_t, 4>, 4> posts{};
    std::array<std::int64_t, 4> weighed{};
    for (int i = 0; i < 4; ++i) {
        auto& own = posts[static_cast<std::size_t>(i)];
        for (int j = 0; j < 4; ++j) {
            own[static_cast<std::size_t>(j)] = steps(row + i - 1, column + j - 1);
            if (own[static_cast<std::size_t>(j)] == no_decisive_steps) return Diagonal::nw_se;
        }
        weighed[static_cast<std::size_t>(i)] = weighed_steps(own[0], own[1], own[2], own[3]);
    }
    return nearer_diagonal(weighed, posts[1][1], posts[1][2], posts[2][1], posts[2][2]);
}

// decisive_steps() of the region's post, which may be one beyond its rim: where a region goes round the Earth
// the posts go on round it. Posts that are one point have one H. masked: by post, 1 where it decides
// nothing.
[[nodiscard]] std::int32_t decisive_steps_at(const HeightField& field, int row, int column,
                                             const std::vector<char>* masked = nullptr);
// The diagonal of a cell of the full resolution.
[[nodiscard]] Diagonal cell_diagonal(const HeightField& field, int row, int column,
                                     const std::vector<char>* masked = nullptr);

}  // namespace oro
