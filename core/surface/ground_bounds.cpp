#include "core/surface/ground_bounds.h"

#include <algorithm>
#include <cmath>

#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// As core/lod/node_deviations.cpp has them: posts are placed in float32 to within this share of what they are
// placed with; more than the rounding of differences.
constexpr double placement_share = 1.0e-7;
constexpr double rounding_m = 1.0e-8;

}  // namespace

GridBounds::GridBounds(const PostGrid& grid, std::int32_t highest_steps)
    : grid_(grid), highest_m_(std::max(0.0, highest_steps * height_step_m)) {
    for (int row = 0; !grid.net && row < grid.rows(); ++row) {
        const double lat_deg = row_lat_deg(grid, row);
        rows_.push_back({sine_cosine_deg(lat_deg), prime_vertical_radius_m(lat_deg)});
    }
    for (int column = 0; !grid.net && column < grid.columns(); ++column)
        columns_.push_back(sine_cosine_deg(grid.lon.at_deg(column)));
}

Ecef GridBounds::ecef(const SurfaceVertex& vertex) const {
    const double h_m = vertex.steps * height_step_m;
    if (grid_.net) return ecef_along(grid_.net->normal_at(vertex.row, vertex.column), h_m);
    const Row& row = rows_[static_cast<std::size_t>(vertex.row)];
    const SineCosine& lon = columns_[static_cast<std::size_t>(vertex.column)];
    const double across = (row.N_m + h_m) * row.lat.cosine;
    return {{across * lon.cosine, across * lon.sine, (row.N_m * (1.0 - wgs84_e2) + h_m) * row.lat.sine}};
}

// The bounds of NodeDeviations::sag: half the second derivative of the position along the offsets to a
// triangle's corners; of the triangle and of one of the original.
double GridBounds::flat_m(const GroundExtent& triangle, const GroundExtent& group) const {
    const double down = grid_.row_step_rad(), right = grid_.column_step_rad();
    const double tall = triangle.rows() * down, wide = triangle.columns * right;
    const double group_tall = group.rows() * down, group_wide = group.columns * right;
    if (grid_.net) {
        const double radius_m = wgs84_a_m + highest_m_;
        const auto bound_m = [&](double both, double rise_m) {
            return 0.125 * (grid_.net->bend() * radius_m * both * both + 2.02 * rise_m * both +
                            2.0 * grid_.net->kink() * radius_m * both);
        };
        return bound_m(tall + wide, triangle.rise_m) + bound_m(down + right, group.rise_m) +
               placement_share * radius_m * (group_tall + group_wide) + rounding_m;
    }
    const double north_deg = row_lat_deg(grid_, group.first_row);
    const double south_deg = row_lat_deg(grid_, group.last_row);
    const double outer_deg = std::min(90.0, std::max(std::abs(north_deg), std::abs(south_deg)));
    const double inner_deg =
        north_deg >= 0.0 && south_deg <= 0.0 ? 0.0 : std::min(std::abs(north_deg), std::abs(south_deg));
    const double sine = sine_cosine_deg(outer_deg).sine, cosine = sine_cosine_deg(inner_deg).cosine;
    const double M_m = 1.0001 * (meridian_radius_m(outer_deg) + highest_m_);
    const double r_m = (prime_vertical_radius_m(outer_deg) + highest_m_) * cosine;
    const auto bound_m = [&](double dlat, double dlon, double rise_m) {
        return 0.125 * (M_m * dlat * dlat + r_m * dlon * dlon + 2.0 * M_m * sine * dlat * dlon +
                        2.0 * rise_m * (dlat + cosine * dlon));
    };
    return bound_m(tall, wide, triangle.rise_m) + bound_m(down, right, group.rise_m) +
           placement_share * (M_m * group_tall + r_m * group_wide) + rounding_m;
}

}  // namespace oro
