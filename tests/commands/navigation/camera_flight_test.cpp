// Flights between views: their ends, their steps, and that the eye stays above the ground.
#include "apps/navigation/camera_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "apps/navigation/view_history.h"
#include "core/earth/world_model.h"
#include "geo/places/geodesic.h"
#include "tests/commands/navigation/smooth_world.h"

namespace oro {
namespace {

using test::hill_h_m;

double over_ground_m(const Camera& camera) {
    return camera.eye.h_m - *hill_h_m(camera.eye.lat_deg, camera.eye.lon_deg);
}

// How far the picture's axes turn, in degrees.
double turn_between_deg(const Camera& a, const Camera& b) {
    const glm::dmat3 from = a.view_from_ecef(), to = b.view_from_ecef();
    double cosine = -1.0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column) cosine += from[column][row] * to[column][row];
    return deg_from_radians(Radians{std::acos(std::clamp(0.5 * cosine, -1.0, 1.0))});
}

double vertical_turn_deg(const Camera& a, const Camera& b) {
    const glm::dvec3 from = ecef_from_enu(a.eye.lat_deg, a.eye.lon_deg)[2];
    const glm::dvec3 to = ecef_from_enu(b.eye.lat_deg, b.eye.lon_deg)[2];
    return deg_from_radians(Radians{2.0 * std::asin(std::min(1.0, 0.5 * glm::distance(from, to)))});
}

// Ground passes at up to 1.875 (the easing) S / 3 s (S of the source) times the height: flights half around
// the Earth from eye level to eye level have S = 2 ln(2e7 / 1.7) / 1.42, some 24, and a frame at 60 frames a
// second then moves the eye by at most exp(0.25 * 1.42) - 1 of its height: 0.45 with some room for the
// ground's own slopes. Turning takes a second for 90 degrees, 3 for 180 and more: 1.875 * 180 / 3 / 60 = 1.9
// degrees a frame, twice that with the pitch's dip; and the eye's vertical turns as it goes around the Earth.
TEST(CameraFlight, StartsEndsAndIsContinuous) {
    constexpr unsigned seed = 70;
    std::printf("seed %u\n", seed);
    test::RandomEyes eyes(seed);
    double most_step = 0.0, most_turn_deg = 0.0, most_s = 0.0;
    for (int i = 0; i < 100; ++i) {
        const Camera from = eyes.camera();
        Camera to = eyes.camera();
        if (i % 2 == 0) {  // near ones, too
            to.eye = from.eye;
            to.eye.lat_deg = std::clamp(from.eye.lat_deg + eyes.between(-0.05, 0.05), -90.0, 90.0);
            to.eye.lon_deg = normalised_lon_deg(from.eye.lon_deg + eyes.between(-0.05, 0.05));
            to.eye.h_m = *hill_h_m(to.eye.lat_deg, to.eye.lon_deg) + eyes.between(2.0, 3000.0);
        }
        const Flight flight(from, to, hill_h_m);
        EXPECT_GE(flight.duration_s(), shortest_flight_s);
        EXPECT_LE(flight.duration_s(), longest_flight_s);
        most_s = std::max(most_s, flight.duration_s());
        EXPECT_TRUE(is_same_view(flight.camera_at(0.0), from));
        EXPECT_TRUE(is_same_view(flight.camera_at(flight.duration_s()), to));
        EXPECT_TRUE(is_same_view(flight.camera_at(1e9), to));
        Camera last = from;
        for (double time_s = 0.0; time_s < flight.duration_s() + 0.02; time_s += 1.0 / 60.0) {
            const Camera there = flight.camera_at(time_s);
            ASSERT_TRUE(test::is_sound(there))
                << i << " at " << time_s << " h " << there.eye.h_m << " over " << over_ground_m(there)
                << " pitch " << there.attitude.pitch_deg << " heading " << there.attitude.heading_deg;
            const double ground_m = radians_from_deg(vertical_turn_deg(there, last)).rad * mean_radius_m;
            const double step_m = std::hypot(ground_m, there.eye.h_m - last.eye.h_m);
            const double least_m = std::min(over_ground_m(there), over_ground_m(last));
            const double turn_deg = turn_between_deg(there, last) - vertical_turn_deg(there, last);
            EXPECT_LT(step_m, 0.45 * least_m + 1e-6) << i << " at " << time_s;
            EXPECT_LT(turn_deg, 4.0) << i << " at " << time_s << " of " << flight.duration_s() << " lat "
                                     << from.eye.lat_deg << " lon " << from.eye.lon_deg << " h "
                                     << from.eye.h_m << " hdg " << from.attitude.heading_deg << " to "
                                     << to.eye.lat_deg << " " << to.eye.lon_deg << " p "
                                     << from.attitude.pitch_deg << " there " << there.eye.lat_deg << " "
                                     << there.eye.lon_deg << " h " << there.eye.h_m << " hdg "
                                     << there.attitude.heading_deg << " p " << there.attitude.pitch_deg
                                     << " step " << step_m;
            most_step = std::max(most_step, step_m / least_m);
            most_turn_deg = std::max(most_turn_deg, turn_deg);
            last = there;
        }
    }
    std::printf("flight: steps of at most %.3f of the height, turns of at most %.2f deg, %.2f s\n", most_step,
                most_turn_deg, most_s);
}

// From 500 m over Bern to 500 m over Zurich, 95 km: by the source's eq. 9 the eye is highest half way, at
// about rho^2 / 2 of the distance (w0 small), 96 km, on the geodesic.
TEST(CameraFlight, RisesAsFarAsTheDistanceAsks) {
    Camera from, to;
    from.eye = {46.948, 7.447, 500.0};
    to.eye = {47.377, 8.542, 500.0};
    const Flight flight(from, to, [](double, double) { return std::optional(0.0); });
    const Camera middle = flight.camera_at(0.5 * flight.duration_s());
    const GeodesicPath whole = geodesic_between(46.948, 7.447, 47.377, 8.542);
    const GeodesicPath half = geodesic_between(46.948, 7.447, middle.eye.lat_deg, middle.eye.lon_deg);
    EXPECT_NEAR(half.distance_m, 0.5 * whole.distance_m, 0.01);
    EXPECT_NEAR(half.bearing_deg, whole.bearing_deg, 1e-6);
    EXPECT_NEAR(middle.eye.h_m, 0.5 * 1.42 * 1.42 * whole.distance_m, 0.01 * whole.distance_m);
    EXPECT_LT(middle.attitude.pitch_deg, -55.0);
}

TEST(CameraFlight, TurnsAloneWhereTheEyeStays) {
    Camera from, to;
    from.eye = to.eye = {46.0, 8.0, 2000.0};
    from.attitude = {350.0, -10.0, 0.0};
    to.attitude = {20.0, -10.0, 0.0};
    const Flight flight(from, to, [](double, double) { return std::optional(0.0); });
    const Camera middle = flight.camera_at(0.5 * flight.duration_s());
    EXPECT_NEAR(middle.attitude.heading_deg, 5.0, 1e-9);
    EXPECT_EQ(middle.eye.lat_deg, 46.0);
    EXPECT_NEAR(middle.eye.h_m, 2000.0, 1e-9);
}

// Over an edge of 3,000 m, from its foot to its foot.
TEST(CameraFlight, PassesOverMountains) {
    Camera from, to;
    from.eye = {46.0, 8.0, 2.0};
    to.eye = {46.0, 8.02, 2.0};
    const auto ridge = [](double, double lon_deg) {
        return std::optional(std::abs(lon_deg - 8.002) < 0.001 ? 3000.0 : 0.0);
    };
    const Flight flight(from, to, ridge);
    for (double time_s = 0.0; time_s < flight.duration_s(); time_s += 0.01) {
        const Camera there = flight.camera_at(time_s);
        EXPECT_GE(there.eye.h_m, *ridge(0.0, there.eye.lon_deg) + eye_clearance_m) << time_s;
    }
}

}  // namespace
}  // namespace oro
