// How far a node's triangles lie from the region's full-resolution surface: exact maxima, no estimates.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/terrain/level_grid.h"
#include "core/terrain/page.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Edges of a node by number: north, east, south, west; edge i is bit i of shaders/choose/levels.glsl.
using PerEdge = std::array<double, 4>;

// Largest difference, metres, between a node's triangles and the full-resolution surface. Infinite where the
// node's triangles do not cover the same area, because of voids.
struct NodeDeviation {
    double own_m{};        // of the node as it is
    PerEdge stitched_m{};  // of the triangles that are there when that edge is stitched to a coarser
                           // neighbour, whatever the other edges are; 0 for an edge without a neighbour. (A
                           // triangle that needs two stitched edges counts for one of them.)
    bool empty{};          // no triangle, neither the node's nor of the full resolution
};
inline constexpr double unfit_m = std::numeric_limits<double>::infinity();

// The deviations of one level's nodes. Reads `heights` where it is; safe to ask from several threads.
class NodeDeviations {
  public:
    NodeDeviations(const PostGrid& grid, const DrawnHeights& heights, int level);

    // In height, both surfaces linear over their triangles in (row, column): over every place, not only the
    // posts (the corners of the difference are the posts and where the node's edges cross those of the full
    // resolution, in the middles of cells, too, that are split across a quad's diagonal; all are asked).
    // Exact; never too small where the region ends within a quad.
    [[nodiscard]] NodeDeviation height_deviation(int node_row, int node_column) const;
    // Upper bound of the distance in space between a point of the full-resolution surface (flat triangles
    // between posts) and the point of the drawn node at the same (row, column); the rounding of the drawn
    // posts' places included. 0 for level 0 as it is.
    [[nodiscard]] NodeDeviation deviation(int node_row, int node_column) const;
    // The same where stitched_m of some edges alone (as edges()) is asked for; the others may have less.
    [[nodiscard]] NodeDeviation deviation(int node_row, int node_column, std::uint32_t asked_edges) const;
    // Edges (shaders/choose/levels.glsl) on which a node has a neighbour. Round the Earth the last column's
    // is the first.
    [[nodiscard]] std::uint32_t edges(int node_row, int node_column) const;

    // Triangle of a node, by (row, column) within it, that is there only with some edges stitched, and where
    // its quad is split so.
    struct Stitched {
        std::uint32_t edges;
        std::array<std::uint32_t, 2> quad;
        Diagonal diagonal;
        std::array<std::array<std::uint32_t, 2>, 3> posts;
    };
    // All of a node of so many rows and columns of quads, for any of these edges.
    [[nodiscard]] static std::vector<Stitched> stitched_triangles(std::uint32_t rows, std::uint32_t columns,
                                                                  std::uint32_t edges);

  private:
    // One corner of a triangle, by its number in the region.
    struct Post {
        int row;
        int column;
    };
    using Triangle = std::array<Post, 3>;
    enum class Cover { full, empty, equal, unequal };
    struct Quad {
        Cover cover;
        double deviation_steps;
    };
    struct PostRange {
        double lowest;
        double highest;
        bool any_void;
    };
    // Largest in a row of nodes: of M + h, (N + h) cos(lat), |sin(lat)|, cos(lat).
    struct Curvature {
        double M_m;
        double r_m;
        double sine;
        double cosine;
    };
    struct Sag {
        double own_m;
        double stitched_m;
        double finest_m;
        double placement_m;
    };

    [[nodiscard]] double triangle_deviation(const Triangle& triangle) const;
    [[nodiscard]] double crossing_deviation(const Post& from, const Post& to) const;
    // A quad by its posts in the region, and its own diagonal.
    struct QuadPosts {
        int north, west, south, east;
        Diagonal diagonal;
        [[nodiscard]] bool square() const { return south - north == east - west; }
    };
    [[nodiscard]] CellPlane plane_of(const QuadPosts& quad, bool is_west) const;
    [[nodiscard]] Quad quad_deviation(int row, int column) const;
    [[nodiscard]] Quad square_quad_deviation(const QuadPosts& quad) const;
    [[nodiscard]] Quad pair_deviation(const QuadPosts& quad) const;
    [[nodiscard]] bool all_void(const QuadPosts& quad) const;
    [[nodiscard]] Quad quad_with_voids(const QuadPosts& quad) const;
    [[nodiscard]] double narrow_quad_deviation(const QuadPosts& quad) const;
    [[nodiscard]] double middles_deviation(const QuadPosts& quad) const;
    [[nodiscard]] static std::uint32_t unfit_edges(const std::array<Cover, 64>& covers, int rows,
                                                   int columns);
    [[nodiscard]] PerEdge stitched_deviation(int node_row, int node_column, std::uint32_t edges,
                                             std::uint32_t asked_edges) const;
    [[nodiscard]] PerEdge finest_stitched_deviation(int node_row, int node_column) const;
    // range: post_range().
    [[nodiscard]] NodeDeviation height_deviation(int node_row, int node_column, const PostRange& range,
                                                 std::uint32_t asked_edges) const;
    [[nodiscard]] PostRange post_range(int node_row, int node_column) const;
    [[nodiscard]] Sag sag(int node_row, double dh_m, double finest_dh_m) const;
    [[nodiscard]] Sag sag_of_net(double dh_m, double finest_dh_m) const;

    const PostGrid& grid_;
    const DrawnHeights& heights_;
    LevelGrid level_;
    bool wraps_longitude_;
    double highest_m_;
    std::vector<Curvature> curvature_;  // by row of nodes
    std::vector<Stitched> whole_node_;  // of a node of 8 x 8 quads with neighbours on all sides
};

}  // namespace oro
