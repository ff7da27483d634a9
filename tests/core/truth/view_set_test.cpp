// Made cameras: the same from the same seed, within what they promise.
#include "core/truth/view_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/terrain/ground.h"
#include "core/truth/oracle.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

void expect_same(const Camera& a, const Camera& b) {
    EXPECT_EQ(a.eye.lat_deg, b.eye.lat_deg);
    EXPECT_EQ(a.eye.lon_deg, b.eye.lon_deg);
    EXPECT_EQ(a.eye.h_m, b.eye.h_m);
    EXPECT_EQ(a.attitude.heading_deg, b.attitude.heading_deg);
    EXPECT_EQ(a.attitude.pitch_deg, b.attitude.pitch_deg);
    EXPECT_EQ(a.attitude.roll_deg, b.attitude.roll_deg);
    EXPECT_EQ(a.vertical_fov_deg, b.vertical_fov_deg);
}

TEST(ViewSet, OneSeedMakesOneSet) {
    const HeightField field = test::rough_field(47.0, 8.0, 241, 301);
    const auto set = made_cameras(31, field, 20, 320, 180), again = made_cameras(31, field, 20, 320, 180);
    ASSERT_EQ(set.size(), 20U);
    ASSERT_EQ(again.size(), 20U);
    for (std::size_t i = 0; i < set.size(); ++i) expect_same(set[i], again[i]);
    // A longer set begins with a shorter one.
    const auto begun = made_cameras(31, field, 7, 320, 180);
    for (std::size_t i = 0; i < begun.size(); ++i) expect_same(set[i], begun[i]);
    const auto other = made_cameras(32, field, 20, 320, 180);
    for (std::size_t i = 0; i < set.size(); ++i) EXPECT_NE(set[i].eye.lat_deg, other[i].eye.lat_deg);
}

TEST(ViewSet, KeepsToItsRangesAndSpreadsOverThem) {
    const HeightField field = test::rough_field(47.0, 8.0, 241, 301);
    const PostGrid& grid = field.grid;
    std::mt19937_64 random(33);
    std::printf("seed 33\n");
    constexpr int count = 3000;
    int low = 0, high = 0, rolled = 0, level = 0;
    for (int i = 0; i < count; ++i) {
        const Camera camera = made_camera(random, field, 321, 123);
        ASSERT_EQ(camera.width_px, 321);
        ASSERT_EQ(camera.height_px, 123);
        ASSERT_GE(camera.vertical_fov_deg, 10.0);
        ASSERT_LE(camera.vertical_fov_deg, 90.0);
        ASSERT_GT(camera.eye.lat_deg, grid.south_deg());
        ASSERT_LT(camera.eye.lat_deg, grid.north_deg());
        ASSERT_GT(camera.eye.lon_deg, grid.west_deg());
        ASSERT_LT(camera.eye.lon_deg, grid.east_deg());
        const double above_m =
            camera.eye.h_m - ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg).value();
        ASSERT_GE(above_m, 2.0 - 1e-6);
        ASSERT_LE(above_m, 500000.0 + 1e-6);
        ASSERT_GE(camera.attitude.heading_deg, 0.0);
        ASSERT_LE(camera.attitude.heading_deg, 360.0);
        ASSERT_GE(camera.attitude.pitch_deg, -89.0);
        ASSERT_LE(camera.attitude.pitch_deg, above_m < 5000.0 ? 5.0 : -25.0);
        ASSERT_LE(std::abs(camera.attitude.roll_deg), 180.0);
        low += above_m < 20.0 ? 1 : 0;
        high += above_m > 50000.0 ? 1 : 0;
        rolled += camera.attitude.roll_deg != 0.0 ? 1 : 0;
        level += camera.attitude.pitch_deg > -25.0 ? 1 : 0;
    }
    // A decade of height has log(10) / log(2.5e5) = 18.5 % of them. 63 % are below 5 km (log(2500) /
    // log(2.5e5)), half of these level. Five standard deviations of 3,000 are at most 4.6 %.
    EXPECT_NEAR(low, 0.185 * count, 0.046 * count);
    EXPECT_NEAR(high, 0.185 * count, 0.046 * count);
    EXPECT_NEAR(rolled, count / 3.0, 0.046 * count);
    EXPECT_NEAR(level, 0.315 * count, 0.046 * count);
}

TEST(ViewSet, EachSeesGround) {
    const HeightField field = test::rough_field(47.0, 8.0, 241, 301);
    const TrueSurface surface(field, 1.0, 2);
    std::printf("seed 34\n");
    for (Camera camera : made_cameras(34, field, 20, 320, 180)) {
        camera.width_px = 48;
        camera.height_px = 27;
        int ground = 0;
        for (const auto& hit : Oracle(surface, sight_from(camera.eye)).cast_picture(camera, 2))
            ground += hit ? 1 : 0;
        // A tenth of a coarse picture is ground; counted more finely, most of that.
        EXPECT_GE(ground, 0.05 * 48 * 27);
    }
}

// Nothing but voids: cameras over sea level, though none sees anything.
TEST(ViewSet, VoidsCountAsSeaLevel) {
    const HeightField field =
        test::made_field(47.0, 8.0, 1200.0, 50, 50, [](double, double) { return void_height_m; });
    for (const Camera& camera : made_cameras(35, field, 2, 64, 36)) {
        EXPECT_GE(camera.eye.h_m, 2.0 - 1e-9);
        EXPECT_LE(camera.eye.h_m, 500000.0 + 1e-6);
    }
}

}  // namespace
}  // namespace oro
