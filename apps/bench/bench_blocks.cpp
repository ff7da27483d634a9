#include "apps/bench/bench_blocks.h"

#include <cassert>

#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

bool acceptable(const LevelPyramid& pyramid, int level, int row, int column, double error_m) {
    if (level >= static_cast<int>(pyramid.levels.size())) return false;
    const PyramidLevel& of = pyramid.levels[static_cast<std::size_t>(level)];
    if (row < 0 || row >= of.grid.row.nodes() || column < 0 || column >= of.grid.column.nodes()) return false;
    return level == 0 || static_cast<double>(of.node(row, column).error_m) <= error_m;
}

// Edges of a drawn node whose neighbour's place is drawn one level coarser.
gpu::uint edges_to_coarser(const LevelPyramid& pyramid, int level, int row, int column, double error_m) {
    const LevelGrid& grid = pyramid.levels[static_cast<std::size_t>(level)].grid;
    const auto coarser = [&](int other_row, int other_column) {
        return other_row >= 0 && other_row < grid.row.nodes() && other_column >= 0 &&
               other_column < grid.column.nodes() &&
               acceptable(pyramid, level + 1, other_row / 2, other_column / 2, error_m);
    };
    return (coarser(row - 1, column) ? gpu::edge_north : 0U) |
           (coarser(row, column + 1) ? gpu::edge_east : 0U) |
           (coarser(row + 1, column) ? gpu::edge_south : 0U) |
           (coarser(row, column - 1) ? gpu::edge_west : 0U);
}

void add_node(const LevelGrid& grid, const DrawnHeights& heights, int node_row, int node_column,
              gpu::uint edges, std::vector<MeshTriangle>& triangles) {
    constexpr int node_quads = static_cast<int>(gpu::meshlet_quads);
    const gpu::uvec2 quads(static_cast<unsigned>(grid.row.quads_of_node(node_row)),
                           static_cast<unsigned>(grid.column.quads_of_node(node_column)));
    const auto post = [&](unsigned row, unsigned column) {
        const gpu::uvec2 to = gpu::stitched_post({row, column}, quads, edges);
        return MeshPost{grid.row.region_post(node_row * node_quads + static_cast<int>(to.x)),
                        grid.column.region_post(node_column * node_quads + static_cast<int>(to.y))};
    };
    for (unsigned row = 0; row < quads.x; ++row) {
        for (unsigned column = 0; column < quads.y; ++column) {
            const Diagonal own = heights.diagonal(grid.level(), node_row * node_quads + static_cast<int>(row),
                                                  node_column * node_quads + static_cast<int>(column));
            const bool sw_ne = gpu::drawn_sw_ne(own == Diagonal::sw_ne, {row, column}, quads, edges);
            for (const bool west : {true, false}) {
                const CellCorners at = cell_corners(sw_ne ? Diagonal::sw_ne : Diagonal::nw_se, west);
                const auto corner = [&](std::size_t i) {
                    return post(row + static_cast<unsigned>(at[i][0]),
                                column + static_cast<unsigned>(at[i][1]));
                };
                const MeshTriangle triangle{corner(0), corner(2), corner(1)};
                if (twice_area(triangle[0], triangle[1], triangle[2]) != 0) triangles.push_back(triangle);
            }
        }
    }
}

}  // namespace

BlockMesh block_mesh(const LevelPyramid& pyramid, const DrawnHeights& heights, double error_m) {
    assert(!pyramid.wraps_longitude);
    BlockMesh mesh;
    for (int level = 0; level < static_cast<int>(pyramid.levels.size()); ++level) {
        const LevelGrid& grid = pyramid.levels[static_cast<std::size_t>(level)].grid;
        std::size_t& nodes = mesh.nodes.emplace_back();
        for (int row = 0; row < grid.row.nodes(); ++row) {
            for (int column = 0; column < grid.column.nodes(); ++column) {
                if (!acceptable(pyramid, level, row, column, error_m) ||
                    acceptable(pyramid, level + 1, row / 2, column / 2, error_m))
                    continue;
                ++nodes;
                add_node(grid, heights, row, column, edges_to_coarser(pyramid, level, row, column, error_m),
                         mesh.triangles);
            }
        }
    }
    return mesh;
}

}  // namespace oro
