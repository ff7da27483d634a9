// Turning round a place: its distance and its pixel stay.
#include "apps/navigation/orbit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "tests/commands/navigation/smooth_world.h"

namespace oro {
namespace {

using test::hill_h_m;

double distance_to_m(const Camera& camera, const Ecef& place) {
    return glm::distance(camera.eye_ecef().m, place.m);
}

TEST(Orbit, KeepsTheDistanceAndThePixelOfThePivot) {
    constexpr unsigned seed = 60;
    std::printf("seed %u\n", seed);
    test::RandomEyes eyes(seed);
    double most_px = 0.0, most_share = 0.0;
    int moved = 0, asked = 0;
    for (int i = 0; i < 200; ++i) {
        const Camera camera = eyes.camera();
        const glm::dvec2 point_px = eyes.pixel(camera);
        const auto pivot = test::hill_at(camera, point_px);
        if (!pivot) continue;
        ++asked;
        const Camera there =
            orbited(camera, *pivot, eyes.between(-180.0, 180.0), eyes.between(-30.0, 30.0), hill_h_m);
        ASSERT_TRUE(test::is_sound(there)) << i;
        const double was_m = distance_to_m(camera, *pivot);
        const double off_m = std::abs(distance_to_m(there, *pivot) - was_m);
        EXPECT_LE(off_m, 1e-9 * was_m + 1e-8) << i;
        EXPECT_LE(glm::distance(test::shown_px(there, *pivot), point_px), 0.5) << i;
        EXPECT_EQ(there.attitude.roll_deg, 0.0);
        most_px = std::max(most_px, glm::distance(test::shown_px(there, *pivot), point_px));
        most_share = std::max(most_share, off_m / was_m);
        moved += distance_to_m(there, camera.eye_ecef()) > 0.0 ? 1 : 0;
    }
    std::printf("orbit: at most %.2g px, distances to %.2g of themselves, %d of %d moved\n", most_px,
                most_share, moved, asked);
    EXPECT_LT(most_px, 0.05);
    EXPECT_GE(asked, 120);
    EXPECT_GE(moved, asked * 95 / 100);
}

// 1,000 m south of a place and 1,000 m over it, looking at it: 90 degrees clockwise as seen from above is
// west.
TEST(Orbit, TurnsClockwiseAsSeenFromAbove) {
    const Geodetic place{46.0, 8.0, 500.0};
    const Ecef pivot = ecef_from_geodetic(place);
    Camera camera;
    camera.width_px = 960, camera.height_px = 600;
    camera.eye = geodetic_from_ecef({pivot.m + ecef_from_enu(46.0, 8.0) * glm::dvec3(0.0, -1000.0, 1000.0)});
    camera.attitude = attitude_towards(camera.eye, place);
    const auto flat = [](double, double) { return std::optional(0.0); };
    const Camera west = orbited(camera, pivot, 90.0, 0.0, flat);
    const glm::dvec3 enu = glm::transpose(ecef_from_enu(46.0, 8.0)) * (west.eye_ecef().m - pivot.m);
    EXPECT_NEAR(enu.x, -1000.0, 1e-6);
    EXPECT_NEAR(enu.y, 0.0, 1e-6);
    EXPECT_NEAR(enu.z, 1000.0, 1e-6);
    EXPECT_NEAR(west.attitude.heading_deg, 90.0, 0.02);
    EXPECT_NEAR(west.attitude.pitch_deg, -45.0, 0.02);
    const Camera steeper = orbited(camera, pivot, 0.0, -20.0, flat);
    EXPECT_NEAR(steeper.attitude.pitch_deg, -65.0, 0.02);
    const Camera steepest = orbited(camera, pivot, 0.0, -200.0, flat);
    EXPECT_NEAR(steepest.attitude.pitch_deg, -most_orbit_pitch_deg, 0.02);
    EXPECT_GE(steepest.attitude.pitch_deg, -most_orbit_pitch_deg);
}

// Over flat ground at 0 m an eye that is turned down is stopped by its clearance: its elevation from a pivot
// on that ground, 1,000 m away, is asin(1.7 / 1000).
TEST(Orbit, StopsOverTheGround) {
    const Ecef pivot = ecef_from_geodetic({46.0, 8.0, 0.0});
    Camera camera;
    camera.width_px = 960, camera.height_px = 600;
    camera.eye = geodetic_from_ecef({pivot.m + ecef_from_enu(46.0, 8.0) * glm::dvec3(0.0, -600.0, 800.0)});
    camera.attitude = attitude_towards(camera.eye, {46.0, 8.0, 0.0});
    const auto flat = [](double, double) { return std::optional(0.0); };
    const Camera low = orbited(camera, pivot, 30.0, 80.0, flat);
    EXPECT_NEAR(low.eye.h_m, eye_clearance_m, 1e-3);
    EXPECT_NEAR(distance_to_m(low, pivot), 1000.0, 1e-6);
    const auto no_data = [](double, double) { return std::optional<double>(); };
    EXPECT_LT(orbited(camera, pivot, 0.0, 80.0, no_data).eye.h_m, 0.0);
}

TEST(Orbit, NorthUpTurnsRoundThePivot) {
    test::RandomEyes eyes(61);
    int asked = 0;
    for (int i = 0; i < 50; ++i) {
        Camera camera = eyes.camera();
        if (std::abs(camera.eye.lat_deg) > 80.0) continue;
        const glm::dvec2 middle_px(480.0, 300.0);
        const auto pivot = test::hill_at(camera, middle_px);
        if (!pivot) continue;
        const Camera north = north_up(camera, pivot, 0.0, hill_h_m);
        EXPECT_EQ(north.attitude.heading_deg, 0.0) << i;
        ASSERT_TRUE(test::is_sound(north)) << i;
        const double off_px = glm::distance(test::shown_px(north, *pivot), middle_px);
        asked += off_px < 0.5 ? 1 : 0;
    }
    EXPECT_GE(asked, 15);
    Camera sky;
    sky.attitude = {77.0, 5.0, 3.0};
    const Camera north = north_up(sky, std::nullopt, 3.0, hill_h_m);
    EXPECT_EQ(north.attitude.heading_deg, 0.0);
    EXPECT_EQ(north.attitude.pitch_deg, 5.0);
    EXPECT_EQ(north.attitude.roll_deg, 3.0);
}

}  // namespace
}  // namespace oro
