#include "core/lod/node_deviations.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include "core/earth/ellipsoid.h"
#include "core/earth/extremes.h"
#include "core/lod/levels_gpu.h"
#include "core/lod/quad_differences.h"

namespace oro {
namespace {

constexpr int node_quads = static_cast<int>(gpu::meshlet_quads);
// Posts are placed in float32 to within this share of their page's size (measured: 1 mm on 12 km).
constexpr double placement_share = 1.0e-7;
// Above the rounding of the interpolations here.
constexpr double rounding_m = 1.0e-8;
constexpr std::uint32_t all_edges = gpu::edge_north | gpu::edge_east | gpu::edge_south | gpu::edge_west;

// Of a node of 8 x 8 quads, found once: thousands of comparisons.
const std::vector<NodeDeviations::Stitched>& triangles_of_whole_node() {
    static const std::vector<NodeDeviations::Stitched> all =
        NodeDeviations::stitched_triangles(node_quads, node_quads, all_edges);
    return all;
}

}  // namespace

NodeDeviations::NodeDeviations(const PostGrid& grid, const DrawnHeights& heights, int level)
    : grid_(grid),
      heights_(heights),
      level_(level_grid(grid, level)),
      wraps_longitude_(grid.wraps_longitude()),
      highest_m_(std::max(0.0, heights.highest_steps * height_step_m)),
      whole_node_(triangles_of_whole_node()) {
    assert(heights.rows == grid.rows() && heights.columns == grid.columns());
    for (int i = 0; !grid.net && i < level_.row.nodes(); ++i) {
        const double north_deg = grid.lat.at_deg(level_.row.region_post(i * node_quads));
        const double south_deg =
            grid.lat.at_deg(level_.row.region_post(std::min((i + 1) * node_quads, level_.row.quads)));
        const double outer_deg = std::min(90.0, std::max(std::abs(north_deg), std::abs(south_deg)));
        const double inner_deg =
            north_deg >= 0.0 && south_deg <= 0.0 ? 0.0 : std::min(std::abs(north_deg), std::abs(south_deg));
        const double cosine = sine_cosine_deg(inner_deg).cosine;
        curvature_.push_back({1.0001 * (meridian_radius_m(outer_deg) + highest_m_),
                              (prime_vertical_radius_m(outer_deg) + highest_m_) * cosine,
                              sine_cosine_deg(outer_deg).sine, cosine});
    }
}

std::uint32_t NodeDeviations::edges(int node_row, int node_column) const {
    const bool first_column = node_column == 0;
    const bool last_column = node_column == level_.column.nodes() - 1;
    return (node_row > 0 ? gpu::edge_north : 0U) |
           (node_row < level_.row.nodes() - 1 ? gpu::edge_south : 0U) |
           (!first_column || wraps_longitude_ ? gpu::edge_west : 0U) |
           (!last_column || wraps_longitude_ ? gpu::edge_east : 0U);
}

// The plane of one of a quad's triangles: of its posts' steps, for shares of its height and width.
CellPlane NodeDeviations::plane_of(const QuadPosts& quad, bool is_west) const {
    return cell_plane(quad.diagonal, is_west, heights_.at(quad.north, quad.west),
                      heights_.at(quad.north, quad.east), heights_.at(quad.south, quad.west),
                      heights_.at(quad.south, quad.east));
}

// A quad narrower than high (or lower than wide), where the region ends: its diagonal crosses cells of the
// full resolution. Both triangles' planes are asked at the posts of those cells: never less than the
// deviation.
double NodeDeviations::narrow_quad_deviation(const QuadPosts& quad) const {
    const double height = quad.south - quad.north, width = quad.east - quad.west;
    const CellPlane west = plane_of(quad, true), east = plane_of(quad, false);
    Extremes extremes;
    for (int row = quad.north; row <= quad.south; ++row) {
        for (int column = quad.west; column <= quad.east; ++column) {
            const double down = (row - quad.north) / height, right = (column - quad.west) / width;
            const double h = heights_.at(row, column);
            const double side = west_of_diagonal(quad.diagonal, down, right) * height * width;
            const auto off = [&](const CellPlane& plane) {
                return h - plane.at_corner - (down * plane.change_down + right * plane.change_right);
            };
            if (side > -(height + width)) extremes.add(off(west));
            if (side < height + width) extremes.add(off(east));
        }
    }
    return extremes.magnitude();
}

// Where cells on a square quad's diagonal are split across it: in their middles.
double NodeDeviations::middles_deviation(const QuadPosts& quad) const {
    Extremes extremes;
    const int cells = quad.south - quad.north;
    const CellPlane plane = plane_of(quad, true);
    const double share = 1.0 / cells;
    for (int i = 0; i < cells; ++i) {
        const int row = quad.north + i,
                  column = quad.diagonal == Diagonal::nw_se ? quad.west + i : quad.east - 1 - i;
        if (heights_.diagonal(0, row, column) == quad.diagonal) continue;
        const double middle =
            quad.diagonal == Diagonal::nw_se
                ? 0.5 * (static_cast<double>(heights_.at(row, column + 1)) + heights_.at(row + 1, column))
                : 0.5 * (static_cast<double>(heights_.at(row, column)) + heights_.at(row + 1, column + 1));
        extremes.add(middle - (plane.at_corner + share * (i + 0.5) * plane.change_down +
                               share * (column - quad.west + 0.5) * plane.change_right));
    }
    return extremes.magnitude();
}

bool NodeDeviations::all_void(const QuadPosts& quad) const {
    for (int row = quad.north; row <= quad.south; ++row) {
        const std::int32_t* const steps = heights_.row(row);
        if (std::any_of(steps + quad.west, steps + quad.east + 1,
                        [](std::int32_t post) { return post != void_height_steps; }))
            return false;
    }
    return true;
}

// Which part of a quad with void posts the full-resolution surface and the quad's triangles cover.
NodeDeviations::Quad NodeDeviations::quad_with_voids(const QuadPosts& quad) const {
    // It has posts all around, and is drawn whole; something in it is not there.
    if (quad.diagonal == Diagonal::sw_ne) return {Cover::unequal, unfit_m};
    const auto& [north, west, south, east, quad_diagonal] = quad;
    if (all_void(quad)) return {Cover::empty, 0.0};
    const auto there = [&](int row, int column) { return heights_.at(row, column) != void_height_steps; };
    // Cells' triangles on either side of the diagonal; a cell on it that is sw_ne has half of each on either.
    std::array<std::int64_t, 2> drawn{};
    for (int row = north; row < south; ++row) {
        for (int column = west; column < east; ++column) {
            if (!there(row, column) || !there(row + 1, column + 1)) continue;
            for (const int side : {0, 1}) {
                if (!there(row + 1 - side, column + side)) continue;
                const int off = (row - north) - (column - west);
                ++drawn[off > 0 || (off == 0 && side == 0) ? 0 : 1];
            }
        }
    }
    const bool diagonal = there(north, west) && there(south, east);
    const std::array present{diagonal && there(south, west), diagonal && there(north, east)};
    if (drawn[0] + drawn[1] == 0 && !present[0] && !present[1]) return {Cover::empty, 0.0};
    if (!quad.square()) return {Cover::unequal, unfit_m};
    const std::int64_t whole = static_cast<std::int64_t>(south - north) * (south - north);
    double deviation = 0.0;
    for (const std::size_t side : {0U, 1U}) {
        if (drawn[side] != (present[side] ? whole : 0)) return {Cover::unequal, unfit_m};
        const Post third = side == 0 ? Post{south, west} : Post{north, east};
        if (present[side])
            deviation =
                std::max(deviation, triangle_deviation({Post{north, west}, third, Post{south, east}}));
    }
    return {std::isinf(deviation) ? Cover::unequal : Cover::equal, deviation};
}

// Largest difference over one quad of the level, row and column counted over the level, in steps.
NodeDeviations::Quad NodeDeviations::quad_deviation(int row, int column) const {
    const QuadPosts quad{level_.row.region_post(row), level_.column.region_post(column),
                         level_.row.region_post(row + 1), level_.column.region_post(column + 1),
                         heights_.diagonal(level_.level(), row, column)};
    const auto& [north, west, south, east, quad_diagonal] = quad;
    const std::int32_t *const upper = heights_.row(north), *const lower = heights_.row(south);
    if (std::min(std::min(upper[west], upper[east]), std::min(lower[west], lower[east])) == void_height_steps)
        return quad_with_voids(quad);
    if (quad.square()) return square_quad_deviation(quad);
    for (int r = north; r <= south; ++r) {
        const std::int32_t* const steps = heights_.row(r);
        if (std::find(steps + west, steps + east + 1, void_height_steps) != steps + east + 1)
            return quad_with_voids(quad);
    }
    return {Cover::full, narrow_quad_deviation(quad)};
}

// Of a quad with posts at its corners.
NodeDeviations::Quad NodeDeviations::square_quad_deviation(const QuadPosts& quad) const {
    const int size = quad.south - quad.north;
    if (size == 2) return pair_deviation(quad);
    const QuadDifferences found =
        quad_differences(heights_.row(quad.north) + quad.west, heights_.columns, size, quad.diagonal,
                         plane_of(quad, true), plane_of(quad, false));
    if (found.lowest_steps == void_height_steps) return quad_with_voids(quad);
    return {Cover::full, heights_.diagonals ? std::max(found.largest_steps, middles_deviation(quad))
                                            : found.largest_steps};
}

// Of one of 2 x 2 cells: only the posts half way between its corners can be off. In halves of a step, so that
// it is exact.
NodeDeviations::Quad NodeDeviations::pair_deviation(const QuadPosts& quad) const {
    const std::int32_t* const north = heights_.row(quad.north) + quad.west;
    const std::int32_t* const middle = north + heights_.columns;
    const std::int32_t* const south = middle + heights_.columns;
    if (std::min({north[1], middle[0], middle[1], middle[2], south[1]}) == void_height_steps)
        return quad_with_voids(quad);
    const auto twofold = [](std::int64_t a, std::int64_t b, std::int64_t between) {
        return std::abs(2 * between - a - b);
    };
    const bool nw_se = quad.diagonal == Diagonal::nw_se;
    const std::int64_t largest =
        std::max({twofold(north[0], north[2], north[1]), twofold(south[0], south[2], south[1]),
                  twofold(north[0], south[0], middle[0]), twofold(north[2], south[2], middle[2]),
                  nw_se ? twofold(north[0], south[2], middle[1]) : twofold(north[2], south[0], middle[1])});
    const double steps = 0.5 * static_cast<double>(largest);
    return {Cover::full, heights_.diagonals ? std::max(steps, middles_deviation(quad)) : steps};
}

NodeDeviation NodeDeviations::height_deviation(int node_row, int node_column) const {
    return height_deviation(node_row, node_column, post_range(node_row, node_column), all_edges);
}

NodeDeviation NodeDeviations::height_deviation(int node_row, int node_column, const PostRange& range,
                                               std::uint32_t asked_edges) const {
    const int rows = level_.row.quads_of_node(node_row);
    const int columns = level_.column.quads_of_node(node_column);
    std::array<Cover, 64> covers{};
    bool all_full = true;
    bool all_empty = true;
    double own_steps = 0.0;
    // Level 0 is the full resolution: all there is to ask is what voids leave of it.
    const bool as_it_is = level_.level() == 0 && !range.any_void;
    if (as_it_is) all_empty = false;
    for (int i = 0; i < rows && !as_it_is; ++i) {
        for (int j = 0; j < columns; ++j) {
            const Quad quad = quad_deviation(node_row * node_quads + i, node_column * node_quads + j);
            covers[static_cast<std::size_t>(i * node_quads + j)] = quad.cover;
            all_full = all_full && quad.cover == Cover::full;
            all_empty = all_empty && quad.cover == Cover::empty;
            own_steps = std::max(own_steps, quad.deviation_steps);
        }
    }
    NodeDeviation deviation;
    deviation.empty = all_empty;
    if (all_empty) return deviation;
    deviation.own_m = own_steps * height_step_m;
    const std::uint32_t around = edges(node_row, node_column);
    const bool simple = as_it_is && rows == node_quads && columns == node_quads;
    const PerEdge steps = simple ? finest_stitched_deviation(node_row, node_column)
                                 : stitched_deviation(node_row, node_column, around, asked_edges);
    const std::uint32_t unfit = all_full ? 0U : unfit_edges(covers, rows, columns);
    for (std::size_t i = 0; i < 4; ++i) {
        if ((around >> i & 1U) != 0)
            deviation.stitched_m[i] = (unfit >> i & 1U) != 0 ? unfit_m : steps[i] * height_step_m;
    }
    return deviation;
}

// Range of the node's own posts.
NodeDeviations::PostRange NodeDeviations::post_range(int node_row, int node_column) const {
    const int columns = level_.column.quads_of_node(node_column);
    std::array<int, node_quads + 1> places{};
    for (int j = 0; j <= columns; ++j)
        places[static_cast<std::size_t>(j)] = level_.column.region_post(node_column * node_quads + j);
    constexpr std::int32_t none = std::numeric_limits<std::int32_t>::max();
    std::int32_t lowest = none, highest = void_height_steps;
    bool any_void = false;
    for (int i = 0; i <= level_.row.quads_of_node(node_row); ++i) {
        const std::int32_t* const steps = heights_.row(level_.row.region_post(node_row * node_quads + i));
        for (int j = 0; j <= columns; ++j) {
            const std::int32_t h = steps[places[static_cast<std::size_t>(j)]];
            any_void = any_void || h == void_height_steps;
            lowest = std::min(lowest, h == void_height_steps ? none : h);
            highest = std::max(highest, h);
        }
    }
    constexpr double infinite = std::numeric_limits<double>::infinity();
    return {lowest == none ? infinite : static_cast<double>(lowest),
            highest == void_height_steps ? -infinite : static_cast<double>(highest), any_void};
}

// How far a flat triangle lies from the curved one that is linear in (row, column, height): half the second
// derivative of the position along the offsets to its corners, by Taylor's theorem. With e, t, n the
// directions east, north and up, position'' = -(M+h) dlat^2 n + M' dlat^2 t - r dlon^2 (cos(lat) n - sin(lat)
// t) - 2 (M+h) sin(lat) dlat dlon e + 2 dh (dlat t + cos(lat) dlon e), r = (N+h) cos(lat); and the mean
// square of offsets within a range is at most a quarter of its square. M' is below 0.0102 M and at right
// angles to the first term. A stitched triangle is up to two quads long along one axis.
NodeDeviations::Sag NodeDeviations::sag(int node_row, double dh_m, double finest_dh_m) const {
    if (grid_.net) return sag_of_net(dh_m, finest_dh_m);
    const Curvature& at = curvature_[static_cast<std::size_t>(node_row)];
    const auto bound_m = [&](double dlat, double dlon, double dh) {
        return 0.125 * (at.M_m * dlat * dlat + at.r_m * dlon * dlon + 2.0 * at.M_m * at.sine * dlat * dlon +
                        2.0 * dh * (dlat + at.cosine * dlon));
    };
    const double finest_lat = radians_from_deg(grid_.lat.spacing_deg()).rad;
    const double finest_lon = radians_from_deg(grid_.lon.spacing_deg()).rad;
    const double dlat = std::ldexp(finest_lat, level_.level());
    const double dlon = std::ldexp(finest_lon, level_.level());
    return {bound_m(dlat, dlon, dh_m),
            std::max(bound_m(2.0 * dlat, dlon, dh_m), bound_m(dlat, 2.0 * dlon, dh_m)),
            bound_m(finest_lat, finest_lon, finest_dh_m),
            placement_share * gpu::page_quads * (at.M_m * dlat + at.r_m * dlon)};
}

// The same where rows and columns are those of a net: its bend is what ways along them have at most of a
// second derivative, of height's the turn of the normal along them.
NodeDeviations::Sag NodeDeviations::sag_of_net(double dh_m, double finest_dh_m) const {
    const double radius_m = wgs84_a_m + highest_m_;
    const auto bound_m = [&](double down, double right, double dh) {
        const double both = down + right;
        return 0.125 * (grid_.net->bend() * radius_m * both * both + 2.02 * dh * both +
                        2.0 * grid_.net->kink() * radius_m * both);
    };
    const double finest_down = grid_.row_step_rad(), finest_right = grid_.column_step_rad();
    const double down = std::ldexp(finest_down, level_.level()),
                 right = std::ldexp(finest_right, level_.level());
    return {bound_m(down, right, dh_m),
            std::max(bound_m(2.0 * down, right, dh_m), bound_m(down, 2.0 * right, dh_m)),
            bound_m(finest_down, finest_right, finest_dh_m),
            placement_share * gpu::page_quads * radius_m * (down + right)};
}

NodeDeviation NodeDeviations::deviation(int node_row, int node_column) const {
    return deviation(node_row, node_column, all_edges);
}

NodeDeviation NodeDeviations::deviation(int node_row, int node_column, std::uint32_t asked_edges) const {
    const PostRange range = post_range(node_row, node_column);
    NodeDeviation deviation = height_deviation(node_row, node_column, range, asked_edges);
    if (deviation.empty) return deviation;
    const bool finest = level_.level() == 0;
    // The full resolution's heights differ from the node's by the deviation, at either end of an edge.
    const double dh_m = (range.highest - range.lowest) * height_step_m;
    const Sag sag_m = sag(node_row, dh_m, std::isinf(deviation.own_m) ? dh_m : dh_m + 2.0 * deviation.own_m);
    // Where the region ends, the diagonals of narrow quads cross cells of the full resolution, as stitched
    // edges do.
    const bool narrow = node_row == level_.row.nodes() - 1 || node_column == level_.column.nodes() - 1;
    const double rest_m = rounding_m + (finest ? 0.0 : sag_m.placement_m);
    // A quad's diagonal crosses those of cells that are split the other way.
    const double crossing_m = heights_.diagonals ? sag_m.finest_m : 0.0;
    deviation.own_m = finest ? 0.0
                             : deviation.own_m + rest_m +
                                   (narrow ? sag_m.stitched_m + sag_m.finest_m : sag_m.own_m + crossing_m);
    const std::uint32_t around = edges(node_row, node_column);
    for (std::size_t i = 0; i < 4; ++i) {
        if ((around >> i & 1U) != 0) deviation.stitched_m[i] += sag_m.stitched_m + sag_m.finest_m + rest_m;
    }
    return deviation;
}

}  // namespace oro
