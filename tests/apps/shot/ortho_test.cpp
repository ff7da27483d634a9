// orograph shot --ortho as people use it: what GDAL says of the file, and what is refused.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::names_in;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;
using oro::test::write_bytes;

Words map(const fs::path& out, const Words& more = {}) {
    Words words{"shot",
                bundled(),
                "--ortho",
                "--bbox",
                "-84.3,36.45,-84.2,36.55",
                "-q",
                "--time",
                "2026-01-02T03:04:05Z",
                "--out",
                out.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(ShotOrtho, IsAGeoTiffInItsCrs) {
    const fs::path folder = oro::test::scratch_folder(), out = folder / "m.tif";
    const auto reported = object_said_by(map(out, {"--json", "--resolution", "100"}));
    EXPECT_EQ(names_in(folder), (Words{"m.tfw", "m.tif"}));
    // The middle of the region is 84.25 degrees west: zone 16, from 90 to 84 W.
    EXPECT_EQ(reported["map"]["crs"], "EPSG:32616 WGS 84 / UTM zone 16N");
    EXPECT_EQ(reported["map"]["unit"], "metre");
    EXPECT_EQ(reported["view"]["map"]["crs"], "EPSG:32616");
    const auto shown = run_program({"gdalinfo", "-json", out.string()});
    if (shown.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto info = oro::test::one_object(shown.out);
    EXPECT_NE(info["coordinateSystem"]["wkt"].get<std::string>().find("ID[\"EPSG\",32616]"),
              std::string::npos);
    EXPECT_EQ(info["geoTransform"][1], 100.0);
    EXPECT_EQ(info["geoTransform"][5], -100.0);
    EXPECT_EQ(info["geoTransform"][0], reported["map"]["left"]);
    // 0.1 degree is some 9 km by 11 km there.
    EXPECT_NEAR(info["size"][0].get<int>(), 92, 4);
    EXPECT_NEAR(info["size"][1].get<int>(), 113, 4);
    ASSERT_EQ(info["bands"].size(), 4U);
    EXPECT_EQ(info["bands"][3]["colorInterpretation"], "Alpha");
    const auto& middle = info["wgs84Extent"]["coordinates"][0][0];
    EXPECT_NEAR(middle[0].get<double>(), -84.3, 0.01);
    EXPECT_NEAR(middle[1].get<double>(), 36.55, 0.01);
    char first[40];
    std::snprintf(first, sizeof first, "%.17g", reported["map"]["left"].get<double>() + 50.0);
    EXPECT_EQ(bytes_of(folder / "m.tfw").find("100\n0\n0\n-100\n" + std::string(first) + "\n"), 0U);
}

// OGC:CRS84 is EPSG:4326 with longitude first, which a GeoTIFF cannot say and has anyway.
TEST(ShotOrtho, IsAGeoTiffInCrs84) {
    const fs::path folder = oro::test::scratch_folder(), out = folder / "m.tif";
    const Outcome drawn = run_orograph(map(out, {"--crs", "OGC:CRS84", "--size", "40x40"}));
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const auto shown = run_program({"gdalinfo", "-json", out.string()});
    if (shown.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto info = oro::test::one_object(shown.out);
    EXPECT_NEAR(info["geoTransform"][0].get<double>(), -84.3, 0.01);
    EXPECT_NEAR(info["geoTransform"][3].get<double>(), 36.55, 0.01);
}

TEST(ShotOrtho, ItsViewDrawsItAgain) {
    const fs::path folder = oro::test::scratch_folder();
    ASSERT_EQ(run_orograph(map(folder / "m.tif", {"--crs", "EPSG:3857", "--size", "80x90"})).exit_code, 0);
    const auto again = run_orograph(
        {"shot", "--view", (folder / "m.tif").string(), "-q", "--out", (folder / "again.tif").string()});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(bytes_of(folder / "again.tif"), bytes_of(folder / "m.tif"));
    EXPECT_EQ(bytes_of(folder / "again.tfw"), bytes_of(folder / "m.tfw"));
    const auto check = run_orograph({"shot", "--view", (folder / "m.tif").string()});
    EXPECT_EQ(check.exit_code, 0) << check.err;
    EXPECT_NE(check.err.find("its view draws the same bytes"), std::string::npos) << check.err;
    const std::string file = (folder / "m.tif").string();
    expect_refusal(run_orograph({"compare", file}), 2, {"is a map from straight above; only shot"});
    expect_refusal(run_orograph({"plan", "--view", file}), 2, {"is a map from straight above; only shot"});
    expect_refusal(run_orograph({"shot", "--view", file, "--layers"}), 2, {"--layers", "is a map"});
    expect_refusal(run_orograph({"shot", "--view", file, "--size", "9x9", "--out", file + ".png"}), 2,
                   {"--size", "not together with a map's view"});
}

TEST(ShotOrtho, InACrsOfAnotherPlaceIsTold) {
    const fs::path folder = oro::test::scratch_folder();
    const auto said = [&](const std::string& crs) {
        return run_orograph({"shot", bundled(), "--ortho", "--bbox", "-84.3,36.45,-84.2,36.55", "--size",
                             "20x20", "--crs", crs, "--overwrite", "--out", (folder / "m.tif").string()})
            .err;
    };
    const std::string said_of_south = said("EPSG:32716");
    EXPECT_NE(
        said_of_south.find("degrees outside the area that its coordinate reference system, EPSG:32716 WGS "
                           "84 / UTM zone 16S, is made for (80 S to 0 N, 90 W to 84 W)"),
        std::string::npos)
        << said_of_south;
    EXPECT_EQ(said("EPSG:32616").find("the map's middle"), std::string::npos);
}

TEST(ShotOrtho, HasAWorldFileInEveryFormat) {
    const fs::path folder = oro::test::scratch_folder();
    EXPECT_EQ(run_orograph(map(folder / "a.png", {"--size", "40x40"})).exit_code, 0);
    EXPECT_EQ(run_orograph(map(folder / "b.jpg", {"--size", "40x40"})).exit_code, 0);
    EXPECT_EQ(names_in(folder), (Words{"a.pgw", "a.png", "b.jgw", "b.jpg"}));
    EXPECT_EQ(bytes_of(folder / "a.pgw"), bytes_of(folder / "b.jgw"));
    write_bytes(folder / "c.tfw", "mine");
    expect_refusal(run_orograph(map(folder / "c.tif")), 1, {"c.tfw", "is there already (--overwrite"});
    EXPECT_FALSE(fs::exists(folder / "c.tif"));
}

// The bundled region's part lies 2.75 degrees east of the meridian of zone 16: convergence atan(tan 2.75 sin
// 36.5) = 1.6366 degrees, half of which has the sine 0.01428. Grid north is east of north there: the map is
// turned clockwise.
TEST(ShotOrtho, HasAnOverlayAndAPoseBesideIt) {
    const fs::path folder = oro::test::scratch_folder();
    const auto reported =
        object_said_by(map(folder / "m.png", {"--size", "40x44", "--json", "--kml", "--geopose", "--stac"}));
    EXPECT_EQ(names_in(folder), (Words{"m.geopose.json", "m.kml", "m.pgw", "m.png", "m.stac.json"}));
    const std::string kml = bytes_of(folder / "m.kml");
    EXPECT_NE(kml.find("<gx:LatLonQuad><coordinates>-84.30"), std::string::npos) << kml;
    EXPECT_NE(kml.find("<href>m.png</href>"), std::string::npos) << kml;
    const auto pose = oro::test::one_object(bytes_of(folder / "m.geopose.json"));
    EXPECT_NEAR(pose["position"]["lat"].get<double>(), 36.5, 0.002);
    EXPECT_NEAR(pose["position"]["lon"].get<double>(), -84.25, 0.002);
    EXPECT_EQ(pose["position"]["h"], reported["destination"]["h_m"]);
    EXPECT_EQ(pose["quaternion"]["x"], 0.0);
    EXPECT_EQ(pose["quaternion"]["y"], 0.0);
    EXPECT_NEAR(pose["quaternion"]["z"].get<double>(), -0.01428, 3e-5);
    const auto item = oro::test::one_object(bytes_of(folder / "m.stac.json"));
    EXPECT_EQ(item["assets"]["kml"]["href"], "./m.kml");
    EXPECT_EQ(item["assets"]["geopose"]["href"], "./m.geopose.json");
    // Its view writes the same again; nothing is replaced unasked.
    fs::create_directory(folder / "again");
    const Words again{"shot", "--view", (folder / "m.png").string(),          "--kml", "--geopose",
                      "-q",   "--out",  (folder / "again" / "m.png").string()};
    const Outcome drawn = run_orograph(again);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(bytes_of(folder / "again" / "m.kml"), kml);
    EXPECT_EQ(bytes_of(folder / "again" / "m.geopose.json"), bytes_of(folder / "m.geopose.json"));
    write_bytes(folder / "n.tif.kml", "mine");
    expect_refusal(run_orograph(map(folder / "n.tif", {"--kml"})), 1, {"n.tif.kml", "is there already"});
    EXPECT_FALSE(fs::exists(folder / "n.tif"));
}

TEST(ShotOrtho, RefusesWhatAMapCannotHave) {
    const fs::path folder = oro::test::scratch_folder(), out = folder / "m.tif";
    const std::vector<std::pair<Words, Words>> all{
        {{"--at", "36.5,-84.25"}, {"--at: not together with --ortho: a map is seen from straight above"}},
        {{"--pitch", "-3"}, {"--pitch: not together with --ortho"}},
        {{"--refraction", "0.1"},
         {"--refraction: not together with --ortho: it is for pictures from an eye"}},
        {{"--labels", "on"}, {"--labels on: the style 'haze' has no contour lines"}},
        {{"--contour-interval", "20"}, {"--contour-interval: the style 'haze' has no contour lines"}},
        {{"--layers"}, {"--layers: not together with --ortho"}},
        {{"--crs", "EPSG:1"}, {"--crs EPSG:1: is no coordinate reference system that PROJ knows"}},
        {{"--crs", "32616"}, {"--crs 32616: is no coordinate", "did you mean EPSG:32616?"}},
        {{"--crs", "/etc/passwd"}, {"--crs /etc/passwd: is no coordinate reference system that PROJ knows"}},
        {{"--crs", "EPSG:4978"}, {"--crs EPSG:4978: is no map's"}},
        {{"--crs", "+proj=ortho +lat_0=-40 +lon_0=90"}, {"cannot hold this region"}},
        {{"--resolution", "0"}, {"--resolution: must be more than 0"}},
        {{"--resolution", "0.001"}, {"--resolution: makes a map of", "between 1 and 65500"}},
        {{"--resolution", "50", "--size", "9x9"},
         {"--resolution: give either --resolution or --size, not both"}}};
    for (const auto& [words, says] : all) expect_refusal(run_orograph(map(out, words)), 2, says);
    expect_refusal(run_orograph({"shot", bundled(), "--crs", "EPSG:4326", "--out", out.string()}), 2,
                   {"--crs: says nothing without --ortho"});
    EXPECT_EQ(names_in(folder), Words{});
}

}  // namespace
