// The usual sun: ten o'clock by the sun, on a day when the place has one. Expected values by the formula of
// the sky's turn, sin(elevation) = sin(lat) sin(decl) + cos(lat) cos(decl) cos(hour), tan(azimuth from south)
// = sin(hour) / (cos(hour) sin(lat) - tan(decl) cos(lat)), with the hour 30 degrees before noon. Source: J.
// Meeus, Astronomical Algorithms, 2nd ed. 1998, eq. 13.5 and 13.6. Tolerance: 0.06 degree, that of the hour.
#include "core/light/sun_position.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

constexpr double tolerance_deg = 0.06;

SunPosition usual_at(const Geodetic& place) {
    return sun_position(static_cast<double>(usual_sun_utc_s(place)), place);
}

// 2026-03-20T09:35:26Z, 5.18 hours before the equinox (14:46): declination -0.085.
TEST(UsualSun, IsThatOfTheEquinoxAtTen) {
    const Geodetic alps{46.5, 8.0, 0.0};
    EXPECT_EQ(usual_sun_utc_s(alps), 1773999326);
    EXPECT_NEAR(usual_at(alps).airless_elevation_deg, 36.51, tolerance_deg);
    EXPECT_NEAR(usual_at(alps).azimuth_deg, 141.53, tolerance_deg);
    // In the south it stands in the north-east: declination -0.097.
    const Geodetic cape{-33.9, 18.4, 0.0};
    EXPECT_NEAR(usual_at(cape).airless_elevation_deg, 46.03, tolerance_deg);
    EXPECT_NEAR(usual_at(cape).azimuth_deg, 46.07, tolerance_deg);
}

// Declination 23.436, and -23.436 at the south pole, where the sun keeps its height all day.
TEST(UsualSun, IsThatOfMidsummerWithinThePolarCircles) {
    const Geodetic svalbard{78.2, 15.6, 0.0};
    EXPECT_NEAR(usual_at(svalbard).airless_elevation_deg, 33.49, tolerance_deg);
    EXPECT_NEAR(usual_at(svalbard).azimuth_deg, 146.63, tolerance_deg);
    EXPECT_NEAR(usual_at({-90.0, 0.0, 0.0}).airless_elevation_deg, 23.436, tolerance_deg);
    EXPECT_NEAR(usual_at({90.0, 0.0, 0.0}).airless_elevation_deg, 23.436, tolerance_deg);
}

// All around the Earth, 2 hours before the sun's own noon; and everywhere it gives light.
TEST(UsualSun, StandsWhereItStandsSomeTimeAtEveryPlace) {
    for (double lat_deg = -85.0; lat_deg <= 85.0; lat_deg += 10.0) {
        for (double lon_deg = -180.0; lon_deg <= 180.0; lon_deg += 45.0) {
            SCOPED_TRACE(std::to_string(lat_deg) + "," + std::to_string(lon_deg));
            const Geodetic place{lat_deg, lon_deg, 0.0};
            const double at_s = static_cast<double>(usual_sun_utc_s(place));
            EXPECT_NEAR(solar_noon_utc_s(at_s - 8.0 * 3600.0, place) - at_s, 7200.0, 16.0);
            EXPECT_GT(usual_at(place).airless_elevation_deg, 20.0);
        }
    }
}

}  // namespace
}  // namespace oro
