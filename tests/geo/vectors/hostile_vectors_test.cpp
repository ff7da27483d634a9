// Vector files, as they should not be: one clear line each, or a note of what was left out.
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>

#include "geo/vectors/vector_file.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {
namespace fs = std::filesystem;
using test::collection;
using test::feature;
using test::geopackage;
using test::written;

// The error of a file that must have one, without the file's name.
std::string error_of(const std::string& file, double limit_s = 30.0) {
    const auto read = read_vectors(file, limit_s);
    if (read.ok()) return "is read";
    EXPECT_EQ(read.error().kind, ErrorKind::failed);
    EXPECT_EQ(read.error().where, file);
    EXPECT_EQ(read.error().line().find('\n'), std::string::npos);
    return read.error().what;
}

// What a file's notes say, without the file's name.
std::string note_of(const std::string& file, std::size_t shapes) {
    const auto read = read_vectors(file);
    if (!read.ok()) return read.error().line();
    std::size_t count = 0;
    for (const VectorLayer& layer : read->layers) count += layer.shapes.size();
    EXPECT_EQ(count, shapes);
    std::string all;
    for (const std::string& note : read->notes)
        all += (all.empty() ? "" : "\n") + note.substr(file.size() + 2);
    return all;
}

bool starts(const std::string& text, const std::string& with) {
    if (text.starts_with(with)) return true;
    std::cout << "says: " << text << "\n";
    return false;
}

TEST(HostileVectors, FilesThatAreNoneHaveOneLine) {
    EXPECT_TRUE(starts(error_of("/nowhere/at/all.gpx"), "cannot be opened"));
    EXPECT_EQ(error_of(test::scratch_folder().string()), "is a folder, not a vector file");
    EXPECT_EQ(error_of("/dev/null"), "is no regular file");
    EXPECT_EQ(error_of(written("a.geojson", "")), "is empty");
    EXPECT_EQ(error_of(written("a.kmz", "PK\3\4....")),
              "cannot be read as an archive: it is no .zip, or its end is missing");
    const std::string none =
        "is not a vector file in an accepted format (GPX, KML, KMZ, GeoJSON, TopoJSON, CSV, GeoPackage, "
        "shapefile, FlatGeobuf): ";
    EXPECT_TRUE(starts(error_of(written("a.geojson", "hello")), none));
    EXPECT_TRUE(starts(error_of(written("a.gpx", "<html></html>")), none));
    EXPECT_TRUE(starts(error_of(written("a.csv", "a,b\n1,2\n")), none));
    // Another driver of this GDAL would read it; it is not on the list.
    EXPECT_TRUE(starts(error_of(written("a.vrt", "<OGRVRTDataSource></OGRVRTDataSource>")), none));
}

// Found: "unknown format" was said of a packed track.
TEST(HostileVectors, PackedFilesSayWhatUnpacksThem) {
    EXPECT_EQ(error_of(written("a.gpx", "\x1f\x8b\x08 packed")), "is packed with gzip: unpack it");
    EXPECT_EQ(error_of(written("a.gpx.bz2", "BZh91AY packed")), "is packed with bzip2: unpack it");
}

// Found: [[10,1,45,8], ...] was a line from 1 N 10 E, without a word. RFC 7946, 3.1.1: three numbers at most.
TEST(HostileVectors, PositionsOfMoreThanThreeNumbersAreTold) {
    EXPECT_EQ(
        note_of(
            written("a.geojson", collection(feature("LineString", "[[10.1,45.8,5,1],\n[11.9,46.2,5,2]]"))),
            1),
        "2 positions have more than three numbers, the first in line 1: the first two are the place, the "
        "third is the height, and the others are not used");
    EXPECT_EQ(note_of(written("a.geojson", collection(feature("Point", "[8,46]") + ",\n" +
                                                      feature("LineString", "[[10,1,45,8],[11,9,46,2]]"))),
                      1),
              "left out 2 places of lines of more than three numbers, the first in line 2: '[10,1,45,8]'");
    // Whole metres of a projection with a measure are no degrees with commas.
    EXPECT_EQ(note_of(written("a.geojson", collection(feature("Point", "[2600000,1200000,500,7]"),
                                                      "urn:ogc:def:crs:EPSG::2056")),
                      1),
              "1 position has more than three numbers, in line 1: the first two are the place, the third is "
              "the height, and the others are not used");
}

// Found: a fix at 0 N 0 E made a track longer by 10,000 km, without a word.
TEST(HostileVectors, AFixThatIsNoneIsTold) {
    const auto track = [](const std::string& between) {
        return written("a.gpx", test::gpx("<trk><trkseg><trkpt lat=\"45.8\" lon=\"10.1\"/>\n<trkpt " +
                                          between + "/><trkpt lat=\"46.2\" lon=\"11.9\"/></trkseg></trk>"));
    };
    EXPECT_EQ(
        note_of(track("lat=\"0\" lon=\"0\""), 1),
        "1 place of a line lies at 0 N 0 E, far from its neighbours, in line 2: a receiver without a fix "
        "may have written that; the line goes there and back");
    EXPECT_EQ(note_of(track("lat=\"46\" lon=\"11\""), 1), "");
    // A ship that passes there.
    EXPECT_EQ(note_of(written("b.gpx", test::gpx("<trk><trkseg><trkpt lat=\"0\" lon=\"-1\"/><trkpt lat=\"0\" "
                                                 "lon=\"0\"/><trkpt lat=\"0\" lon=\"1\"/></trkseg></trk>")),
                      1),
              "");
}

TEST(HostileVectors, NothingWithAPlaceIsAnError) {
    EXPECT_EQ(error_of(written("a.geojson", collection(""))), "holds no points, lines or polygons");
    EXPECT_EQ(error_of(written("a.gpx", test::gpx(""))), "holds no points, lines or polygons");
    EXPECT_EQ(error_of(geopackage("a.gpkg", 4326, {})), "holds no points, lines or polygons");
    EXPECT_EQ(error_of(written("a.geojson", collection(feature("Point", "[8, 95]")))),
              "holds no points, lines or polygons; left out: 1 point with a latitude beyond 90 degrees, in "
              "line 1");
}

TEST(HostileVectors, BrokenTextIsAnErrorWhereverItIsCut) {
    const std::string json = collection(feature("Point", "[8,46]") + "," + feature("Point", "[8.1,46]")),
                      xml = test::gpx("<wpt lat=\"46\" lon=\"8\"><name>a</name></wpt>"),
                      earth =
                          test::kml("<Placemark><Point><coordinates>8,46</coordinates></Point></Placemark>");
    for (const auto& [name, text] : {std::pair{"a.geojson", json}, {"a.gpx", xml}, {"a.kml", earth}}) {
        ASSERT_TRUE(read_vectors(written(name, text)).ok()) << name;
        for (std::size_t bytes = 1; bytes + 1 < text.size(); bytes += 7)
            EXPECT_NE(error_of(written(name, text.substr(0, bytes))), "is read") << name << " " << bytes;
    }
}

TEST(HostileVectors, ACutGeoPackageIsAnError) {
    std::vector<std::pair<std::string, std::string>> points;
    for (int i = 0; i < 2000; ++i)
        points.emplace_back("POINT (" + std::to_string(8 + i * 1e-4) + " 46)", "point " + std::to_string(i));
    const std::string whole = geopackage("whole.gpkg", 4326, points);
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    ASSERT_TRUE(read_vectors(whole).ok());
    for (std::size_t length = 20; length < bytes.size(); length += bytes.size() / 30)
        EXPECT_NE(error_of(written("cut.gpkg", bytes.substr(0, length))), "is read") << length;
    std::ofstream(whole + "-journal") << "half";
    EXPECT_TRUE(starts(error_of(whole), "was left half written"));
}

TEST(HostileVectors, PlacesThatAreNoneAreLeftOutAndCounted) {
    const std::string good = feature("Point", "[8,46]") + ",";
    EXPECT_EQ(note_of(written("a.geojson", collection(good + feature("Point", "[8,95]"))), 1),
              "left out 1 point with a latitude beyond 90 degrees, in line 1");
    EXPECT_EQ(note_of(written("a.geojson", collection(good + feature("Point", "[800,45]"))), 1),
              "left out 1 point with a longitude beyond 360 degrees, in line 1");
    EXPECT_EQ(note_of(written("a.geojson",
                              collection(good + R"({"type":"Feature","properties":{},"geometry":null})")),
                      1),
              "left out 1 feature without a geometry, in line 1");
    // A line is broken there: nobody knows how it goes on.
    EXPECT_EQ(note_of(written("a.geojson",
                              collection(feature("LineString", "[[1,1],[2,2],[3,91],[4,4],[5,5],[6,6]]"))),
                      2),
              "left out 1 place of a line with a latitude beyond 90 degrees, in line 1");
    EXPECT_EQ(
        note_of(written("a.geojson", collection(good + feature("Polygon", "[[[1,1],[2,2],[3,91],[1,1]]]"))),
                1),
        "left out 1 polygon with places with a latitude beyond 90 degrees, in line 1");
    EXPECT_EQ(
        note_of(written("a.geojson", collection(good + feature("Polygon", "[[[1,1],[2,2],[1,1]]]"))), 1),
        "left out 1 polygon of fewer than three places, in line 1");
    EXPECT_EQ(
        note_of(written("a.gpx", test::gpx("<wpt lat=\"nan\" lon=\"8\"/><wpt lat=\"46\" lon=\"8\"/>")), 1),
        "left out 1 point that is no finite number, in line 1: 'nan'");
    EXPECT_EQ(
        note_of(written("a.gpx", test::gpx("<wpt lat=\"46\" lon=\"inf\"/><wpt lat=\"46\" lon=\"8\"/>")), 1),
        "left out 1 point that is no finite number, in line 1: 'inf'");
    // Of a projected CRS: beyond what it has places for, and no number at all.
    EXPECT_EQ(
        note_of(geopackage("a.gpkg", 32632, {{"POINT (500000 5000000)", "a"}, {"POINT (1e300 5)", "b"}}), 1),
        "left out 1 point that its coordinate reference system has no place for");
    EXPECT_EQ(
        note_of(geopackage("a.gpkg", 32632, {{"LINESTRING (5e5 5e6, 51e4 5e6, 1e300 5, 6e5 5e6)", "a"}}), 1),
        "left out 1 place of a line that its coordinate reference system has no place for\n"
        "left out 1 line of a single place");
}

TEST(HostileVectors, AnUnknownCrsIsNeverTakenForAnother) {
    const std::string point = feature("Point", "[8,46]");
    EXPECT_TRUE(starts(error_of(written("a.geojson", collection(point, "EPSG:999999"))),
                       "names a coordinate reference system that PROJ does not know (EPSG:999999)"));
    EXPECT_TRUE(starts(error_of(written("a.geojson", collection(point, "nonsense"))),
                       "names a coordinate reference system that PROJ does not know (nonsense)"));
    EXPECT_TRUE(read_vectors(written("a.geojson", collection(point, "urn:ogc:def:crs:OGC:1.3:CRS84"))).ok());
    EXPECT_TRUE(read_vectors(written("a.geojson", collection(point, "EPSG:4326"))).ok());
    EXPECT_TRUE(starts(error_of(geopackage("a.gpkg", 0, {{"POINT (8 46)", "a"}})), "layer 'shapes': "));
    // A link to a CRS is not followed.
    EXPECT_TRUE(starts(
        error_of(written("a.geojson", R"({"type":"FeatureCollection","crs":{"type":"link","properties":)"
                                      R"({"href":"http://127.0.0.1:1/x"}},"features":[)" +
                                          point + "]}")),
        "names http://127.0.0.1:1/x"));
}

// A view is a query that runs when it is read, and need never end.
TEST(HostileVectors, AQueryWithoutEndIsEnded) {
    const std::string file = geopackage("a.gpkg", 4326, {{"POINT (8 46)", "a"}});
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    const char* const evil =
        "create view evil as with recursive r(n) as (select 1 union all select n + 1 from r) "
        "select n as fid, (select geom from shapes limit 1) as geom, 'x' as name from r where n < 0;"
        "insert into gpkg_contents(table_name, data_type, identifier, srs_id) values"
        "('evil', 'features', 'evil', 4326);"
        "insert into gpkg_geometry_columns values('evil', 'geom', 'POINT', 4326, 0, 0);";
    EXPECT_EQ(sqlite3_exec(database, evil, nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(starts(error_of(file, 1.0), "takes more than 1 s to read"));
    std::cout << "ended after "
              << std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() << " s\n";
}

TEST(HostileVectors, AMillionPlacesAreReadAtOnce) {
    std::string text = R"({"type":"FeatureCollection","features":[)";
    char point[40];
    text += R"({"type":"Feature","properties":{"name":"w"},"geometry":{"type":"LineString","coordinates":[)";
    for (int i = 0; i < 1'000'000; ++i) {
        std::snprintf(point, sizeof point, "%s[%.6f,%.6f]", i > 0 ? "," : "", 8 + i * 1e-6, 46 + i * 1e-6);
        text += point;
    }
    const std::string file = written("a.geojson", text + "]}}]}");
    const auto start = std::chrono::steady_clock::now();
    const auto read = read_vectors(file);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->layers[0].shapes[0].paths[0].size(), 1'000'000U);
    std::cout << "a line of 1,000,000 places: " << took.count() << " s\n";
}

}  // namespace
}  // namespace oro
