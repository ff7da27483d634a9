// Which tiles of grass a frame takes.
#include "core/growth/meadow_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <utility>

#include "core/growth/tree_sites.h"

namespace oro {
namespace {

constexpr double ground_h_m = 2000.0;

// Posts 1200 a degree, a fifth of a degree a side.
PostGrid meadow_grid() {
    PostGrid grid;
    grid.lat = {1200.0, 46.6, 0, -1, 241};
    grid.lon = {1200.0, 7.9, 0, +1, 241};
    return grid;
}

MeadowPlan planned_meadow(const PostGrid& grid, const GrowthView& view) {
    std::vector<PageIndex> pages;
    for (int level = 0; level < 3; ++level)
        for (int row = 0; row * (128 << level) < grid.rows() - 1; ++row)
            for (int column = 0; column * (128 << level) < grid.columns() - 1; ++column)
                pages.push_back({row, column, level});
    return plan_meadow(
        grid, pages,
        [](std::size_t) {
            return GroundRange{ground_h_m, ground_h_m};
        },
        view);
}

GrowthView standing(double lat_deg, double lon_deg, double above_m) {
    GrowthView view;
    view.camera.eye = {lat_deg, lon_deg, ground_h_m + above_m};
    view.camera.width_px = view.tile.width_px = 1280;
    view.camera.height_px = view.tile.height_px = 720;
    return view;
}

// Brute force: each place within the reach that is in the picture lies in a tile that is taken.
TEST(MeadowPlan, LeavesOutNoTileThatShows) {
    constexpr unsigned seed = 20261128;
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const PostGrid grid = meadow_grid();
    int seen = 0;
    for (int i = 0; i < 40; ++i) {
        GrowthView view = standing(number(46.47, 46.53), number(7.95, 8.05), number(0.3, 40.0));
        view.camera.attitude = {number(0.0, 360.0), number(-80.0, 20.0), number(-20.0, 20.0)};
        view.camera.vertical_fov_deg = number(10.0, 80.0);
        const MeadowPlan plan = planned_meadow(grid, view);
        std::set<std::pair<gpu::uint, gpu::uint>> taken;
        for (const gpu::GrowthTile& tile : plan.tiles) taken.insert({tile.row, tile.column});
        EXPECT_EQ(taken.size(), plan.tiles.size());
        const Projection projection = projection_of_tile(view.camera, view.tile);
        const glm::dmat3 view_from_ecef = view.camera.view_from_ecef();
        for (int j = 0; j < 2000; ++j) {
            const double north_m = number(-60.0, 60.0), east_m = number(-60.0, 60.0), up_m = number(0.0, 0.5);
            const Geodetic place{
                view.camera.eye.lat_deg + north_m / 111'170.0,
                view.camera.eye.lon_deg +
                    east_m / (111'400.0 * std::cos(view.camera.eye.lat_deg * std::numbers::pi / 180.0)),
                ground_h_m + up_m};
            const glm::dvec3 at = view_from_ecef * (ecef_from_geodetic(place).m - view.camera.eye_ecef().m);
            const double depth_m = -at.z;
            const glm::dvec2 side = projection.scale * glm::dvec2(at) + projection.shift * depth_m;
            if (std::hypot(at.x, at.y, at.z) > 60.0 || depth_m <= 0.0 || std::abs(side.x) > depth_m ||
                std::abs(side.y) > depth_m)
                continue;
            ++seen;
            const double rise_deg = site_tile_south_deg(1) - site_tile_south_deg(0);
            const auto parent = static_cast<std::uint32_t>((place.lat_deg + 90.0) / rise_deg);
            const double width_deg = 360.0 / site_tile_columns(parent);
            const auto row = static_cast<gpu::uint>((place.lat_deg + 90.0) / rise_deg * 32.0);
            const auto column = static_cast<gpu::uint>((place.lon_deg + 180.0) / width_deg * 32.0);
            ASSERT_TRUE(taken.contains({row, column}))
                << "seed " << seed << ", eye " << i << ": " << north_m << " m north, " << east_m << " m east";
        }
    }
    EXPECT_GT(seen, 1000);
}

TEST(MeadowPlan, TakesFewTilesNearestFirst) {
    const MeadowPlan plan = planned_meadow(meadow_grid(), standing(46.5, 8.0, 1.7));
    // A picture of 75 degrees across sees a fifth of a circle of 60 m in tiles of 64 square metres.
    EXPECT_GT(plan.tiles.size(), 35U);
    EXPECT_LT(plan.tiles.size(), 110U);
    const double lat_deg = 46.5, rise_deg = (site_tile_south_deg(1) - site_tile_south_deg(0)) / 32.0;
    EXPECT_NEAR(-90.0 + (plan.tiles.front().row + 0.5) * rise_deg, lat_deg, rise_deg);
}

TEST(MeadowPlan, HasNoneFromHighAboveOffTheGridOrAtAPole) {
    const PostGrid grid = meadow_grid();
    EXPECT_TRUE(planned_meadow(grid, standing(46.5, 8.0, 100.0)).tiles.empty());
    EXPECT_TRUE(planned_meadow(grid, standing(46.8, 8.0, 1.7)).tiles.empty());
    EXPECT_TRUE(planned_meadow(grid, standing(89.0, 8.0, 1.7)).tiles.empty());
    EXPECT_TRUE(plan_meadow(grid, {}, {}, standing(46.5, 8.0, 1.7)).tiles.empty());
}

}  // namespace
}  // namespace oro
