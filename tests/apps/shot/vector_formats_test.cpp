// Lines and names of vector files in all formats, as users meet them: the same picture from each.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;
using oro::test::write_bytes;

class VectorFormats : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    [[nodiscard]] Outcome shoot(const std::string& picture, const Words& more) const {
        return run_orograph(oro::test::joined(
            {"shot", oro::test::bundled(), "--size", "320x240", "--time", "2026-01-01T00:00:00Z",
             "--no-paths", "--json", "--out", (folder / picture).string()},
            more));
    }
    [[nodiscard]] std::string written(const std::string& name, const std::string& text) const {
        write_bytes(folder / name, text);
        return (folder / name).string();
    }
    static std::string collection(const std::string& geometry, const std::string& name) {
        return R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"name":")" + name +
               R"("},"geometry":)" + geometry + "}]}";
    }
    // What GDAL makes of a GeoJSON file, in UTM zone 16 N.
    [[nodiscard]] std::string converted(const std::string& from, const std::string& name) const {
        const std::string to = (folder / name).string();
        EXPECT_EQ(run_program({"ogr2ogr", "-t_srs", "EPSG:32616", to, from}).exit_code, 0);
        return to;
    }
    [[nodiscard]] std::string zipped(const std::string& file, const std::string& name) const {
        const std::string to = (folder / name).string();
        EXPECT_EQ(run_program({"zip", "-q", "-j", to, file}).exit_code, 0);
        return to;
    }
    // An archive of files of this folder, which have their paths in it.
    [[nodiscard]] std::string zipped_as_they_lie(const std::string& name, const std::string& others) const {
        const std::string command = "cd '" + folder.string() + "' && zip -q -D " + name + " " + others;
        EXPECT_EQ(run_program({"sh", "-c", command}).exit_code, 0) << command;
        return (folder / name).string();
    }
    // A KMZ as GDAL's driver LIBKML writes it: its first file only has a link to another one.
    [[nodiscard]] std::string kmz_with_a_link() const {
        const std::string begin = R"(<kml xmlns="http://www.opengis.net/kml/2.2"><Document>)",
                          end = "</Document></kml>";
        fs::create_directories(folder / "layers");
        write_bytes(folder / "layers" / "p.kml",
                    begin +
                        "<Placemark><name>Peak</name><Point><coordinates>-84.27,36.6,0</coordinates>"
                        "</Point></Placemark>" +
                        end);
        write_bytes(folder / "doc.kml",
                    begin + "<NetworkLink><Link><href>layers/p.kml</href></Link></NetworkLink>" + end);
        return zipped_as_they_lie("q.kmz", "doc.kml layers/p.kml");
    }
    // The length in pixels of what is seen of a file's line.
    [[nodiscard]] double seen_px(const std::string& file) const {
        const Outcome outcome = shoot("drawn.png", {"--overlay", file, "--overwrite"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome.exit_code == 0 ? json::parse(outcome.out)["overlay"]["seen_px"].get<double>() : 0.0;
    }
    // The names that the picture has of a file, with ; behind each.
    [[nodiscard]] std::string named_in(const std::string& file) const {
        const Outcome outcome = shoot("drawn.png", {"--names", file, "--overwrite"});
        if (outcome.exit_code != 0) return outcome.err;
        std::string names;
        const json said = json::parse(outcome.out);
        for (const json& one : said["names"]["named"]) names += one["name"].get<std::string>() + ";";
        return names;
    }
};

TEST_F(VectorFormats, GiveTheSameLine) {
    const std::string json_file = written(
        "a.geojson",
        collection(R"({"type":"LineString","coordinates":[[-84.35,36.56],[-84.25,36.6],[-84.15,36.57]]})",
                   "way"));
    const double expected = seen_px(json_file);
    ASSERT_GT(expected, 100.0);
    const std::string kml = written(
        "doc.kml", R"(<kml xmlns="http://www.opengis.net/kml/2.2"><Placemark><LineString><coordinates>)"
                   "-84.35,36.56 -84.25,36.6 -84.15,36.57</coordinates></LineString></Placemark></kml>");
    for (const std::string& file :
         {converted(json_file, "a.shp"), converted(json_file, "a.fgb"), zipped(kml, "a.kmz"),
          written("b.csv", "name,WKT\nway,\"LINESTRING (-84.35 36.56,-84.25 36.6,-84.15 36.57)\"\n"),
          written("a.topojson",
                  R"({"type":"Topology","objects":{"way":{"type":"LineString","arcs":[0,-2]}},)"
                  R"("arcs":[[[-84.35,36.56],[-84.25,36.6]],[[-84.15,36.57],[-84.25,36.6]]]})")})
        EXPECT_NEAR(seen_px(file), expected, 0.01) << file;
}

TEST_F(VectorFormats, GiveTheSameName) {
    const std::string json_file =
        written("p.geojson", collection(R"({"type":"Point","coordinates":[-84.27,36.6]})", "Peak"));
    const std::string shp = converted(json_file, "p.shp"), kmz = (folder / "p.kmz").string();
    // Not each GDAL has this driver.
    if (run_program({"ogr2ogr", "-f", "LIBKML", kmz, json_file}).exit_code == 0) {
        EXPECT_EQ(named_in(kmz), "Peak;");
    }
    for (const std::string& file :
         {shp, converted(json_file, "p.fgb"), kmz_with_a_link(),
          zipped_as_they_lie("p.zip", "p.shp p.shx p.dbf p.prj"),
          written("d.csv", "name;lat;lon\nPeak;36,6;-84,27\n"),
          // EPSG:32616, UTM zone 16 N, by gdaltransform: 744,198.1 E 4,053,970.7 N are -84.27 36.6.
          written("u.csv", "name,E,N,crs\nPeak,744198.1,4053970.7,EPSG:32616\n"),
          written("p.topojson",
                  R"({"type":"Topology","objects":{"p":{"type":"Point","coordinates":[-84.27,36.6],)"
                  R"("properties":{"name":"Peak"}}},"arcs":[]})")})
        EXPECT_EQ(named_in(file), "Peak;") << file;
}

TEST_F(VectorFormats, WhatIsMissingIsOneLine) {
    const std::string shp = converted(
        written("a.geojson", collection(R"({"type":"Point","coordinates":[-84.27,36.6]})", "Peak")), "a.shp");
    fs::remove(folder / "a.prj");
    expect_refusal(shoot("x.png", {"--overlay", shp}), failed, {"a.shp: is a shapefile without its .prj"});
    fs::remove(folder / "a.shx");
    expect_refusal(shoot("x.png", {"--overlay", shp}), failed, {"a.shp: is a shapefile without its .shx"});
    expect_refusal(shoot("x.png", {"--names", written("m.csv", "name,x,y\nA,744198.1,4053970.7\n")}), failed,
                   {"m.csv: its columns x and y state no coordinate reference system",
                    "or call them lon and lat where they are degrees"});
    expect_refusal(shoot("x.png", {"--names", written("n.csv", "a,b\n1,2\n")}), failed,
                   {"n.csv: is not a vector file in an accepted format", "names no columns of coordinates"});
    EXPECT_FALSE(fs::exists(folder / "x.png"));
}

}  // namespace
