// The CRS and the unit that a user asks a vector file to be read in.
#include "geo/vectors/vector_crs.h"

#include <gtest/gtest.h>

#include "tests/geo/vectors/written_vectors.h"

namespace oro {
namespace {

// (2600000, 1200000) in EPSG:2056 by gdaltransform 3.6.2 (PROJ 9.1.1).
constexpr double bern_lat_deg = 46.9510827718711, bern_lon_deg = 7.43863242087181, most_bern_off_deg = 1.0e-9;

void expect_near_bern(const Result<VectorFile>& read) {
    ASSERT_TRUE(read.ok()) << read.error().line();
    const VectorPlace& place = read->layers.front().shapes.front().paths.front().front();
    EXPECT_NEAR(place.lat_deg, bern_lat_deg, most_bern_off_deg);
    EXPECT_NEAR(place.lon_deg, bern_lon_deg, most_bern_off_deg);
}

TEST(VectorCrs, StandsInThePlaceOfWhatAFileStates) {
    const VectorCrs lv95{"EPSG:2056", {}};
    const std::string square =
        "[[[2600000,1200000],[2600010,1200000],[2600010,1200010],[2600000,1200010],[2600000,1200000]]]";
    const std::string wkt = "POLYGON((2600000 1200000,2600010 1200000,2600010 1200010,2600000 1200000))";
    expect_near_bern(read_vectors_in(
        test::written("none.geojson", test::collection(test::feature("Polygon", square))), lv95));
    expect_near_bern(read_vectors_in(
        test::written("other.geojson", test::collection(test::feature("Polygon", square), "EPSG:21781")),
        lv95));
    expect_near_bern(read_vectors_in(test::written("t.csv", "WKT,name\n\"" + wkt + "\",a\n"), lv95));
    expect_near_bern(read_vectors_in(test::geopackage("other.gpkg", 21781, {{wkt, "a"}}), lv95));
    const std::string shp = test::vector_dataset("bare.shp", "ESRI Shapefile", 0, {{wkt, "a"}});
    expect_near_bern(read_vectors_in(shp, lv95));
    EXPECT_NE(read_vectors(shp).error().line().find("without its .prj"), std::string::npos);
}

// 0.3048 m a foot: 2600000 m are 8530183.7270341207 ft.
TEST(VectorCrs, AnotherUnitScalesProjectedCoordinates) {
    const auto read = read_vectors_in(
        test::written("feet.geojson",
                      test::collection(test::feature("Point", "[8530183.7270341207,3937007.8740157480]"))),
        {"EPSG:2056", 0.3048});
    expect_near_bern(read);
    ASSERT_EQ(read->notes.size(), 1U);
    EXPECT_NE(read->notes[0].find("taken times 0.3048"), std::string::npos) << read->notes[0];
    const auto degrees = read_vectors_in(
        test::written("degrees.geojson", test::collection(test::feature("Point", "[7.5,46.5]"))),
        {"", 0.3048});
    EXPECT_EQ(degrees->layers.front().shapes.front().paths.front().front().lat_deg, 46.5);
    EXPECT_TRUE(degrees->notes.empty());
}

TEST(VectorCrs, KmlStaysInWgs84) {
    const std::string path = test::written(
        "a.kml", test::kml("<Placemark><Point><coordinates>7.5,46.5</coordinates></Point></Placemark>"));
    EXPECT_TRUE(read_vectors_in(path, {"EPSG:4979", {}}).ok());
    EXPECT_NE(read_vectors_in(path, {"EPSG:2056", {}})
                  .error()
                  .line()
                  .find("KML is in latitudes and longitudes of WGS84, not in EPSG:2056"),
              std::string::npos);
}

}  // namespace
}  // namespace oro
