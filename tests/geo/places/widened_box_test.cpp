#include "geo/places/widened_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geo/places/geodesic.h"

namespace oro {
namespace {

bool is_inside(const BoundingBox& box, const LatLon& place) {
    if (place.lat_deg < box.south_deg || place.lat_deg > box.north_deg) return false;
    if (box.east_deg - box.west_deg >= 360.0) return true;
    const auto turned = [&](double lon_deg) { return std::fmod(lon_deg - box.west_deg + 720.0, 360.0); };
    return turned(place.lon_deg) <= turned(box.east_deg);
}

void expect_near(const BoundingBox& box, const BoundingBox& expected, double tolerance_deg) {
    EXPECT_NEAR(box.west_deg, expected.west_deg, tolerance_deg);
    EXPECT_NEAR(box.south_deg, expected.south_deg, tolerance_deg);
    EXPECT_NEAR(box.east_deg, expected.east_deg, tolerance_deg);
    EXPECT_NEAR(box.north_deg, expected.north_deg, tolerance_deg);
}

// A minute of latitude is a nautical mile, 1852 m: 1843 m at the equator, where one of longitude has 1855 m;
// at 45 degrees 1852 m and 1315 m. Source: the WGS84 ellipsoid, as tables of sailing have it.
TEST(WidenedBox, IsWiderByTheDistance) {
    expect_near(widened_box({10.0, 0.0, 11.0, 0.0}, 18430.0),
                {10.0 - 18430.0 / 111320.0, -1.0 / 6.0, 11.0 + 18430.0 / 111320.0, 1.0 / 6.0}, 0.002);
    expect_near(widened_box({8.0, 45.0, 8.0, 45.0}, 18520.0),
                {8.0 - 18520.0 / 78900.0, 45.0 - 1.0 / 6.0, 8.0 + 18520.0 / 78900.0, 45.0 + 1.0 / 6.0},
                0.003);
    expect_near(widened_box({8.0, 46.0, 9.0, 47.0}, 0.0), {8.0, 46.0, 9.0, 47.0}, 1e-12);
}

TEST(WidenedBox, CrossesTheAntimeridian) {
    const BoundingBox box = widened_box({179.9, -17.0, 179.95, -16.0}, 50000.0);
    EXPECT_NEAR(box.west_deg, 179.43, 0.01);
    EXPECT_NEAR(box.east_deg, -179.58, 0.01);
    // One that crosses it already, and one that goes all round.
    EXPECT_NEAR(widened_box({175.0, 0.0, -175.0, 1.0}, 111320.0).west_deg, 174.0, 0.01);
    EXPECT_NEAR(widened_box({175.0, 0.0, -175.0, 1.0}, 111320.0).east_deg, -174.0, 0.01);
    expect_near(widened_box({-179.9, 0.0, 179.9, 1.0}, 50000.0), {-180.0, -0.452, 180.0, 1.452}, 0.002);
}

TEST(WidenedBox, GoesRoundAPoleThatIsNear) {
    expect_near(widened_box({20.0, 89.0, 21.0, 89.5}, 60000.0), {-180.0, 88.4629, 180.0, 90.0}, 0.002);
    expect_near(widened_box({20.0, -90.0, 21.0, -89.8}, 1000.0), {-180.0, -90.0, 180.0, -89.791}, 0.001);
    // 55.8 km from the pole, and 50 km: not round it, but far to the sides.
    const BoundingBox near = widened_box({20.0, 89.5, 20.0, 89.5}, 50000.0);
    EXPECT_LT(near.north_deg, 90.0);
    EXPECT_NEAR(near.east_deg, 83.9, 0.5);
    EXPECT_NEAR(near.west_deg, -43.9, 0.5);
}

// The oracle is GeographicLib: no place at the distance lies outside, and some lie close to each side.
TEST(WidenedBox, HoldsAllPlacesWithinTheDistance) {
    const unsigned seed = 54;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    for (int i = 0; i < 2000; ++i) {
        BoundingBox box;
        box.south_deg = -90.0 + 179.0 * share(random);
        box.north_deg = std::min(90.0, box.south_deg + 5.0 * share(random));
        box.west_deg = -180.0 + 360.0 * share(random);
        box.east_deg = box.west_deg + 10.0 * share(random);
        if (box.east_deg > 180.0) box.east_deg -= 360.0;
        const double width_deg = std::fmod(box.east_deg - box.west_deg + 360.0, 360.0);
        const double by_m = 500000.0 * std::pow(share(random), 3.0);
        const BoundingBox wide = widened_box(box, by_m);
        for (int bearing_deg = 0; bearing_deg < 360; bearing_deg += 5) {
            const double lat_deg =
                box.south_deg + (box.north_deg - box.south_deg) * std::round(share(random) * 4.0) / 4.0;
            const double lon_deg = box.west_deg + width_deg * std::round(share(random) * 4.0) / 4.0;
            const LatLon place = geodesic_towards(lat_deg, lon_deg, bearing_deg, by_m);
            ASSERT_TRUE(is_inside(wide, place))
                << "seed " << seed << ", box " << i << ": " << bounding_box_text(box) << " by " << by_m
                << " m: " << place.lat_deg << "," << place.lon_deg << " is not in "
                << bounding_box_text(wide);
        }
        // Not wider than need be: to the north by one part in 50 of the distance.
        const double to_north_deg = geodesic_towards(box.north_deg, box.west_deg, 0.0, by_m).lat_deg;
        if (wide.north_deg < 90.0 && std::abs(box.north_deg) < 70.0 && std::abs(box.south_deg) < 70.0) {
            EXPECT_LT(wide.north_deg - to_north_deg, 0.02 * by_m / 111000.0 + 1e-9) << bounding_box_text(box);
        }
    }
}

}  // namespace
}  // namespace oro
