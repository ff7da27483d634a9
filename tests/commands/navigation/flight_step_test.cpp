// The viewer's eye: where it goes, and that it stays above the ground.
#include "apps/navigation/flight_step.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/terrain/ground.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

Camera eye_at(double lat_deg, double lon_deg, double h_m, double heading_deg) {
    Camera camera;
    camera.eye = {lat_deg, lon_deg, h_m};
    camera.attitude = {heading_deg, 0.0, 0.0};
    return camera;
}

TEST(FlightStepping, SpeedFollowsTheHeightOverTheGround) {
    EXPECT_DOUBLE_EQ(flight_speed_m_s(2.0), 5.0);
    EXPECT_DOUBLE_EQ(flight_speed_m_s(300.0), 300.0);
    EXPECT_DOUBLE_EQ(flight_speed_m_s(2000.0), 2000.0);
    EXPECT_DOUBLE_EQ(flight_speed_m_s(12000.0), 6000.0);
    EXPECT_DOUBLE_EQ(flight_speed_m_s(1e9), 5e6);
}

// 1,000 m over flat ground at 0 m, one second forward: 1,000 m to the north is 1000 / 111,320 degree at 60 N
// within 1 %.
TEST(FlightStepping, GoesForwardAlongTheHeading) {
    const HeightField flat =
        test::made_field(61.0, 10.0, 100.0, 201, 201, [](double, double) { return 0.0F; });
    FlightStep step;
    step.forward = 1.0;
    step.elapsed_s = 1.0;
    const Camera north = flown(eye_at(60.0, 11.0, 1000.0, 0.0), step, flat, 1.0);
    EXPECT_NEAR(north.eye.lat_deg, 60.0 + 1000.0 / 111412.0, 1e-5);
    EXPECT_NEAR(north.eye.lon_deg, 11.0, 1e-9);
    EXPECT_NEAR(north.eye.h_m, 1000.0, 1e-6);
    const Camera east = flown(eye_at(60.0, 11.0, 1000.0, 90.0), step, flat, 1.0);
    EXPECT_NEAR(east.eye.lon_deg, 11.0 + 1000.0 / 55800.0, 1e-5);
    step.fast = true;
    const Camera far = flown(eye_at(60.0, 11.0, 1000.0, 0.0), step, flat, 1.0);
    EXPECT_NEAR(far.eye.lat_deg, 60.0 + 5000.0 / 111412.0, 5e-5);
}

TEST(FlightStepping, CrossesAPoleAndGoesOn) {
    const HeightField none = test::made_field(10.0, 10.0, 1.0, 3, 3, [](double, double) { return 0.0F; });
    FlightStep step;
    step.forward = 1.0;
    step.elapsed_s = 1.0;
    Camera camera = eye_at(89.99, 20.0, 1000.0, 0.0);  // 1.1 km before the pole
    camera = flown(flown(camera, step, none, 1.0), step, none, 1.0);
    EXPECT_NEAR(std::abs(camera.eye.lon_deg - 20.0), 180.0, 1e-6);
    EXPECT_NEAR(camera.attitude.heading_deg, 180.0, 1e-6);
    EXPECT_LT(camera.eye.lat_deg, 89.995);
}

TEST(FlightStepping, PitchStopsAtTheVertical) {
    const HeightField none = test::made_field(10.0, 10.0, 1.0, 3, 3, [](double, double) { return 0.0F; });
    FlightStep step;
    step.turn_up_deg = 300.0;
    step.turn_right_deg = -30.0;
    const Camera camera = flown(eye_at(0.0, 0.0, 10.0, 10.0), step, none, 1.0);
    EXPECT_DOUBLE_EQ(camera.attitude.pitch_deg, 90.0);
    EXPECT_DOUBLE_EQ(camera.attitude.heading_deg, 340.0);
}

TEST(FlightStepping, NeverGoesBelowTheGround) {
    constexpr unsigned seed = 5;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const HeightField field = test::rough_field(46.9, 8.1, 300, 300);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    Camera camera = above_ground(eye_at(46.8, 8.2, -5000.0, 0.0), field, 1.0);
    for (int i = 0; i < 5000; ++i) {
        FlightStep step{any(random), any(random), any(random) - 0.5, i % 7 == 0, 20.0 * any(random),
                        any(random), 0.25};
        camera = flown(camera, step, field, 1.0);
        const auto ground = ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg);
        if (!ground)
            camera = above_ground(eye_at(46.8, 8.2, -5000.0, 0.0), field, 1.0);
        else
            ASSERT_GE(camera.eye.h_m, *ground + eye_clearance_m - 1e-6) << "step " << i;
    }
}

}  // namespace
}  // namespace oro
