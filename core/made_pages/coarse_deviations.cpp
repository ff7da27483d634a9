#include "core/made_pages/coarse_deviations.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/lod/levels_gpu.h"
#include "core/lod/quad_differences.h"

namespace oro {
namespace {

constexpr int quads_a_side = static_cast<int>(gpu::meshlet_quads);
constexpr std::uint32_t all_edges = gpu::edge_north | gpu::edge_east | gpu::edge_south | gpu::edge_west;
// Above the rounding of the interpolations here.
constexpr double interpolation_m = 1.0e-6;

// Found once: thousands of comparisons.
const std::vector<NodeDeviations::Stitched>& triangles_of_whole_node() {
    static const std::vector<NodeDeviations::Stitched> all =
        NodeDeviations::stitched_triangles(quads_a_side, quads_a_side, all_edges);
    return all;
}

}  // namespace

CoarseDeviations::CoarseDeviations(const PostGrid& grid, const DrawnHeights& heights,
                                   std::span<const std::int32_t> coarse_steps, int level)
    : heights_(heights), coarse_(coarse_steps), level_(level_grid(grid, level)), level_posts_(1 << level) {
    for (const NodeDeviations::Stitched& stitched : triangles_of_whole_node()) {
        std::array<PostOffset, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = {static_cast<int>(stitched.posts[i][0]) * level_posts_,
                          static_cast<int>(stitched.posts[i][1]) * level_posts_};
        of_whole_node_.emplace_back(corners, heights.columns);
    }
}

// Of 8 x 8 quads that are all square.
bool CoarseDeviations::is_whole(int node_row, int node_column) const {
    const auto reaches = [&](const LevelAxis& axis, int node) {
        return axis.quads_of_node(node) == quads_a_side &&
               axis.region_post((node + 1) * quads_a_side) - axis.region_post(node * quads_a_side) ==
                   quads_a_side * level_posts_;
    };
    return reaches(level_.row, node_row) && reaches(level_.column, node_column);
}

double CoarseDeviations::own_m(int node_row, int node_column) const {
    double steps = 0.0;
    for (int i = 0; i < level_.row.quads_of_node(node_row); ++i) {
        const int row = node_row * quads_a_side + i;
        const int north = level_.row.region_post(row), south = level_.row.region_post(row + 1);
        for (int j = 0; j < level_.column.quads_of_node(node_column); ++j) {
            const int column = node_column * quads_a_side + j;
            const int west = level_.column.region_post(column), east = level_.column.region_post(column + 1);
            if (south - north != east - west) continue;
            const Diagonal diagonal = heights_.diagonal(level_.level(), row, column);
            const auto plane = [&](bool is_west) {
                return cell_plane(diagonal, is_west, heights_.at(north, west), heights_.at(north, east),
                                  heights_.at(south, west), heights_.at(south, east));
            };
            const std::int32_t* const first = &coarse_[number_of(north, west)];
            steps = std::max(steps, quad_differences(first, heights_.columns, south - north, diagonal,
                                                     plane(true), plane(false))
                                        .largest_steps);
        }
    }
    return steps * height_step_m + interpolation_m;
}

PerEdge CoarseDeviations::stitched_m(int node_row, int node_column, std::uint32_t edges,
                                     std::uint32_t asked_edges) const {
    PerEdge found_m{};
    if (asked_edges == 0) return found_m;
    const int first_row = node_row * quads_a_side, first_column = node_column * quads_a_side;
    const PostOffset corner{level_.row.region_post(first_row), level_.column.region_post(first_column)};
    const auto take = [&](const NodeDeviations::Stitched& stitched, const auto& samples) {
        if ((stitched.edges & edges) != stitched.edges) return;
        const int edge = std::countr_zero(stitched.edges);
        if ((asked_edges >> edge & 1U) == 0) return;
        if (heights_.diagonal(level_.level(), first_row + static_cast<int>(stitched.quad[0]),
                              first_column + static_cast<int>(stitched.quad[1])) != stitched.diagonal)
            return;
        double& of_edge_m = found_m[static_cast<std::size_t>(edge)];
        of_edge_m = std::max(
            of_edge_m, samples().largest_steps(heights_, coarse_, corner) * height_step_m + interpolation_m);
    };
    if (is_whole(node_row, node_column)) {
        const auto& triangles = triangles_of_whole_node();
        for (std::size_t i = 0; i < triangles.size(); ++i)
            take(triangles[i], [&]() -> const StitchedSamples& { return of_whole_node_[i]; });
        return found_m;
    }
    for (const NodeDeviations::Stitched& stitched : NodeDeviations::stitched_triangles(
             static_cast<std::uint32_t>(level_.row.quads_of_node(node_row)),
             static_cast<std::uint32_t>(level_.column.quads_of_node(node_column)), edges))
        take(stitched, [&] {
            std::array<PostOffset, 3> corners{};
            for (std::size_t i = 0; i < 3; ++i)
                corners[i] = {
                    level_.row.region_post(first_row + static_cast<int>(stitched.posts[i][0])) - corner.row,
                    level_.column.region_post(first_column + static_cast<int>(stitched.posts[i][1])) -
                        corner.column};
            return StitchedSamples(corners, heights_.columns);
        });
    return found_m;
}

}  // namespace oro
