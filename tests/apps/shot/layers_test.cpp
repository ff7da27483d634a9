// orograph shot --layers as people use it: what files there are, and what GDAL reads in them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/layer_value.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::names_in;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;
using oro::test::write_bytes;

const Words all_names{"p.distance.tif",  "p.ellipsoidal-height.tif",
                      "p.height.tif",    "p.latitude.tif",
                      "p.longitude.tif", "p.png",
                      "p.shadow.tif",    "p.slope.tif",
                      "p.source.tif"};

Words shot_with_layers(const fs::path& picture, const Words& more = {}) {
    Words words{"shot",      (oro::test::bundled_data() / "jacksboro.tif").string(),
                "--at",      "36.5,-84.25",
                "--above",   "200",
                "--heading", "320",
                "--pitch",   "-8",
                "--size",    "64x48",
                "--sun",     "300,20",
                "-q",        "--layers",
                "--out",     picture.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(ShotLayers, AreFilesThatGdalReads) {
    const fs::path folder = oro::test::scratch_folder(), picture = folder / "p.png";
    const auto reported = object_said_by(shot_with_layers(picture, {"--json", "--tau", "0"}));
    EXPECT_EQ(names_in(folder), all_names);
    EXPECT_EQ(reported["layers"].size(), 8U);
    EXPECT_EQ(reported["layers"]["ellipsoidal-height"], (folder / "p.ellipsoidal-height.tif").string());
    EXPECT_GT(reported["layer_pixels"]["ground"].get<int>(), 1000);
    if (run_program({"gdalinfo", "--version"}).exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    for (const auto& [layer, file] : reported["layers"].items()) {
        const auto info = oro::test::one_object(run_program({"gdalinfo", "-json", file}).out);
        EXPECT_EQ(info["size"], nlohmann::json({64, 48})) << layer;
        ASSERT_EQ(info["bands"].size(), 1U);
        const auto& band = info["bands"][0];
        const bool is_degrees = layer == "longitude" || layer == "latitude";
        EXPECT_EQ(band["type"], is_degrees ? "Float64" : "Float32") << layer;
        EXPECT_EQ(band["noDataValue"], "NaN") << layer;
        EXPECT_FALSE(band["description"].get<std::string>().empty()) << layer;
        EXPECT_EQ(band.value("unit", ""), is_degrees || layer == "slope"           ? "degree"
                                          : layer == "source" || layer == "shadow" ? ""
                                                                                   : "metre")
            << layer;
        EXPECT_EQ(info["metadata"][""]["PICTURE"], "p.png");
    }
    // The middle of pixel (40, 32), and the sky in the first.
    const auto layer = [&](const char* name, int x, int y) {
        return oro::test::layer_value(folder / ("p." + std::string(name) + ".tif"), x, y);
    };
    EXPECT_TRUE(std::isnan(layer("latitude", 0, 0)));
    EXPECT_TRUE(std::isnan(layer("shadow", 0, 0)));
    const double lat = layer("latitude", 40, 32), lon = layer("longitude", 40, 32);
    EXPECT_GT(lat, 36.5);
    EXPECT_LT(lon, -84.25);
    const auto H = run_program({"gdallocationinfo", "-valonly", "-wgs84",
                                (oro::test::bundled_data() / "jacksboro.tif").string(), std::to_string(lon),
                                std::to_string(lat)});
    EXPECT_NEAR(layer("height", 40, 32), std::stod(H.out), 40.0) << "the nearest post";
    // The geoid is some 31 m below the ellipsoid in Tennessee.
    EXPECT_NEAR(layer("ellipsoidal-height", 40, 32) - layer("height", 40, 32), -31.0, 1.5);
    EXPECT_EQ(layer("source", 40, 32), 0.0);
    const double shadow = layer("shadow", 40, 32);
    EXPECT_TRUE(shadow == 0.0 || shadow == 1.0) << shadow;
}

TEST(ShotLayers, AreNoPartOfTheView) {
    const fs::path folder = oro::test::scratch_folder(), other = oro::test::scratch_folder();
    ASSERT_EQ(run_orograph(shot_with_layers(folder / "p.png", {"--time", "2026-01-02T03:04:05Z"})).exit_code,
              0);
    const auto again = run_orograph(
        {"shot", "--view", (folder / "p.png").string(), "--out", (other / "p.png").string(), "-q"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(names_in(other), Words{"p.png"});
    // A picture that is there gets them afterwards, the same bytes, and stays as it is.
    const std::string picture = bytes_of(other / "p.png");
    const auto later = run_orograph({"shot", "--view", (other / "p.png").string(), "--layers", "-q"});
    EXPECT_EQ(later.exit_code, 0) << later.err;
    EXPECT_EQ(names_in(other), all_names);
    EXPECT_EQ(bytes_of(other / "p.png"), picture);
    for (const std::string& name : all_names)
        EXPECT_TRUE(name == "p.png" || bytes_of(other / name) == bytes_of(folder / name)) << name;
}

TEST(ShotLayers, AreAllWrittenOrNone) {
    const fs::path folder = oro::test::scratch_folder();
    write_bytes(folder / "p.slope.tif", "mine");
    expect_refusal(run_orograph(shot_with_layers(folder / "p.png")), 1,
                   {"p.slope.tif", "is there already (--overwrite"});
    EXPECT_EQ(names_in(folder), Words{"p.slope.tif"});
    EXPECT_EQ(bytes_of(folder / "p.slope.tif"), "mine");
    EXPECT_EQ(run_orograph(shot_with_layers(folder / "p.png", {"--overwrite"})).exit_code, 0);
    EXPECT_EQ(names_in(folder), all_names);
    EXPECT_NE(bytes_of(folder / "p.slope.tif"), "mine");
}

// Data of that name are not replaced, --overwrite or not.
TEST(ShotLayers, SpareWhatThePictureIsMadeFrom) {
    const fs::path folder = oro::test::scratch_folder();
    fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", folder / "p.height.tif");
    Words words = shot_with_layers(folder / "p.png", {"--overwrite"});
    words[1] = (folder / "p.height.tif").string();
    expect_refusal(run_orograph(words), 2, {"p.height.tif", "which the picture is made from"});
    EXPECT_EQ(names_in(folder), Words{"p.height.tif"});
}

TEST(ShotLayers, OfPicturesTooLargeForMemoryAreRefused) {
    Words words = shot_with_layers(oro::test::scratch_folder() / "p.png");
    words[11] = "20000x10000";
    expect_refusal(run_orograph(words), 2, {"--layers", "at most 100,000,000 pixels"});
}

}  // namespace
