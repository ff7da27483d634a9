// Which tiles of trees a frame takes.
#include "core/growth/growth_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include "core/growth/tree_sites.h"

namespace oro {
namespace {

// Posts 1200 a degree, two degrees a side, around 46.5 N 8 E.
PostGrid alps() {
    PostGrid grid;
    grid.lat = {1200.0, 47.5, 0, -1, 2401};
    grid.lon = {1200.0, 7.0, 0, +1, 2401};
    return grid;
}

GrowthView from_above(double heading_deg) {
    GrowthView view;
    view.camera.eye = {46.5, 8.0, 2500.0};
    view.camera.attitude = {heading_deg, -5.0, 0.0};
    view.camera.width_px = view.tile.width_px = 1280;
    view.camera.height_px = view.tile.height_px = 720;
    return view;
}

std::vector<PageIndex> all_pages(const PostGrid& grid) {
    std::vector<PageIndex> pages;
    for (int level = 0; level < 6; ++level) {
        const int quads = 128 << level;
        for (int row = 0; row * quads < grid.rows() - 1; ++row)
            for (int column = 0; column * quads < grid.columns() - 1; ++column)
                pages.push_back({row, column, level});
    }
    return pages;
}

GrowthPlan planned(const PostGrid& grid, const GrowthView& view) {
    const std::vector<PageIndex> pages = all_pages(grid);
    return plan_growth(
        grid, pages,
        [](std::size_t) {
            return GroundRange{400.0, 3000.0};
        },
        view);
}

TEST(GrowthPlan, TakesTilesInFrontOfTheEye) {
    const PostGrid grid = alps();
    const GrowthPlan north = planned(grid, from_above(0.0)), south = planned(grid, from_above(180.0));
    ASSERT_FALSE(north.tiles.empty());
    ASSERT_FALSE(south.tiles.empty());
    std::set<std::pair<gpu::uint, gpu::uint>> seen;
    for (const gpu::GrowthTile& tile : north.tiles) {
        // Beside and behind the eye there is the slack around tiles alone.
        EXPECT_GT(site_tile_south_deg(tile.row), 46.5 - 0.01);
        EXPECT_TRUE(seen.insert({tile.row, tile.column}).second);
    }
    for (const gpu::GrowthTile& tile : south.tiles) EXPECT_LT(site_tile_south_deg(tile.row), 46.5 + 0.01);
}

// A tile's corners are where the lattice has them, to a centimetre, and its page holds them.
TEST(GrowthPlan, PlacesTilesAmongThePosts) {
    const PostGrid grid = alps();
    const std::vector<PageIndex> pages = all_pages(grid);
    const GrowthPlan plan = planned(grid, from_above(0.0));
    ASSERT_FALSE(plan.tiles.empty());
    constexpr double centimetre_posts = 0.01 / 92.6;  // of the closer posts, along a meridian
    for (const gpu::GrowthTile& tile : plan.tiles) {
        const PageIndex& page = pages[tile.page];
        for (unsigned i = 0; i < 4; ++i) {
            const double row = tile.post[0] + static_cast<double>(tile.corners[i].x);
            const double column = tile.post[1] + static_cast<double>(tile.corners[i].y);
            EXPECT_NEAR(row, grid.lat.index_at(site_tile_south_deg(tile.row + i / 2)), centimetre_posts);
            EXPECT_NEAR(column,
                        grid.column_at(site_tile_west_deg(tile.row, tile.column) +
                                       i % 2 * 360.0 / site_tile_columns(tile.row)),
                        centimetre_posts);
            EXPECT_EQ(static_cast<int>(row) >> (page.level + 7), page.row);
            EXPECT_EQ(static_cast<int>(column) >> (page.level + 7), page.column);
        }
    }
}

// Brute force: each tile of the lattice whose middle is in the picture, at some height of its ground, is
// taken.
TEST(GrowthPlan, LeavesOutNoTileThatShows) {
    constexpr unsigned seed = 20261128;
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return low + (high - low) * std::uniform_real_distribution<double>()(random);
    };
    std::size_t inside = 0;
    for (int turn = 0; turn < 30; ++turn) {
        const double lat_deg = number(-80.0, 80.0);
        PostGrid grid;
        grid.lat = {1200.0, std::floor(lat_deg) + 2.0, 0, -1, 3601};
        grid.lon = {1200.0, 7.0, 0, +1, 3601};
        GrowthView view = from_above(number(0.0, 360.0));
        view.camera.eye = {lat_deg, number(8.2, 8.8), number(500.0, 6000.0)};
        view.camera.attitude.pitch_deg = number(-60.0, 20.0);
        const GrowthPlan plan = planned(grid, view);
        std::set<std::pair<gpu::uint, gpu::uint>> taken;
        for (const gpu::GrowthTile& tile : plan.tiles) taken.insert({tile.row, tile.column});
        const auto planes = frustum_planes_view(projection_of_tile(view.camera, view.tile));
        const glm::dmat3 view_from_ecef = view.camera.view_from_ecef();
        const double tile_deg = site_tile_south_deg(1) - site_tile_south_deg(0);
        const double reach_deg = 0.95 * static_cast<double>(plan.reach_m) / 111'700.0;
        const auto first = static_cast<gpu::uint>(std::ceil((lat_deg - reach_deg + 90.0) / tile_deg));
        for (gpu::uint row = first; site_tile_south_deg(row) < lat_deg + reach_deg; ++row) {
            const double columns = site_tile_columns(row);
            const double middle = (view.camera.eye.lon_deg + 180.0) / 360.0 * columns;
            for (double column = std::floor(middle) - 60.0; column < middle + 60.0; ++column) {
                const Geodetic place{site_tile_south_deg(row) + 0.5 * tile_deg,
                                     (column + 0.5) / columns * 360.0 - 180.0, number(400.0, 3000.0)};
                const glm::dvec3 at = ecef_from_geodetic(place).m - view.camera.eye_ecef().m;
                if (glm::length(at) > 0.95 * static_cast<double>(plan.reach_m)) continue;
                const glm::dvec3 in_view = view_from_ecef * at;
                if (!std::ranges::all_of(planes, [&](const Plane& plane) {
                        return glm::dot(glm::dvec3(plane), in_view) + plane.w >= 0.0;
                    }))
                    continue;
                ++inside;
                EXPECT_TRUE(taken.contains({row, static_cast<gpu::uint>(column)}))
                    << "seed " << seed << ", turn " << turn << ", " << place.lat_deg << ", " << place.lon_deg;
            }
        }
    }
    EXPECT_GT(inside, 1500U);
}

// Trees stand up to where the data end: a tile is taken that has a part beyond.
TEST(GrowthPlan, TakesTilesAcrossTheRimOfTheGrid) {
    GrowthView view = from_above(0.0);
    view.camera.eye.lat_deg = 47.495;
    const auto row_of_rim = static_cast<gpu::uint>(site_tile_row_at(47.5));
    ASSERT_LT(site_tile_south_deg(row_of_rim), 47.5 - 1.0e-5);
    ASSERT_GT(site_tile_south_deg(row_of_rim + 1), 47.5 + 1.0e-5);
    const auto tiles = planned(alps(), view).tiles;
    EXPECT_TRUE(
        std::ranges::any_of(tiles, [&](const gpu::GrowthTile& tile) { return tile.row == row_of_rim; }));
    EXPECT_TRUE(
        std::ranges::none_of(tiles, [&](const gpu::GrowthTile& tile) { return tile.row > row_of_rim; }));
}

TEST(GrowthPlan, HasNoneOffTheGridOrAtAPole) {
    GrowthView view = from_above(0.0);
    view.camera.eye = {52.0, 8.0, 300.0};
    EXPECT_TRUE(planned(alps(), view).tiles.empty());
    view.camera.eye = {89.9, 8.0, 300.0};
    EXPECT_TRUE(planned(alps(), view).tiles.empty());
}

}  // namespace
}  // namespace oro
