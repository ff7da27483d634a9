// The way home: a region that is out of the picture has an arrow.
#include "apps/navigation/home.h"

#include <gtest/gtest.h>

#include <cmath>

#include "apps/navigation/flight_step.h"
#include "apps/navigation/grab.h"

namespace oro {
namespace {

// A degree around 46.5 N, 8.5 E.
const GroundBox home_ground{{8.0, 46.0, 9.0, 47.0}, 200.0, 4500.0};

Camera looking(double lat_deg, double lon_deg, double h_m, double heading_deg, double pitch_deg) {
    Camera camera;
    camera.eye = {lat_deg, lon_deg, h_m};
    camera.attitude = {heading_deg, pitch_deg, 0.0};
    camera.width_px = 960, camera.height_px = 600;
    return camera;
}

TEST(HomeArrow, IsNotThereWhereGroundIsInThePicture) {
    EXPECT_FALSE(home_arrow(looking(46.5, 8.5, 3000.0, 0.0, -20.0), home_ground));
    EXPECT_FALSE(home_arrow(looking(46.5, 8.5, 600.0, 90.0, -89.0), home_ground));  // a few metres of it
    EXPECT_FALSE(home_arrow(looking(44.0, 8.5, 1e5, 0.0, -20.0), home_ground));
    EXPECT_FALSE(home_arrow(looking(20.0, 8.5, 2e7, 0.0, -90.0), home_ground));
}

// South of the region and looking south it is behind; looking east it is to the left; looking up, below.
TEST(HomeArrow, PointsTheShortestWay) {
    const auto left = home_arrow(looking(44.0, 8.5, 3000.0, 90.0, -5.0), home_ground);
    ASSERT_TRUE(left);
    EXPECT_NEAR(left->point_px.x, 32.0, 1e-9);
    EXPECT_GT(left->clockwise_deg, 225.0);
    EXPECT_LT(left->clockwise_deg, 315.0);
    // 2.5 degrees of latitude: 277.9 km (111.13 km a degree around 45 N).
    EXPECT_NEAR(left->distance_m, 277850.0, 200.0);
    EXPECT_NEAR(left->bearing_deg, 0.0, 1e-9);
    const auto right = home_arrow(looking(44.0, 8.5, 3000.0, 270.0, -5.0), home_ground);
    ASSERT_TRUE(right);
    EXPECT_NEAR(right->point_px.x, 928.0, 1e-9);
    const auto below = home_arrow(looking(46.5, 8.5, 9000.0, 0.0, 80.0), home_ground);
    ASSERT_TRUE(below);
    EXPECT_NEAR(below->point_px.y, 568.0, 1e-9);
    EXPECT_NEAR(below->clockwise_deg, 180.0, 10.0);
    const auto behind = home_arrow(looking(44.0, 8.5, 3000.0, 180.0, 0.0), home_ground);
    ASSERT_TRUE(behind);
}

TEST(HomeArrow, AsksTheBoxOfTheRegionsGround) {
    EXPECT_FALSE(ground_box({}));
    GroundPoints ground;
    ground.middle = {10.5, 179.9, 0.0};
    for (const Geodetic& place :
         {Geodetic{10.0, 179.0, 20.0}, Geodetic{11.0, 179.5, -30.0}, Geodetic{10.5, -179.2, 900.0}})
        ground.all.push_back(ecef_from_geodetic(place));
    const auto around = ground_box(ground);
    ASSERT_TRUE(around);
    EXPECT_NEAR(around->box.west_deg, 179.0, 1e-9);
    EXPECT_NEAR(around->box.east_deg, -179.2, 1e-9) << "over the antimeridian";
    EXPECT_NEAR(around->box.south_deg, 10.0, 1e-9);
    EXPECT_NEAR(around->box.north_deg, 11.0, 1e-9);
    EXPECT_NEAR(around->low_h_m, -30.0, 1e-6);
    EXPECT_NEAR(around->high_h_m, 900.0, 1e-6);
}

// From the other side of the Earth, straight down: the region is before the eye, but the Earth hides it.
TEST(HomeArrow, IsThereWhereTheEarthHidesTheRegion) {
    const auto arrow = home_arrow(looking(-46.5, -171.5, 1e7, 0.0, -90.0), home_ground);
    ASSERT_TRUE(arrow);
    EXPECT_NEAR(arrow->distance_m, 2.0e7, 1e5);
}

// Turning as the arrow points brings the region into the picture within half a turn.
TEST(HomeArrow, LeadsHome) {
    Camera camera = looking(44.0, 8.5, 3000.0, 123.0, 10.0);
    int steps = 0;
    while (const auto arrow = home_arrow(camera, home_ground)) {
        const double rad = radians_from_deg(arrow->clockwise_deg).rad;
        camera = turned(camera, 5.0 * std::sin(rad), 5.0 * std::cos(rad));
        ASSERT_LT(++steps, 40);
    }
    EXPECT_GT(steps, 5);
}

TEST(HomeArrow, KnowsBoxesAcrossTheAntimeridian) {
    const GroundBox fiji{{177.0, -19.0, -178.0, -16.0}, 0.0, 1300.0};
    EXPECT_FALSE(home_arrow(looking(-17.5, -179.5, 5000.0, 0.0, -60.0), fiji));
    const auto arrow = home_arrow(looking(-17.5, -175.0, 5000.0, 90.0, -10.0), fiji);
    ASSERT_TRUE(arrow);
    EXPECT_NEAR(arrow->bearing_deg, 270.0, 2.0);
}

// Points of a ball of 5 km around a place: the home view has them all in its picture.
TEST(FramedHome, HasAllGroundInThePicture) {
    GroundPoints ground;
    ground.middle = {46.5, 8.5, 1000.0};
    ground.radius_m = 5000.0;
    const glm::dvec3 middle_m = ecef_from_geodetic(ground.middle).m;
    for (int i = 0; i < 6; ++i) {
        glm::dvec3 offset_m(0.0);
        offset_m[i / 2] = i % 2 == 0 ? 5000.0 : -5000.0;
        ground.all.push_back({middle_m + offset_m});
    }
    const Camera camera = looking(0.0, 0.0, 10.0, 77.0, 3.0);
    const auto home = framed_home(camera, ground);
    ASSERT_TRUE(home);
    for (const Ecef& point : ground.all) {
        const auto seen_px = pixel_of(*home, point);
        ASSERT_TRUE(seen_px);
        EXPECT_GT(seen_px->x, 47.0);
        EXPECT_LT(seen_px->x, 913.0);
        EXPECT_GT(seen_px->y, 29.0);
        EXPECT_LT(seen_px->y, 571.0);
    }
    EXPECT_FALSE(framed_home(camera, {}));
}

}  // namespace
}  // namespace oro
