// What is drawn of a node, by the rules alone: its triangles after stitching, as posts of the region. Written
// apart from core's own error measurement, to hold that against.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "core/lod/levels_gpu.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/level_grid.h"

namespace oro::test {

struct RegionPost {
    int row;
    int column;
    friend bool operator==(const RegionPost&, const RegionPost&) = default;
    friend auto operator<=>(const RegionPost&, const RegionPost&) = default;
};
using PostTriangle = std::array<RegionPost, 3>;

// Triangles of a node that have an area and no void post, each cell split as its level says; but the last one
// of a node falls where both its southern and its eastern edge are stitched.
inline std::vector<PostTriangle> drawn_triangles(const DrawnHeights& heights, const LevelGrid& grid,
                                                 int node_row, int node_column, std::uint32_t edges) {
    const glm::uvec2 quads(static_cast<unsigned>(grid.row.quads_of_node(node_row)),
                           static_cast<unsigned>(grid.column.quads_of_node(node_column)));
    std::vector<PostTriangle> triangles;
    for (unsigned row = 0; row < quads.x; ++row) {
        for (unsigned column = 0; column < quads.y; ++column) {
            const glm::uvec2 nw(row, column), se(row + 1, column + 1), sw(row + 1, column),
                ne(row, column + 1);
            bool sw_ne = heights.diagonal(grid.level(), node_row * 8 + static_cast<int>(row),
                                          node_column * 8 + static_cast<int>(column)) == Diagonal::sw_ne;
            if ((edges & gpu::edge_south) != 0 && (edges & gpu::edge_east) != 0 && se == quads) sw_ne = false;
            for (const std::array<glm::uvec2, 3>& corners :
                 {sw_ne ? std::array{nw, sw, ne} : std::array{nw, sw, se},
                  sw_ne ? std::array{ne, sw, se} : std::array{nw, se, ne}}) {
                PostTriangle triangle;
                bool drawn = true;
                for (std::size_t i = 0; i < 3; ++i) {
                    const glm::uvec2 to = gpu::stitched_post(corners[i], quads, edges);
                    triangle[i] = {grid.row.region_post(node_row * 8 + static_cast<int>(to.x)),
                                   grid.column.region_post(node_column * 8 + static_cast<int>(to.y))};
                    drawn = drawn && heights.at(triangle[i].row, triangle[i].column) != void_height_steps;
                }
                const auto& [a, b, c] = triangle;
                if ((b.row - a.row) * (c.column - a.column) == (c.row - a.row) * (b.column - a.column))
                    continue;
                if (drawn) triangles.push_back(triangle);
            }
        }
    }
    return triangles;
}

// Shares of a triangle's corners at a place; negative ones outside.
inline std::array<double, 3> shares_at(const PostTriangle& triangle, double row, double column) {
    const auto& [a, b, c] = triangle;
    const double area = static_cast<double>(b.row - a.row) * (c.column - a.column) -
                        static_cast<double>(c.row - a.row) * (b.column - a.column);
    const double of_b =
        ((row - a.row) * (c.column - a.column) - (c.row - a.row) * (column - a.column)) / area;
    const double of_c =
        ((b.row - a.row) * (column - a.column) - (row - a.row) * (b.column - a.column)) / area;
    return {1.0 - of_b - of_c, of_b, of_c};
}

// The full-resolution triangle at a place, if there is one: that on the given side of the diagonal for places
// on it.
inline std::optional<PostTriangle> finest_triangle(const DrawnHeights& heights, double row, double column) {
    const int r = std::min(static_cast<int>(row), heights.rows - 2);
    const int c = std::min(static_cast<int>(column), heights.columns - 2);
    const bool sw_ne = heights.diagonal(0, r, c) == Diagonal::sw_ne;
    const RegionPost nw{r, c}, ne{r, c + 1}, sw{r + 1, c}, se{r + 1, c + 1};
    PostTriangle triangle = row - r >= column - c ? PostTriangle{nw, sw, se} : PostTriangle{nw, se, ne};
    if (sw_ne)
        triangle = (row - r) + (column - c) <= 1.0 ? PostTriangle{nw, sw, ne} : PostTriangle{ne, sw, se};
    for (const RegionPost& post : triangle) {
        if (heights.at(post.row, post.column) == void_height_steps) return std::nullopt;
    }
    return triangle;
}

// Height on a triangle at a place, metres.
inline double height_on(const DrawnHeights& heights, const PostTriangle& triangle, double row,
                        double column) {
    const std::array<double, 3> shares = shares_at(triangle, row, column);
    double h_m = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        h_m += shares[i] * heights.at(triangle[i].row, triangle[i].column) * height_step_m;
    return h_m;
}

}  // namespace oro::test
