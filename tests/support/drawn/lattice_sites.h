// Trees as the rule of sites has them (shaders/growth/tree_rule.glsl), for every site of the lattice around
// an eye.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/vec2.hpp>
#include <numbers>

#include "core/earth/camera.h"
#include "core/growth/tree_sites.h"
#include "shaders/shared_growth.h"

namespace oro::gpu {
namespace {
namespace site_rule {
#define ORO_FUNCTION [[maybe_unused]]
#undef OROGRAPH_SHADERS_GROWTH_TREE_RULE
#undef OROGRAPH_SHADERS_GROWTH_REACH
#include "shaders/growth/reach.glsl"
#include "shaders/growth/tree_rule.glsl"
#undef ORO_FUNCTION
}  // namespace site_rule
}  // namespace
}  // namespace oro::gpu

namespace oro::test {

// A site of a lattice by its row and column in the whole of it.
struct LatticeSite {
    std::uint32_t row{}, column{};
    std::uint32_t tile_row{}, tile_column{};  // of its tile
    glm::dvec2 in_tile;                       // where: columns and rows, 0 to 1
    double lat_deg{}, lon_deg{};
    std::uint32_t hash{};
};

// A lattice whose tiles divide those of trees: so many of its tiles a side of one of these, so many sites a
// side of a tile of its own, and where in its cell a site is, columns and rows, by its hash.
struct SiteLattice {
    std::uint32_t tiles_a_side, sites_a_side;
    glm::dvec2 (*place_in_cell)(std::uint32_t hash);
};
inline SiteLattice tree_lattice() {
    return {1, gpu::sites_per_side,
            [](std::uint32_t hash) { return glm::dvec2(gpu::site_rule::site_place(hash)); }};
}

// Gives every site whose place is no farther from an eye than that, across, and some beyond; none is left
// out.
template <class Give>
void for_each_site_around(const SiteLattice& lattice, const Geodetic& eye, double reach_m, const Give& give) {
    constexpr double m_per_deg = 110500.0;  // or more
    const double lat_reach_deg = reach_m / m_per_deg;
    const std::uint32_t side = lattice.tiles_a_side * lattice.sites_a_side;
    for (std::int64_t parent_row = site_tile_row_at(eye.lat_deg - lat_reach_deg) - 1;
         parent_row <= site_tile_row_at(eye.lat_deg + lat_reach_deg) + 1; ++parent_row) {
        const auto of_row = static_cast<std::uint32_t>(parent_row);
        const double columns = site_tile_columns(of_row), south_deg = site_tile_south_deg(of_row),
                     rise_deg = site_tile_south_deg(of_row + 1) - south_deg, width_deg = 360.0 / columns;
        const double lon_reach_deg =
            lat_reach_deg / std::cos((std::abs(eye.lat_deg) + lat_reach_deg) * std::numbers::pi / 180.0);
        const auto number_at = [&](double lon_deg) {
            return static_cast<std::int64_t>(std::floor((lon_deg + 180.0) / width_deg * side));
        };
        for (std::uint32_t row = 0; row < side; ++row) {
            const double low_deg = south_deg + (row - 1.0) / side * rise_deg;
            if (std::abs(low_deg - eye.lat_deg) > lat_reach_deg + 3.0 * rise_deg / side) continue;
            for (std::int64_t column = number_at(eye.lon_deg - lon_reach_deg) - 2;
                 column <= number_at(eye.lon_deg + lon_reach_deg) + 2; ++column) {
                LatticeSite site;
                site.row = of_row * side + row;
                site.column = static_cast<std::uint32_t>(column);
                site.tile_row = site.row / lattice.sites_a_side;
                site.tile_column = site.column / lattice.sites_a_side;
                site.hash = gpu::site_rule::site_hash(site.row, site.column);
                const glm::dvec2 in_cell = lattice.place_in_cell(site.hash);
                const glm::dvec2 in_parent((static_cast<double>(site.column % side) + in_cell.x) / side,
                                           (row + in_cell.y) / side);
                site.in_tile =
                    (glm::dvec2(site.column % lattice.sites_a_side, site.row % lattice.sites_a_side) +
                     in_cell) /
                    static_cast<double>(lattice.sites_a_side);
                site.lat_deg = south_deg + in_parent.y * rise_deg;
                site.lon_deg = -180.0 + (static_cast<double>(site.column / side) + in_parent.x) * width_deg;
                give(site);
            }
        }
    }
}

}  // namespace oro::test
