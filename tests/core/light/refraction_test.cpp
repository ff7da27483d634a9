// Refraction for eyes on heights.
#include "core/light/refraction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace oro {
namespace {

// Manual of the ICAO Standard Atmosphere, Doc 7488/3, 1993, table of relative densities; digits from memory,
// which the gas law confirms below.
TEST(Refraction, AirThinsAsTheStandardAtmosphereDoes) {
    EXPECT_EQ(air_share(0.0), 1.0);
    EXPECT_NEAR(air_share(1000.0), 0.9075, 2e-4);
    EXPECT_NEAR(air_share(3000.0), 0.7422, 2e-4);
    EXPECT_NEAR(air_share(8000.0), 0.4287, 2e-4);
    EXPECT_NEAR(air_share(11000.0), 0.2971, 2e-4);
    EXPECT_NEAR(air_share(20000.0), 0.0719, 2e-4);
    EXPECT_EQ(air_share(-7e6), air_share(-1000.0));
    EXPECT_LT(air_share(400000.0), 1e-20);
    // Hydrostatic: the density's gradient is -(g M / R + dT/dh) rho / T; g 9.80665, M 0.0289644, R 8.31432.
    for (const double h_m : {-500.0, 500.0, 5000.0, 10500.0, 15000.0}) {
        const double lapse = h_m < 11000.0 ? -0.0065 : 0.0;
        const double temperature = 288.15 + (h_m < 11000.0 ? lapse * h_m : -0.0065 * 11000.0);
        const double slope = (air_share(h_m + 1.0) - air_share(h_m - 1.0)) / 2.0;
        EXPECT_NEAR(slope / air_share(h_m), -(9.80665 * 0.0289644 / 8.31432 + lapse) / temperature, 2e-9)
            << h_m;
    }
}

// At sea level it is what almanacs take, where they say anything: down to the horizon; a little below it the
// two differ by 0.04 degree.
TEST(Refraction, AtSeaLevelItIsTheAlmanacs) {
    for (double airless_deg = -0.57; airless_deg < 90.0; airless_deg += 0.13)
        EXPECT_NEAR(seen_elevation_deg(airless_deg, 0.0), airless_deg + refraction_deg(airless_deg, {}), 1e-9)
            << airless_deg;
    EXPECT_NEAR(seen_elevation_deg(-1.0, 0.0), -1.0 + refraction_deg(-1.0, {}), 0.04);
}

TEST(Refraction, ThereAndBack) {
    for (const double h_m : {-400.0, 0.0, 500.0, 3000.0, 8800.0, 12000.0, 400e3, 3.6e7}) {
        for (double airless_deg = -89.0; airless_deg < 89.9; airless_deg += 0.71)
            ASSERT_NEAR(airless_elevation_deg(seen_elevation_deg(airless_deg, h_m), h_m), airless_deg, 1e-9)
                << h_m;
    }
}

TEST(Refraction, ItIsSmoothAndKeepsTheOrder) {
    for (const double h_m : {-400.0, 0.0, 10.0, 500.0, 3000.0, 8800.0, 12000.0, 400e3}) {
        double before_deg = seen_elevation_deg(-30.0, h_m);
        EXPECT_NEAR(before_deg, -30.0, 1e-9) << h_m;
        for (int i = 1; i <= 1500; ++i) {
            const double seen_deg = seen_elevation_deg(-30.0 + i * 0.04, h_m);
            ASSERT_GT(seen_deg, before_deg) << h_m << " " << i;
            ASSERT_LT(seen_deg - before_deg, 0.058) << h_m << " " << i;
            before_deg = seen_deg;
        }
    }
}

// Navigators' and almanacs' rule for a sunrise from a height over the sea: the middle of the disc stands 50
// minutes of arc and 2.076' sqrt(height in m) below level, of which 16' are the disc's radius. Its figures
// are of one average air; this model's of another. It is given in that form by the US Naval Observatory's
// notes on sunrise, and from memory here: a rule of thumb, so that a tenth of the dip is allowed.
TEST(Refraction, TheSeasHorizonFromAHeight) {
    for (const double h_m : {100.0, 500.0, 1000.0, 3000.0, 4800.0}) {
        double dip_deg = 0.0;
        for (double down_deg = 0.0; down_deg < 5.0; down_deg += 0.0005) {
            // n r cos(dip) at the eye is n r at the sea: straight from Bouguer, in its own words here.
            const double eye = (1.0 + 2.8e-4 * air_share(h_m)) * (6371008.8 + h_m) *
                               std::cos(down_deg * std::numbers::pi / 180.0);
            if (eye > 1.00028 * 6371008.8) dip_deg = down_deg;
        }
        // Bowditch: the dip is 1.76' sqrt(height in m).
        EXPECT_NEAR(60.0 * dip_deg, 1.76 * std::sqrt(h_m), 0.03 * std::sqrt(h_m)) << h_m;
        const double airless_deg = airless_elevation_deg(-dip_deg, h_m);
        const double rule_deg = -(34.0 + 2.076 * std::sqrt(h_m)) / 60.0;
        std::printf("%.0f m: dip %.3f, sun at %.3f, the rule's %.3f degrees\n", h_m, dip_deg, airless_deg,
                    rule_deg);
        EXPECT_NEAR(airless_deg, rule_deg, 0.02 + 0.03 * dip_deg) << h_m;
    }
}

TEST(Refraction, TheDiscSinks) {
    EXPECT_EQ(share_of_disc(1.0), 1.0);
    EXPECT_EQ(share_of_disc(0.267), 1.0);
    EXPECT_NEAR(share_of_disc(0.0), 0.5, 1e-15);
    EXPECT_EQ(share_of_disc(-0.267), 0.0);
    EXPECT_EQ(share_of_disc(-50.0), 0.0);
    // A segment of half the radius's height: pi/3 - sqrt(3)/4 of a disc's pi.
    EXPECT_NEAR(share_of_disc(-0.5 * 959.63 / 3600.0),
                (std::numbers::pi / 3.0 - std::sqrt(3.0) / 4.0) / std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace oro
