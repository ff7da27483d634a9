// Directions on a cylinder: literal places, and there and back.
#include "core/earth/cylinder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

namespace oro {
namespace {

// All around in 3600 px: 10 px for each degree, 1800 / pi = 572.957795... for a radian.
TEST(Cylinder, HasDirectionsAtTheirPlaces) {
    const Cylinder around = cylinder_around(0.0, 360.0, -45.0, 45.0, 3600);
    EXPECT_NEAR(around.px_per_rad(), 572.95779513082323, 1e-9);
    EXPECT_EQ(around.above_px, 573);
    EXPECT_EQ(around.below_px, 573);
    EXPECT_EQ(around.height_px(), 1146);
    const auto at = [&](double east, double north, double up) { return around.place_px({east, north, up}); };
    EXPECT_NEAR(at(1.0, 0.0, 0.0).x, 900.0, 1e-9);  // east
    EXPECT_NEAR(at(1.0, 0.0, 0.0).y, 573.0, 1e-9);  // level
    EXPECT_NEAR(at(0.0, -2.0, 0.0).x, 1800.0, 1e-9);
    EXPECT_NEAR(at(-1.0, 0.0, 1.0).x, 2700.0, 1e-9);
    EXPECT_NEAR(at(-1.0, 0.0, 1.0).y, 573.0 - 572.95779513082323, 1e-9);  // 45 degrees up
    EXPECT_NEAR(at(3.0, 4.0, -2.5).y, 573.0 + 0.5 * 572.95779513082323, 1e-9);
    EXPECT_EQ(at(0.0, 1.0, 0.0).x, 0.0);
    EXPECT_NEAR(around.azimuth_deg_at(900.0), 90.0, 1e-12);
    EXPECT_NEAR(around.elevation_deg_at(573.0), 0.0, 1e-12);
    EXPECT_TRUE(std::isinf(at(0.0, 0.0, 1.0).y));
    EXPECT_FALSE(around.holds(at(0.0, 0.0, 1.0)));
}

TEST(Cylinder, HoldsASectorOverNorth) {
    const Cylinder around = cylinder_around(-60.0, 90.0, -20.0, 5.0, 900);
    EXPECT_EQ(around.from_deg, 300.0);
    EXPECT_NEAR(around.place_px({0.0, 1.0, 0.0}).x, 600.0, 1e-9);
    EXPECT_TRUE(around.holds(around.place_px({0.0, 1.0, -0.1})));
    EXPECT_FALSE(around.holds(around.place_px({1.0, 0.0, -0.1})));   // right of it
    EXPECT_FALSE(around.holds(around.place_px({-1.0, 0.0, -0.1})));  // left of it
    EXPECT_FALSE(around.holds(around.place_px({0.0, 1.0, 0.1})));    // 5.7 degrees: above it
    EXPECT_NEAR(around.azimuth_deg_at(900.0), 30.0, 1e-12);
    // tan 5 = 0.0874887, tan 20 = 0.3639702, times 572.958.
    EXPECT_EQ(around.above_px, 50);
    EXPECT_EQ(around.below_px, 209);
}

// A scene that lies wholly above level, or below it.
TEST(Cylinder, NeedNotHoldTheLevelLine) {
    const Cylinder high = cylinder_around(0.0, 360.0, 10.0, 45.0, 3600);
    EXPECT_EQ(high.above_px, 573);
    EXPECT_EQ(high.below_px, -101);  // tan 10 = 0.1763270
    EXPECT_EQ(high.height_px(), 472);
    EXPECT_NEAR(high.elevation_deg_at(high.height_px()), 10.0, 0.01);
}

TEST(Cylinder, IsTheSameThereAndBack) {
    std::mt19937 random(11);  // the seed
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        const Cylinder around = cylinder_around(720.0 * share(random) - 360.0, 0.1 + 359.9 * share(random),
                                                -60.0 * share(random), 1.0 + 60.0 * share(random), 2000);
        const glm::dvec2 place(share(random) * around.width_px, share(random) * around.height_px());
        const glm::dvec2 again = around.place_px(3.0 * around.enu_at(place));
        EXPECT_NEAR(again.x, place.x, 1e-7) << i;
        EXPECT_NEAR(again.y, place.y, 1e-7) << i;
        EXPECT_NEAR(std::remainder(around.azimuth_deg_at(place.x) -
                                       std::atan2(around.enu_at(place).x, around.enu_at(place).y) * 180.0 /
                                           std::numbers::pi,
                                   360.0),
                    0.0, 1e-9);
    }
}

}  // namespace
}  // namespace oro
