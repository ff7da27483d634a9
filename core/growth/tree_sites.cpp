#include "core/growth/tree_sites.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/earth/ellipsoid.h"

namespace oro::gpu {
namespace {
#define ORO_FUNCTION [[maybe_unused]]
#include "shaders/growth/tree_rule.glsl"
#undef ORO_FUNCTION
}  // namespace
}  // namespace oro::gpu

namespace oro {
namespace {

constexpr double meridian_m = 20003931.4586;  // from pole to pole on WGS84
constexpr double tile_deg = 180.0 / gpu::site_tile_rows;

}  // namespace

double site_spacing_m() {
    return meridian_m / gpu::site_tile_rows / gpu::sites_per_side;
}

double site_tile_south_deg(std::uint32_t tile_row) {
    return -90.0 + static_cast<double>(tile_row) * tile_deg;
}

std::int64_t site_tile_row_at(double lat_deg) {
    const double rise_deg = site_tile_south_deg(1) - site_tile_south_deg(0);
    return static_cast<std::int64_t>(std::floor((lat_deg + 90.0) / rise_deg));
}

std::uint32_t site_tile_columns(std::uint32_t tile_row) {
    const double lat_rad = (site_tile_south_deg(tile_row) + 0.5 * tile_deg) * std::numbers::pi / 180.0;
    constexpr double equator_m = 2.0 * std::numbers::pi * 6378137.0;
    const double around_m = equator_m * std::cos(lat_rad);
    return static_cast<std::uint32_t>(
        std::max(1.0, std::round(around_m / (site_spacing_m() * gpu::sites_per_side))));
}

double site_tile_west_deg(std::uint32_t tile_row, std::uint32_t tile_column) {
    return -180.0 + 360.0 * static_cast<double>(tile_column) / site_tile_columns(tile_row);
}

SiteTree tree_of_site(std::uint32_t row, std::uint32_t column, bool is_needle) {
    const std::uint32_t hash = gpu::site_hash(row, column);
    const gpu::vec2 place = gpu::site_place(hash);
    const gpu::Tree tree = gpu::tree_of_site(hash, is_needle ? gpu::site_needle : gpu::site_broad, 1.0F);
    return {column + static_cast<double>(place.x),     row + static_cast<double>(place.y),
            gpu::site_rank(hash) < gpu::stocked_sites, static_cast<double>(tree.height_m),
            static_cast<double>(tree.crown_m),         static_cast<double>(tree.radius_m)};
}

}  // namespace oro
