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

// Of numbers that are not negative: what std::floor gives, which is a call.
int floor_of(double number) {
    return static_cast<int>(number);
}
// Of numbers above -1.
int ceiling_of(double number) {
    const int down = static_cast<int>(number);
    return static_cast<double>(down) < number ? down + 1 : down;
}

}  // namespace

CoarseDeviations::CoarseDeviations(const PostGrid& grid, const DrawnHeights& heights,
                                   std::span<const std::int32_t> coarse_steps, int level)
    : heights_(heights),
      coarse_(coarse_steps),
      level_(level_grid(grid, level)),
      whole_node_(triangles_of_whole_node()) {}

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

// Where an edge of a triangle crosses the rows and columns of posts, and the diagonals of cells, all of which
// are taken as nw_se: there the coarse octaves' surface, linear between posts, has its edges.
void CoarseDeviations::add_crossings(const Corner& from, const Corner& to, Extremes& extremes) const {
    const int down = to.row - from.row, right = to.column - from.column;
    const double h = heights_.at(from.row, from.column), rise = heights_.at(to.row, to.column) - h;
    const auto each = [&](int steps, const auto& visit) {
        const int step = steps > 0 ? 1 : -1;
        for (int i = step; i != steps && steps != 0; i += step) visit(i, static_cast<double>(i) / steps);
    };
    const auto compare = [&](double share, int row, int column, double between, int row_on, int column_on) {
        const double coarse = (1.0 - between) * coarse_at(row, column) +
                              (between > 0.0 ? between * coarse_at(row + row_on, column + column_on) : 0.0);
        extremes.add(coarse - (h + share * rise));
    };
    each(down, [&](int i, double share) {
        const double column = from.column + share * right;
        const int west = floor_of(column);
        compare(share, from.row + i, west, column - west, 0, 1);
    });
    each(right, [&](int i, double share) {
        const double row = from.row + share * down;
        const int north = floor_of(row);
        compare(share, north, from.column + i, row - north, 1, 0);
    });
    each(right - down, [&](int i, double share) {
        const double row = from.row + share * down;
        const int north = floor_of(row);
        compare(share, north, from.column - from.row + i + north, row - north, 1, 1);
    });
}

// At the posts in a triangle and on its edges.
double CoarseDeviations::triangle_steps(const std::array<Corner, 3>& corners) const {
    const auto& [a, b, c] = corners;
    const double h = heights_.at(a.row, a.column);
    const double down_b = b.row - a.row, right_b = b.column - a.column,
                 rise_b = heights_.at(b.row, b.column) - h;
    const double down_c = c.row - a.row, right_c = c.column - a.column,
                 rise_c = heights_.at(c.row, c.column) - h;
    const double area = down_b * right_c - down_c * right_b;
    const double by_row = (rise_b * right_c - rise_c * right_b) / area;
    const double by_column = (down_b * rise_c - down_c * rise_b) / area;
    const auto [first_row, last_row] = std::minmax({a.row, b.row, c.row});
    Extremes extremes;
    for (std::size_t i = 0; i < 3; ++i) add_crossings(corners[i], corners[(i + 1) % 3], extremes);
    for (int row = first_row; row <= last_row; ++row) {
        double west = std::numeric_limits<double>::infinity(), east = -west;
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner &from = corners[i], &to = corners[(i + 1) % 3];
            if (row < std::min(from.row, to.row) || row > std::max(from.row, to.row)) continue;
            const double share =
                to.row == from.row ? 0.0 : static_cast<double>(row - from.row) / (to.row - from.row);
            const double column = from.column + share * (to.column - from.column);
            west = std::min(west, column);
            east = std::max(east, column);
        }
        // A row that an edge lies on has its ends from the two other edges.
        constexpr double rounding = 1e-9;
        const int last = floor_of(east + rounding);
        const double of_row = h + (row - a.row) * by_row;
        for (int column = ceiling_of(west - rounding); column <= last; ++column)
            extremes.add(coarse_at(row, column) - (of_row + (column - a.column) * by_column));
    }
    return extremes.magnitude();
}

PerEdge CoarseDeviations::stitched_m(int node_row, int node_column, std::uint32_t edges,
                                     std::uint32_t asked_edges) const {
    PerEdge found_m{};
    if (asked_edges == 0) return found_m;
    const int rows = level_.row.quads_of_node(node_row), columns = level_.column.quads_of_node(node_column);
    const bool whole = rows == quads_a_side && columns == quads_a_side;
    const std::vector<NodeDeviations::Stitched> part =
        whole ? std::vector<NodeDeviations::Stitched>{}
              : NodeDeviations::stitched_triangles(static_cast<std::uint32_t>(rows),
                                                   static_cast<std::uint32_t>(columns), edges);
    for (const NodeDeviations::Stitched& stitched : whole ? whole_node_ : part) {
        if ((stitched.edges & edges) != stitched.edges) continue;
        const int edge = std::countr_zero(stitched.edges);
        if ((asked_edges >> edge & 1U) == 0) continue;
        const int row = node_row * quads_a_side, column = node_column * quads_a_side;
        if (heights_.diagonal(level_.level(), row + static_cast<int>(stitched.quad[0]),
                              column + static_cast<int>(stitched.quad[1])) != stitched.diagonal)
            continue;
        std::array<Corner, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i)
            corners[i] = {level_.row.region_post(row + static_cast<int>(stitched.posts[i][0])),
                          level_.column.region_post(column + static_cast<int>(stitched.posts[i][1]))};
        double& of_edge_m = found_m[static_cast<std::size_t>(edge)];
        of_edge_m = std::max(of_edge_m, triangle_steps(corners) * height_step_m + interpolation_m);
    }
    return found_m;
}

}  // namespace oro
