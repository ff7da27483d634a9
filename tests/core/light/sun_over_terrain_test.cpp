// First and last light over terrain, against a scan that knows nothing of how they were found.
#include "core/light/sun_over_terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/base/parallel.h"
#include "core/terrain/ground.h"
#include "tests/core/light/sun_scan.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double midsummer_utc_s = 1782000000.0;  // 2026-06-21T00:00Z

// A flat sea, seen from its shore: the plain horizon's times, but for the almanac's 34' of refraction, which
// is 34.5' here: 3 s.
TEST(SunOverTerrain, OverTheSeaItIsThePlainHorizons) {
    const HeightField field = test::made_field(47.0, 8.0, 60.0, 61, 61, [](double, double) { return 0.0F; });
    const TrueSurface surface(field, 1.0, 2);
    for (const double from_utc_s : {midsummer_utc_s, midsummer_utc_s + 183 * 86400.0}) {
        const Geodetic eye{46.5, 8.5, 0.5};
        const SunDayEvents plain = sun_day(from_utc_s, eye);
        const SunDayEvents seen = sun_day(from_utc_s, SunOverTerrain(surface, eye, standard_air, 0.0), 2);
        ASSERT_EQ(seen.crossings.size(), 2U);
        ASSERT_EQ(plain.crossings.size(), 2U);
        for (std::size_t i = 0; i < 2; ++i) {
            // The eye stands half a metre above the sea: its horizon lies 1.3' below level, 8 to 12 s.
            EXPECT_NEAR(seen.crossings[i].time_utc_s, plain.crossings[i].time_utc_s, 20.0);
            EXPECT_EQ(seen.crossings[i].rising, plain.crossings[i].rising);
        }
    }
}

// A wall of 1,000 m, 10 km to the east: its top stands 5.7 degrees high, whatever the azimuth's part.
TEST(SunOverTerrain, AWallInTheEastDelaysTheMorningAlone) {
    const HeightField field = test::made_field(
        47.0, 8.0, 120.0, 121, 121, [](double, double lon_deg) { return lon_deg > 8.63 ? 1000.0F : 0.0F; });
    const TrueSurface surface(field, 1.0, 2);
    const Geodetic eye{46.5, 8.5, 2.0};
    const SunDayEvents plain = sun_day(midsummer_utc_s + 92 * 86400.0, eye);
    const SunDayEvents seen =
        sun_day(midsummer_utc_s + 92 * 86400.0, SunOverTerrain(surface, eye, {}, 0.0), 2);
    ASSERT_EQ(seen.crossings.size(), 2U);
    const SunPosition first = sun_position(seen.crossings[0].time_utc_s, eye);
    EXPECT_NEAR(first.elevation_deg + first.radius_deg, 5.7, 0.3);
    EXPECT_GT(seen.crossings[0].time_utc_s, plain.crossings[0].time_utc_s + 1800.0);
    EXPECT_NEAR(seen.crossings[1].time_utc_s, plain.crossings[1].time_utc_s, 60.0);
}

// Polar night and day, and a pit that the winter's sun never reaches.
TEST(SunOverTerrain, TellsAllDayAndNever) {
    const auto day_at = [](double lat_deg, double from_utc_s, float rim_m) {
        const HeightField field =
            test::made_field(lat_deg + 0.25, 10.0, 240.0, 121, 121, [&](double lat, double lon) {
                return std::hypot(lat - lat_deg, (lon - 10.25) * 0.5) > 0.05 ? rim_m : 0.0F;
            });
        const TrueSurface surface(field, 1.0, 2);
        return sun_day(from_utc_s, SunOverTerrain(surface, {lat_deg, 10.25, 2.0}, {}, 0.0), 2);
    };
    const double midwinter_utc_s = midsummer_utc_s + 183 * 86400.0;
    EXPECT_EQ(day_at(78.0, midsummer_utc_s, 0.0F).day, SunDay::up_all_day);
    EXPECT_EQ(day_at(78.0, midwinter_utc_s, 0.0F).day, SunDay::down_all_day);
    EXPECT_EQ(day_at(60.0, midwinter_utc_s, 2000.0F).day, SunDay::down_all_day);
    EXPECT_EQ(up_s(day_at(78.0, midsummer_utc_s, 0.0F), midsummer_utc_s), 86400.0);
    EXPECT_EQ(up_s(day_at(60.0, midwinter_utc_s, 2000.0F), midwinter_utc_s), 0.0);
}

// Rough terrain, on a winter day (tests/geo has the Alps): each crossing within 10 s of the scan's, and none
// left out.
TEST(SunOverTerrain, WithinTenSecondsOfBruteForce) {
    const HeightField field = test::rough_field(46.6, 8.0, 481, 481);
    const TrueSurface surface(field, 1.0, 2);
    double largest_s = 0.0;
    int crossings = 0;
    const struct { double lat_deg, lon_deg, above_m, day; } eyes[] = {{46.38, 8.17, 50.0, 183.0}};
    for (const auto& one : eyes) {
        const Geodetic eye{one.lat_deg, one.lon_deg,
                           *ground_h_m(field, one.lat_deg, one.lon_deg) + one.above_m};
        const double from_utc_s = midsummer_utc_s + one.day * 86400.0;
        const SunDayEvents found = sun_day(from_utc_s, SunOverTerrain(surface, eye, standard_air, 0.0), 2);
        const std::vector<SunCrossing> scanned =
            test::scanned_crossings(surface, eye, standard_air, from_utc_s, thread_count());
        ASSERT_EQ(found.crossings.size(), scanned.size());
        for (std::size_t i = 0; i < scanned.size(); ++i) {
            EXPECT_EQ(found.crossings[i].rising, scanned[i].rising);
            EXPECT_NEAR(found.crossings[i].time_utc_s, scanned[i].time_utc_s, 10.0);
            largest_s = std::max(largest_s, std::abs(found.crossings[i].time_utc_s - scanned[i].time_utc_s));
            ++crossings;
        }
    }
    EXPECT_GE(crossings, 2);
    std::printf("%d crossings, largest difference %.2f s\n", crossings, largest_s);
}

}  // namespace
}  // namespace oro
