// Must hold: distances and directions are those of GeographicLib's other, exact solution.
#include "geo/places/geodesic.h"

#include <gtest/gtest.h>

#include <GeographicLib/GeodesicExact.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

namespace oro {
namespace {

TEST(Geodesic, TenThousandPairsAreTheExactSolutions) {
    constexpr unsigned seed = 1123;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> lat(-90.0, 90.0), lon(-180.0, 180.0), size(-6.0, 0.0),
        turn(-1.0, 1.0);
    double worst = 0.0, worst_there_m = 0.0;
    for (int i = 0; i < 10000; ++i) {
        // From a metre to half round the Earth.
        const double from_lat = lat(random), from_lon = lon(random), reach = std::pow(10.0, size(random));
        const double to_lat = std::clamp(from_lat + 90.0 * reach * turn(random), -90.0, 90.0);
        const double to_lon = from_lon + 180.0 * reach * turn(random);
        double truth_m = 0.0;
        GeographicLib::GeodesicExact::WGS84().Inverse(from_lat, from_lon, to_lat, to_lon, truth_m);
        const GeodesicPath path = geodesic_between(from_lat, from_lon, to_lat, to_lon);
        if (truth_m > 0.01) worst = std::max(worst, (std::abs(path.distance_m - truth_m) - 2.0e-8) / truth_m);
        const LatLon there = geodesic_towards(from_lat, from_lon, path.bearing_deg, path.distance_m);
        double off_m = 0.0;
        GeographicLib::GeodesicExact::WGS84().Inverse(there.lat_deg, there.lon_deg, to_lat, to_lon, off_m);
        worst_there_m = std::max(worst_there_m, off_m);
    }
    std::printf("distances off by %.2e of them at most (but for 20 nm); ends by %.2e m\n", worst,
                worst_there_m);
    EXPECT_LE(worst, 1.0e-9);
    EXPECT_LE(worst_there_m, 1.0e-6);
}

}  // namespace
}  // namespace oro
