// Which ids of a frame are of trees near its eye.
#include "core/growth/near_trees.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "core/growth/tree_sites.h"

namespace oro {
namespace {

constexpr gpu::uint ids_per_tile = gpu::meshlets_per_page * gpu::meshlet_triangles;

// Of all sites of a tile and its neighbours, seen from within it, those are near whose trees stand within 100
// m of the eye, on a sphere of the Earth's mean radius; but for a metre.
TEST(NearTrees, AreThoseWithinAHundredMetres) {
    const Geodetic eye{46.02, 7.75, 1500.0};
    const auto row = static_cast<gpu::uint>(site_tile_row_at(eye.lat_deg));
    const gpu::uint columns = site_tile_columns(row);
    const auto column = static_cast<gpu::uint>((eye.lon_deg + 180.0) / 360.0 * columns);
    GrowthPlan plan;
    plan.first_page = 7;
    for (const gpu::uint east : {0U, 1U}) {
        gpu::GrowthTile tile{};
        tile.row = row;
        tile.column = column + east;
        plan.tiles.push_back(tile);
    }
    NearTrees near_trees(plan, eye);
    std::size_t near = 0, wrong = 0;
    for (gpu::uint tile = 0; tile < 2; ++tile)
        for (gpu::uint site = 0; site < gpu::sites_per_tile; ++site) {
            const gpu::uint id = (plan.first_page + tile) * ids_per_tile + site * gpu::ids_per_site + 1 +
                                 site % gpu::ids_per_site;
            const SiteTree tree = tree_of_site(row * 64 + site / 64, (column + tile) * 64 + site % 64, true);
            const double rad = std::numbers::pi / 180.0;
            const double lat_deg = -90.0 + 180.0 / gpu::site_tile_rows * tree.row / 64.0;
            const double lon_deg = -180.0 + 360.0 / columns * tree.column / 64.0;
            const double north_m = (lat_deg - eye.lat_deg) * rad * 6371000.0;
            const double east_m = (lon_deg - eye.lon_deg) * rad * 6371000.0 * std::cos(eye.lat_deg * rad);
            const double away_m = std::hypot(north_m, east_m);
            near += near_trees.has(id) ? 1U : 0U;
            if (std::abs(away_m - 100.0) > 1.0 && near_trees.has(id) != (away_m < 100.0)) ++wrong;
        }
    EXPECT_EQ(wrong, 0U);
    EXPECT_GT(near, 200U);
    EXPECT_LT(near, 2100U);
}

// Ids of the sky, of ground, of grass and of what another grid has are none of its trees.
TEST(NearTrees, AreNoOtherIds) {
    const Geodetic eye{46.02, 7.75, 1500.0};
    GrowthPlan plan;
    plan.first_page = 7;
    gpu::GrowthTile tile{};
    tile.row = static_cast<gpu::uint>(site_tile_row_at(eye.lat_deg));
    tile.column = static_cast<gpu::uint>((eye.lon_deg + 180.0) / 360.0 * site_tile_columns(tile.row));
    plan.tiles.push_back(tile);
    NearTrees near_trees(plan, eye);
    EXPECT_FALSE(near_trees.has(0));
    EXPECT_FALSE(near_trees.has(7 * ids_per_tile));
    EXPECT_FALSE(near_trees.has(8 * ids_per_tile + 1));
    EXPECT_FALSE(NearTrees(GrowthPlan{}, eye).has(1));
}

}  // namespace
}  // namespace oro
