// Lines and names of vector files in all formats, as users meet them: the same picture from each.
#include <gdal.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/geo/vectors/written_vectors.h"
#include "tests/geo/vectors/written_zip.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::vector_dataset;
using oro::test::Words;
using oro::test::written;

// A line across the bundled region, and a name on it.
constexpr const char* line_wkt = "LINESTRING (-84.35 36.56,-84.25 36.6,-84.15 36.57)";
constexpr const char* peak_wkt = "POINT (-84.27 36.6)";

class VectorFormats : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    static Outcome shoot(const std::string& picture, const Words& more) {
        return run_orograph(oro::test::joined(
            {"shot", oro::test::bundled(), "--size", "320x240", "--time", "2026-01-01T00:00:00Z",
             "--no-paths", "--json", "--out", (oro::test::scratch_folder() / picture).string()},
            more));
    }
    // The pixels that a file's line has, and the names that it has in the picture.
    static std::string drawn(const char* option, const std::string& file) {
        const Outcome outcome = shoot("drawn.png", {option, file, "--overwrite"});
        if (outcome.exit_code != 0) return outcome.err;
        const json said = json::parse(outcome.out);
        if (option == std::string("--overlay")) return said["overlay"]["seen_px"].dump();
        std::string names;
        for (const json& one : said["names"]["named"]) names += one["name"].get<std::string>() + ";";
        return names;
    }
};

TEST_F(VectorFormats, GiveTheSameLine) {
    const std::string expected =
        drawn("--overlay",
              written("a.geojson", oro::test::collection(oro::test::feature(
                                       "LineString", "[[-84.35,36.56],[-84.25,36.6],[-84.15,36.57]]"))));
    ASSERT_GT(std::stod(expected), 100.0);
    const std::string kml = oro::test::kml(
        "<Placemark><LineString><coordinates>-84.35,36.56 -84.25,36.6 "
        "-84.15,36.57</coordinates></LineString></Placemark>");
    for (const std::string& file :
         {vector_dataset("a.shp", "ESRI Shapefile", 4326, {{line_wkt, "way"}}),
          vector_dataset("a.fgb", "FlatGeobuf", 4326, {{line_wkt, "way"}}),
          oro::test::written_zip("a.kmz", {{"doc.kml", kml}}),
          written("a.csv", "name,WKT\nway,\"" + std::string(line_wkt) + "\"\n"),
          written("a.topojson",
                  R"({"type":"Topology","objects":{"way":{"type":"LineString","arcs":[0,-2]}},)"
                  R"("arcs":[[[-84.35,36.56],[-84.25,36.6]],[[-84.15,36.57],[-84.25,36.6]]]})")})
        EXPECT_EQ(drawn("--overlay", file), expected) << file;
}

TEST_F(VectorFormats, GiveTheSameName) {
    for (const std::string& file :
         {vector_dataset("p.shp", "ESRI Shapefile", 4326, {{peak_wkt, "Peak"}}),
          vector_dataset("p.fgb", "FlatGeobuf", 4326, {{peak_wkt, "Peak"}}),
          written("p.csv", "name,lat,lon\nPeak,36.6,-84.27\n"),
          written("q.csv", "name;lat;lon\nPeak;36,6;-84,27\n"),
          // EPSG:32616, UTM zone 16 N, by gdaltransform: 744,198.1 E 4,053,970.7 N are -84.27 36.6.
          written("u.csv", "name,E,N,crs\nPeak,744198.1,4053970.7,EPSG:32616\n"),
          written("p.topojson",
                  R"({"type":"Topology","objects":{"p":{"type":"Point","coordinates":[-84.27,36.6],)"
                  R"("properties":{"name":"Peak"}}},"arcs":[]})")})
        EXPECT_EQ(drawn("--names", file), "Peak;") << file;
}

TEST_F(VectorFormats, WhatIsMissingIsOneLine) {
    const std::string shp = vector_dataset("a.shp", "ESRI Shapefile", 4326, {{line_wkt, "way"}});
    fs::remove(folder / "a.prj");
    expect_refusal(shoot("x.png", {"--overlay", shp}), failed, {"a.shp: is a shapefile without its .prj"});
    fs::remove(folder / "a.shx");
    expect_refusal(shoot("x.png", {"--overlay", shp}), failed, {"a.shp: is a shapefile without its .shx"});
    expect_refusal(shoot("x.png", {"--names", written("m.csv", "name,x,y\nA,744198.1,4053970.7\n")}), failed,
                   {"m.csv: its columns x and y state no coordinate reference system"});
    expect_refusal(shoot("x.png", {"--names", written("n.csv", "a,b\n1,2\n")}), failed,
                   {"n.csv: is not a vector file in an accepted format", "names no columns of coordinates"});
    EXPECT_FALSE(fs::exists(folder / "x.png"));
}

}  // namespace
