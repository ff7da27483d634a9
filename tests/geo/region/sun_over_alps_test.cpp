// First and last light in the Alps, against brute force: deep valleys and a pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "core/base/parallel.h"
#include "core/light/sun_over_terrain.h"
#include "core/terrain/ground.h"
#include "geo/region/region.h"
#include "tests/core/light/sun_scan.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace {

TEST(SunOverAlps, WithinTenSecondsOfBruteForce) {
    const auto alps = oro::test::real_data("alps");
    if (!alps) GTEST_SKIP() << "needs alps";
    oro::RegionRequest request;
    request.paths = {alps->string()};
    const auto box = oro::parse_tile_range("N46E007:N46E008");
    ASSERT_TRUE(box.ok());
    request.box = *box;
    const auto region = oro::test::open_grid(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const oro::TrueSurface surface(region->field, 1.0, oro::thread_count());
    const struct {
        const char* name;
        double lat_deg, lon_deg, from_utc_s;
    } eyes[] = {{"Grindelwald, 21 June 2026", 46.6240, 8.0400, 1781996400.0},
                {"Lauterbrunnen, 21 December 2026", 46.5930, 7.9090, 1797807600.0}};
    for (const auto& one : eyes) {
        const auto ground_m = oro::ground_h_m(region->field, one.lat_deg, one.lon_deg);
        ASSERT_TRUE(ground_m);
        const oro::Geodetic eye{one.lat_deg, one.lon_deg, *ground_m + 2.0};
        const double N_m = region->field.undulation.at_m(eye.lat_deg, eye.lon_deg);
        const oro::SunDayEvents found = oro::sun_day(
            one.from_utc_s, oro::SunOverTerrain(surface, eye, oro::standard_air, N_m), oro::thread_count());
        const std::vector<oro::SunCrossing> scanned = oro::test::scanned_crossings(
            surface, eye, oro::standard_air, one.from_utc_s, oro::thread_count());
        ASSERT_EQ(found.crossings.size(), scanned.size()) << one.name;
        ASSERT_GE(scanned.size(), 2U);
        double largest_s = 0.0;
        for (std::size_t i = 0; i < scanned.size(); ++i) {
            EXPECT_EQ(found.crossings[i].rising, scanned[i].rising) << one.name;
            EXPECT_NEAR(found.crossings[i].time_utc_s, scanned[i].time_utc_s, 10.0) << one.name;
            largest_s = std::max(largest_s, std::abs(found.crossings[i].time_utc_s - scanned[i].time_utc_s));
        }
        std::printf("%s: %zu crossings, largest difference %.2f s\n", one.name, scanned.size(), largest_s);
    }
}

}  // namespace
