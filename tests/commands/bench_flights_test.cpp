// Flights of the benchmark: the same from one seed, over the region, as fast as they are high, without jumps.
#include "apps/bench/times/bench_flights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/earth/ellipsoid.h"
#include "core/terrain/ground.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

TEST(RandomFlights, GoAsFastAsTheyAreHigh) {
    const HeightField field = test::rough_field(47.0, 8.0, 900, 1000);
    const auto pages = pages_in_memory(field, 1.0, 2);
    constexpr int count = 30, frames = 120;
    constexpr std::uint64_t seed = 511;
    const auto flights = random_flights(*pages, count, frames, seed, 640, 360);
    ASSERT_TRUE(flights.ok()) << flights.error().line();
    ASSERT_EQ(flights->size(), static_cast<std::size_t>(count));
    double slowest_m_s = 1e9, fastest_m_s = 0.0;
    for (const RandomFlight& flight : *flights) {
        SCOPED_TRACE("seed 511, " + flight.name);
        ASSERT_EQ(flight.cameras.size(), static_cast<std::size_t>(frames));
        for (std::size_t i = 0; i < flight.cameras.size(); ++i) {
            const Geodetic& eye = flight.cameras[i].eye;
            const auto ground_m = ground_h_m(field, eye.lat_deg, eye.lon_deg);
            ASSERT_TRUE(ground_m);
            EXPECT_GT(eye.h_m, *ground_m);
            if (i == 0) continue;
            const Camera& before = flight.cameras[i - 1];
            const Geodetic level{eye.lat_deg, eye.lon_deg, 0.0},
                level_before{before.eye.lat_deg, before.eye.lon_deg, 0.0};
            const double speed_m_s =
                glm::length(ecef_from_geodetic(level).m - ecef_from_geodetic(level_before).m) / flight_step_s;
            slowest_m_s = std::min(slowest_m_s, speed_m_s);
            fastest_m_s = std::max(fastest_m_s, speed_m_s);
            const double turn_deg =
                std::remainder(flight.cameras[i].attitude.heading_deg - before.attitude.heading_deg, 360.0);
            EXPECT_LE(std::abs(turn_deg), 60.0 * flight_step_s + 1e-9) << "a degree a frame";
        }
    }
    // On the ellipsoid, as on a map: within a hundredth. Slower where an eye meets the rim.
    EXPECT_GT(slowest_m_s, 0.0);
    EXPECT_LT(fastest_m_s, 5050.0);
    EXPECT_GT(fastest_m_s, 500.0) << "30 flights begin at up to 20 km";
    EXPECT_EQ(random_flight_speed_m_s(10.0), 50.0);
    EXPECT_EQ(random_flight_speed_m_s(1000.0), 500.0);
    EXPECT_EQ(random_flight_speed_m_s(1e5), 5000.0);
}

TEST(RandomFlights, AreTheSameFromOneSeed) {
    const HeightField field = test::rough_field(47.0, 8.0, 300, 400);
    const auto pages = pages_in_memory(field, 1.0, 2);
    const auto one = random_flights(*pages, 3, 20, 5, 640, 360),
               again = random_flights(*pages, 3, 20, 5, 640, 360),
               other = random_flights(*pages, 3, 20, 6, 640, 360);
    ASSERT_TRUE(one.ok() && again.ok() && other.ok());
    for (std::size_t i = 0; i < one->size(); ++i) {
        EXPECT_EQ((*one)[i].name, (*again)[i].name);
        EXPECT_EQ((*one)[i].cameras.back().eye.lon_deg, (*again)[i].cameras.back().eye.lon_deg);
        EXPECT_NE((*one)[i].name, (*other)[i].name);
    }
}

}  // namespace
}  // namespace oro
