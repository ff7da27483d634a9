// Where the middle of a map lies, and how the map is turned there.
#include "apps/output/map_middle.h"

#include <gtest/gtest.h>

#include <string>

namespace oro {
namespace {

// A map of 100 x 100 pixels around a place of its CRS.
MapFrame around(const std::string& crs, double x, double y, double pixel) {
    return {crs, {x - 50.0 * pixel, pixel, 0.0, y + 50.0 * pixel, 0.0, -pixel}, 100, 100};
}

void expect_middle(const MapFrame& map, const MapMiddle& expected, double azimuth_slack_deg,
                   double pixel_slack_m) {
    const auto found = map_middle(map);
    ASSERT_TRUE(found.ok()) << found.error().line();
    EXPECT_NEAR(found->lat_deg, expected.lat_deg, 1e-7) << map.crs;
    EXPECT_NEAR(found->lon_deg, expected.lon_deg, 1e-7) << map.crs;
    EXPECT_NEAR(found->up_azimuth_deg, expected.up_azimuth_deg, azimuth_slack_deg) << map.crs;
    EXPECT_NEAR(found->pixel_m, expected.pixel_m, pixel_slack_m) << map.crs;
}

// By hand, for the Swiss projection: on its sphere (b0 = 46.9077315 degrees, alpha = 1.00072913844) the
// convergence is atan2(sin b0 sin l, cos b0 cos b + sin b0 sin b cos l); at 46.5012490 N, 9.5012567 E on the
// Bessel ellipsoid, which is 46.5 N, 9.5 E on WGS84, that is 1.506535 degrees from the meridian of Bessel's
// ellipsoid. WGS84's meridian there is turned by 0.0012567 sin(46.5) = 0.000912 from it: 1.505623. Places of
// the CRS by gdaltransform of GDAL 3.6.
TEST(MapMiddles, HaveTheConvergenceOfTheSwissProjection) {
    expect_middle(around("EPSG:2056", 2758223.09979845, 1151932.43505072, 10.0), {46.5, 9.5, 1.505623, 10.0},
                  3e-5, 0.01);
    // The projection's origin lies on its meridian. Source of the place: swisstopo, 46 57 03.898 N,
    // 7 26 19.077 E (ETRS89).
    const auto origin = map_middle(around("EPSG:2056", 2600000.0, 1200000.0, 10.0));
    ASSERT_TRUE(origin.ok()) << origin.error().line();
    EXPECT_NEAR(origin->lat_deg, 46.9510828, 1e-6);
    EXPECT_NEAR(origin->lon_deg, 7.4386325, 1e-6);
    EXPECT_NEAR(origin->up_azimuth_deg, 0.0, 1e-3);
}

// tan(convergence) = tan(longitude from the meridian) sin(latitude) on a sphere: atan(tan 1.5 sin 46.5) =
// 1.08818 degrees; on the ellipsoid 0.00001 less. East of the meridian grid north lies to the east.
TEST(MapMiddles, AreTurnedEastInTheEastOfAZone) {
    expect_middle(around("EPSG:32632", 615097.162593407, 5150696.34623148, 10.0), {46.5, 10.5, 1.08817, 10.0},
                  2e-5, 0.01);
    expect_middle(around("EPSG:32632", 384902.837406593, 5150696.34623148, 10.0), {46.5, 7.5, -1.08817, 10.0},
                  2e-5, 0.01);
}

// 0.001 degree of longitude at 60 N is a / sqrt(1 - e2 sin2) cos 60 pi / 180,000 = 55.80 m. Over the 180th
// meridian the middle is in (-180, 180].
TEST(MapMiddles, OfMapsInDegreesAreNotTurned) {
    expect_middle(around("EPSG:4326", 180.25, 60.0, 0.001), {60.0, -179.75, 0.0, 55.80}, 1e-9, 0.005);
}

TEST(MapMiddles, MustLieOnTheEarth) {
    const auto found = map_middle(around("EPSG:4326", 10.0, 95.0, 0.001));
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().kind, ErrorKind::usage);
    EXPECT_NE(found.error().line().find("has no place on the Earth"), std::string::npos);
}

}  // namespace
}  // namespace oro
