// Vector files, as they should be: places, fields, heights, splitting.
#include "geo/vectors/vector_file.h"

#include <gtest/gtest.h>

#include <GeographicLib/UTMUPS.hpp>
#include <cmath>
#include <string>

#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
using test::collection;
using test::feature;
using test::written;

const VectorPlace& only_place(const VectorShape& shape) {
    return shape.paths.front().front();
}

TEST(VectorFile, PointsHaveTheirPlaceAndAllFieldsAsText) {
    const auto read = read_vectors(written(
        "a.geojson", collection(feature("Point", "[8.25, 46.5, 1234.5]",
                                        R"("name": "Größe Å", "ele": "2962", "rank": 7, "none": null)"))));
    ASSERT_TRUE(read.ok()) << read.error().line();
    ASSERT_EQ(read->layers.size(), 1U);
    const VectorLayer& layer = read->layers.front();
    ASSERT_EQ(layer.shapes.size(), 1U);
    const VectorShape& shape = layer.shapes.front();
    EXPECT_EQ(shape.kind, VectorKind::point);
    EXPECT_EQ(only_place(shape).lat_deg, 46.5);
    EXPECT_EQ(only_place(shape).lon_deg, 8.25);
    EXPECT_EQ(only_place(shape).height_m, 1234.5);
    EXPECT_EQ(shape.heights, HeightAbove::ellipsoid);  // RFC 7946, 3.1.1
    EXPECT_EQ(layer.text(shape, "name"), "Größe Å");
    EXPECT_EQ(layer.text(shape, "NAME"), "Größe Å");
    EXPECT_EQ(layer.text(shape, "ele"), "2962");
    EXPECT_EQ(layer.text(shape, "rank"), "7");
    EXPECT_EQ(layer.text(shape, "none"), "");
    EXPECT_EQ(layer.text(shape, "other"), "");
    EXPECT_TRUE(read->notes.empty());
    EXPECT_NE(read->fingerprint, 0U);
}

TEST(VectorFile, PolygonsKeepTheirHolesAndCollectionsAreSplit) {
    const std::string square = "[[8,46],[9,46],[9,47],[8,47],[8,46]]",
                      hole = "[[8.2,46.2],[8.2,46.4],[8.4,46.4],[8.2,46.2]]";
    const auto read = read_vectors(written(
        "a.geojson",
        collection(
            feature("Polygon", "[" + square + "," + hole + "]", R"("name":"lake")") + "," +
            feature("MultiLineString", "[[[8,46],[9,46]],[[8,47],[9,47],[9,46.5]]]", R"("name":"way")") +
            "," + feature("MultiPoint", "[[8,46],[190,46]]", R"("name":"two")") + "," +
            R"({"type":"Feature","properties":{"name":"mix"},"geometry":{"type":"GeometryCollection",)"
            R"("geometries":[{"type":"Point","coordinates":[1,2]},)"
            R"({"type":"MultiPolygon","coordinates":[[)" +
            square + "],[" + square + "]]}]}}")));
    ASSERT_TRUE(read.ok()) << read.error().line();
    const VectorLayer& layer = read->layers.front();
    ASSERT_EQ(layer.shapes.size(), 8U);
    EXPECT_EQ(layer.records.size(), 4U);
    EXPECT_EQ(read->count(VectorKind::point), 3U);
    EXPECT_EQ(read->count(VectorKind::line), 2U);
    EXPECT_EQ(read->count(VectorKind::polygon), 3U);
    const VectorShape& lake = layer.shapes.front();
    ASSERT_EQ(lake.paths.size(), 2U);
    EXPECT_EQ(lake.paths[0].size(), 4U);  // the first place is not told again
    EXPECT_EQ(lake.paths[1].size(), 3U);
    EXPECT_EQ(layer.shapes[2].paths[0].size(), 3U);
    EXPECT_EQ(only_place(layer.shapes[4]).lon_deg, -170.0);
    for (std::size_t i : {5U, 6U, 7U}) EXPECT_EQ(layer.text(layer.shapes[i], "name"), "mix");
}

// GeographicLib's UTM is another implementation than PROJ's.
TEST(VectorFile, PlacesOfAProjectedLayerAreWgs84s) {
    const double lat_deg = 46.537, lon_deg = 7.962;  // Jungfrau
    int zone = 0;
    bool north = false;
    double x = 0.0, y = 0.0;
    GeographicLib::UTMUPS::Forward(lat_deg, lon_deg, zone, north, x, y);
    char point[80];
    std::snprintf(point, sizeof point, "POINT Z (%.4f %.4f 4158)", x, y);
    const auto read = read_vectors(test::geopackage("utm.gpkg", 32600 + zone, {{point, "Jungfrau"}}));
    ASSERT_TRUE(read.ok()) << read.error().line();
    const VectorShape& shape = read->layers.front().shapes.front();
    EXPECT_NEAR(only_place(shape).lat_deg, lat_deg, 1e-9);  // 0.1 mm
    EXPECT_NEAR(only_place(shape).lon_deg, lon_deg, 1e-9);
    EXPECT_EQ(only_place(shape).height_m, 4158.0);
    EXPECT_EQ(shape.heights, HeightAbove::sea_level);
    EXPECT_EQ(read->layers.front().text(shape, "name"), "Jungfrau");
}

// A quarter of a circle of 0.1 degree: all places of the chords lie on it.
TEST(VectorFile, CurvesBecomeLines) {
    const auto read = read_vectors(test::geopackage(
        "curve.gpkg", 4326,
        {{"CIRCULARSTRING (8.1 46, 8.0707106781186547 46.0707106781186547, 8 46.1)", "arc"}}));
    ASSERT_TRUE(read.ok()) << read.error().line();
    const VectorShape& shape = read->layers.front().shapes.front();
    ASSERT_EQ(shape.kind, VectorKind::line);
    EXPECT_GE(shape.paths[0].size(), 90U);
    for (const VectorPlace& place : shape.paths[0])
        EXPECT_NEAR(std::hypot(place.lon_deg - 8.0, place.lat_deg - 46.0), 0.1, 1e-9);
}

TEST(VectorFile, GpxHasWaypointsRoutesAndTracksOnce) {
    const auto read = read_vectors(written(
        "a.gpx",
        test::gpx("<wpt lat=\"46\" lon=\"8\"><ele>1000</ele><name>hut</name></wpt>"
                  "<rte><name>r</name><rtept lat=\"46\" lon=\"8\"/><rtept lat=\"46.1\" lon=\"8\"/></rte>"
                  "<trk><name>t</name><trkseg><trkpt lat=\"46\" lon=\"8\"><ele>1</ele></trkpt>"
                  "<trkpt lat=\"46\" lon=\"8.1\"><ele>2</ele></trkpt></trkseg><trkseg>"
                  "<trkpt lat=\"47\" lon=\"8\"/><trkpt lat=\"47\" lon=\"8.1\"/></trkseg></trk>")));
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->count(VectorKind::point), 1U);
    EXPECT_EQ(read->count(VectorKind::line), 3U);
    ASSERT_EQ(read->layers.size(), 3U);
    const VectorShape& hut = read->layers[0].shapes[0];
    EXPECT_EQ(read->layers[0].text(hut, "name"), "hut");
    EXPECT_EQ(hut.heights, HeightAbove::sea_level);
    EXPECT_EQ(only_place(hut).height_m, 1000.0);
    const VectorShape& track = read->layers[2].shapes[0];
    EXPECT_EQ(read->layers[2].text(track, "name"), "t");
    EXPECT_EQ(track.paths[0][1].height_m, 2.0);
}

TEST(VectorFile, KmlKeepsOnlyHeightsThatAreMeant) {
    const auto placemark = [](const char* name, const char* mode) {
        return "<Placemark><name>" + std::string(name) +
               "</name><ExtendedData><Data name=\"k\"><value>v</value>"
               "</Data></ExtendedData><Point>" +
               mode + "<coordinates>8,46,70</coordinates></Point></Placemark>";
    };
    const auto read = read_vectors(written(
        "a.kml", test::kml("<Folder><name>in</name><Folder><name>deep</name>" + placemark("plain", "") +
                           placemark("high", "<altitudeMode>absolute</altitudeMode>") + "</Folder></Folder>" +
                           placemark("over", "<altitudeMode>relativeToGround</altitudeMode>"))));
    ASSERT_TRUE(read.ok()) << read.error().line();
    ASSERT_EQ(read->count(VectorKind::point), 3U);
    for (const VectorLayer& layer : read->layers) {
        for (const VectorShape& shape : layer.shapes) {
            const std::string_view name = layer.text(shape, "name");
            EXPECT_EQ(layer.text(shape, "k"), "v");
            EXPECT_EQ(shape.heights, name == "high"   ? HeightAbove::sea_level
                                     : name == "over" ? HeightAbove::ground
                                                      : HeightAbove::nothing);
            EXPECT_EQ(std::isnan(only_place(shape).height_m), name == "plain") << name;
        }
    }
}

TEST(VectorFile, ReadsRealPeaksAndARealTrack) {
    const auto peaks = test::real_data("vector/tirol_peaks.geojson"),
               track = test::real_data("vector/RundwanderungBeimOeschinensee.gpx");
    if (!peaks || !track) GTEST_SKIP() << "needs vector/tirol_peaks.geojson and a track";
    const auto read = read_vectors(peaks->string());
    ASSERT_TRUE(read.ok()) << read.error().line();
    const VectorLayer& layer = read->layers.front();
    EXPECT_EQ(layer.text(layer.shapes[0], "name"), "Weiße Spitze");  // the file's first feature
    EXPECT_EQ(layer.text(layer.shapes[0], "ele"), "2962");
    EXPECT_EQ(only_place(layer.shapes[0]).lat_deg, 46.8718905);
    EXPECT_EQ(read->count(VectorKind::point), layer.shapes.size());
    const auto way = read_vectors(track->string());
    ASSERT_TRUE(way.ok()) << way.error().line();
    ASSERT_EQ(way->count(VectorKind::line), 1U);
    EXPECT_EQ(way->layers[0].shapes[0].paths[0].size(), 8177U);  // ogrinfo: track_points
}

}  // namespace
}  // namespace oro
