#include "core/growth/near_trees.h"

#include <cmath>
#include <numbers>

#include "core/growth/tree_sites.h"

namespace oro {

bool NearTrees::has(std::uint32_t id) {
    constexpr std::uint32_t ids_per_tile = gpu::meshlets_per_page * gpu::meshlet_triangles;
    if (id == last_id_) return last_is_near_;
    last_id_ = id;
    last_is_near_ = false;
    const std::uint32_t first = plan_.first_page * ids_per_tile + 1;
    if (id < first || (id - first) / ids_per_tile >= plan_.tiles.size()) return false;
    const gpu::GrowthTile& tile = plan_.tiles[(id - first) / ids_per_tile];
    last_is_near_ = is_near(tile, (id - first) % ids_per_tile / gpu::ids_per_site);
    return last_is_near_;
}

bool NearTrees::is_near(const gpu::GrowthTile& tile, std::uint32_t site) const {
    constexpr double side = gpu::sites_per_side, equator_m_per_deg = 111320.0;
    const SiteTree tree = tree_of_site(tile.row * gpu::sites_per_side + site / gpu::sites_per_side,
                                       tile.column * gpu::sites_per_side + site % gpu::sites_per_side, true);
    const double tile_deg = site_tile_south_deg(1) - site_tile_south_deg(0);
    const double north_sites = tree.row - (eye_.lat_deg - site_tile_south_deg(0)) / tile_deg * side;
    const double lon_deg = -180.0 + 360.0 * tree.column / side / site_tile_columns(tile.row);
    const double east_m = std::remainder(lon_deg - eye_.lon_deg, 360.0) * equator_m_per_deg *
                          std::cos(eye_.lat_deg * std::numbers::pi / 180.0);
    return std::hypot(north_sites * site_spacing_m(), east_m) <= near_trees_m;
}

}  // namespace oro
