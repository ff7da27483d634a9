#include "core/frame_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include "tests/core/world_field.h"

namespace oro {
namespace {

struct Region {
    HeightField field;
    RegionShape shape;
    std::vector<PageSummary> pages;
};

// 9 x 9 pages of 3" posts.
Region alpine_region() {
    Region region;
    region.field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 1100, 1100, [](double lat_deg, double lon_deg) {
            return 1500.0 + 1000.0 * std::sin(lat_deg * 90.0) * std::cos(lon_deg * 70.0);
        });
    region.shape = region_shape(region.field, 1.0);
    auto block = std::make_unique<gpu::PageBlock>();
    const PageLayout layout = page_layout(region.field.grid);
    for (int row = 0; row < layout.rows; ++row) {
        for (int column = 0; column < layout.columns; ++column) {
            region.pages.push_back(build_page(region.field, region.shape, {row, column}, *block));
        }
    }
    return region;
}

TEST(FramePlan, KeepsEveryPageWithAPostInThePicture) {
    const Region region = alpine_region();
    ASSERT_EQ(region.pages.size(), 81U);
    std::mt19937_64 random(42);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::size_t left_out = 0;
    for (int i = 0; i < 100; ++i) {
        Camera camera;
        camera.width_px = 400;
        camera.height_px = 300;
        camera.eye = {46.5 + 0.6 * unit(random), 8.5 + 0.6 * unit(random),
                      2600.0 + 2000.0 * (unit(random) + 1.0)};
        camera.attitude = {180.0 * unit(random), 30.0 * unit(random) - 20.0, 20.0 * unit(random)};
        const Tile tile{0, 0, 400, 300, {0.5, 0.5}};
        const FramePlan plan = plan_frame(region.pages, region.shape, camera, tile);
        EXPECT_EQ(plan.pages.size() + plan.pages_beyond_frustum + plan.pages_beyond_horizon,
                  region.pages.size());
        EXPECT_EQ(plan.pages_beyond_horizon, 0U) << "the horizon is farther than the region is wide";
        left_out += region.pages.size() - plan.pages.size();
        const std::set<std::size_t> kept(plan.page_numbers.begin(), plan.page_numbers.end());
        EXPECT_EQ(kept.size(), plan.pages.size());
        const glm::dmat3 view_from_ecef = camera.view_from_ecef();
        const glm::dvec2 tangent = camera.half_fov_tangent();
        for (std::size_t n = 0; n < region.pages.size(); ++n) {
            if (kept.contains(n)) continue;
            for (int k = 0; k < 400; ++k) {
                const int row = region.pages[n].index.row * 128 + k / 20 * 6;
                const int column = region.pages[n].index.column * 128 + k % 20 * 6;
                if (row >= 1100 || column >= 1100) continue;
                const glm::dvec3 view =
                    view_from_ecef * (post_ecef(region.field, row, column, 1.0).m - camera.eye_ecef().m);
                const bool seen = view.z < -0.01 && std::abs(view.x) <= -view.z * tangent.x &&
                                  std::abs(view.y) <= -view.z * tangent.y;
                ASSERT_FALSE(seen) << "page " << n << " has a post in the picture";
            }
        }
    }
    EXPECT_GT(left_out, 1000U);
}

TEST(FramePlan, PlacesPagesAndSortsThemByDistance) {
    const Region region = alpine_region();
    Camera camera;
    camera.width_px = 400;
    camera.height_px = 300;
    camera.eye = {46.2, 8.2, 4000.0};
    camera.attitude = {30.0, -10.0, 5.0};
    const FramePlan plan = plan_frame(region.pages, region.shape, camera, {0, 0, 400, 300, {0.5, 0.5}});
    ASSERT_GT(plan.pages.size(), 10U);
    EXPECT_EQ(plan.constants.page_count, plan.pages.size());
    double before_m = 0.0;
    for (std::size_t i = 0; i < plan.pages.size(); ++i) {
        const PageSummary& page = region.pages[plan.page_numbers[i]];
        const glm::dvec3 offset =
            page.ecef_from_page * page.centre_m + page.origin_ecef.m - camera.eye_ecef().m;
        const double distance_m = std::max(0.0, glm::length(offset) - page.radius_m);
        EXPECT_GE(distance_m, before_m - 1e-6);
        before_m = distance_m;
        // The frame's floats put a point of the page where doubles put it, but for 6e-8 of its distance an
        // axis.
        const glm::dvec3 point(1000.0, -2000.0, 500.0);
        const glm::dvec3 truth = camera.view_from_ecef() *
                                 (page.origin_ecef.m + page.ecef_from_page * point - camera.eye_ecef().m);
        const gpu::vec3 got = plan.pages[i].view_from_page * gpu::vec3(point) + plan.pages[i].origin_view;
        EXPECT_LT(glm::length(glm::dvec3(got) - truth), 2e-7 * glm::length(truth) + 1e-3);
    }
}

}  // namespace
}  // namespace oro
