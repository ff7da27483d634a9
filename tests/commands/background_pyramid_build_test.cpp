// What the window shows while levels are measured, and how it gets the measured ones.
#include "apps/drawing/background_pyramid_build.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstring>
#include <memory>

#include "apps/drawing/region_scene.h"

namespace oro {
namespace {

// Hills over `posts` x `posts` posts of 3 seconds.
Region hills(int posts) {
    Region region{std::vector<RegionGrid>(1)};
    region.grids[0].field.grid.lat = {1200.0, 47.0, 0, -1, posts};
    region.grids[0].field.grid.lon = {1200.0, 8.0, 0, 1, posts};
    for (int row = 0; row < posts; ++row) {
        for (int column = 0; column < posts; ++column)
            region.grids[0].field.H_m.push_back(static_cast<float>(500 + (row * 7 + column * 3) % 200));
    }
    return region;
}

TEST(CoarseField, HasEveryNthPostWhereItIs) {
    const Region region = hills(2100);
    ASSERT_TRUE(measures_long(region));
    const HeightField coarse = coarse_field(region.grids[0].field);
    EXPECT_LE(coarse.grid.post_count(), 1'000'000U);
    const int step = 4;  // 2100^2 / 4^2 is the first below a million
    ASSERT_EQ(coarse.grid.rows(), 2099 / step + 1);
    for (const int row : {0, 1, 77, coarse.grid.rows() - 1}) {
        EXPECT_NEAR(coarse.grid.lat.at_deg(row), region.grids[0].field.grid.lat.at_deg(row * step), 1e-12);
        EXPECT_NEAR(coarse.grid.lon.at_deg(row), region.grids[0].field.grid.lon.at_deg(row * step), 1e-12);
        EXPECT_EQ(coarse.H_at_post_m(row, 5), region.grids[0].field.H_at_post_m(row * step, 5 * step));
    }
    EXPECT_FALSE(measures_long(hills(400)));
}

TEST(BackgroundPyramidBuild, AreThoseOfTheRegion) {
    const Region region = hills(500);
    BackgroundPyramidBuild finer(region, 2.0, true);
    auto measured = finer.wait();
    ASSERT_TRUE(measured.ok()) << measured.error().line();
    const auto pages = grid_pages(region.grids[0], {}, 2.0);
    ASSERT_TRUE(pages.ok());
    ASSERT_EQ((*measured)->levels(), (*pages)->levels());
    EXPECT_EQ((*measured)->facts().triangles, (*pages)->facts().triangles);
    for (int level = 0; level < (*pages)->levels(); ++level) {
        auto a = std::make_unique<gpu::PageBlock>(), b = std::make_unique<gpu::PageBlock>();
        ASSERT_TRUE((*measured)->load({0, 0, level}, *a).ok());
        ASSERT_TRUE((*pages)->load({0, 0, level}, *b).ok());
        EXPECT_EQ(std::memcmp(a.get(), b.get(), sizeof *a), 0) << level;
    }
}

// Who leaves the window does not wait for what nobody looks at any more.
TEST(BackgroundPyramidBuild, AreGivenUp) {
    const Region region = hills(3000);
    const auto start = std::chrono::steady_clock::now();
    double whole_s = 0.0;
    {
        BackgroundPyramidBuild finer(region, 1.0, false);
        ASSERT_TRUE(finer.wait().ok());
        whole_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    const auto again = std::chrono::steady_clock::now();
    { const BackgroundPyramidBuild finer(region, 1.0, false); }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - again).count(), 0.7 * whole_s);
}

}  // namespace
}  // namespace oro
