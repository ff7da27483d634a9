// orograph export --to cog --layer: slopes and canopies at posts, held against what GDAL makes of the same
// files.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

constexpr double no_value = -32768.0;

// A pixel as GDAL's program reads it: x, y and value.
using Pixel = std::array<double, 3>;
std::vector<Pixel> pixels_by_gdal(const fs::path& raster) {
    const fs::path text = raster.string() + ".xyz";
    EXPECT_EQ(run_program({"gdal_translate", "-q", "-of", "XYZ", raster.string(), text.string()}).exit_code,
              0);
    std::ifstream file(text);
    std::vector<Pixel> pixels;
    for (Pixel pixel; file >> pixel[0] >> pixel[1] >> pixel[2];) pixels.push_back(pixel);
    return pixels;
}

bool has_gdal() {
    return run_program({"gdalwarp", "--version"}).exit_code == 0;
}

Words layer_words(const fs::path& from, const std::string& layer, const fs::path& out,
                  const Words& more = {}) {
    return oro::test::joined(
        {"export", from.string(), "-q", "--json", "--to", "cog", "--layer", layer, "--out", out.string()},
        more);
}

// On squares of 90 m in UTM. gdaldem counts along the map, the program on the ellipsoid: this zone's scale is
// between 0.9996 and 1.0007 here, which is 0.02 degrees at 45 and less elsewhere.
TEST(ExportLayers, SlopeIsGdaldems) {
    if (!has_gdal()) GTEST_SKIP() << "needs GDAL's programs";
    const fs::path folder = oro::test::scratch_folder(), map = folder / "utm.tif";
    ASSERT_EQ(run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-tr", "90", "90", "-r", "bilinear",
                           "-ot", "Float32", "-dstnodata", "-32768", bundled(), map.string()})
                  .exit_code,
              0);
    const auto said = object_said_by(layer_words(map, "slope", folder / "slope.tif"));
    EXPECT_EQ(said["layer"], "slope");
    EXPECT_EQ(said["type"], "float32");
    ASSERT_EQ(run_program({"gdaldem", "slope", "-q", map.string(), (folder / "gdal.tif").string()}).exit_code,
              0);
    const auto ours = pixels_by_gdal(folder / "slope.tif"), theirs = pixels_by_gdal(folder / "gdal.tif");
    ASSERT_EQ(ours.size(), theirs.size());
    std::size_t compared = 0;
    double largest_deg = 0.0, steepest_deg = 0.0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        EXPECT_EQ(ours[i][0], theirs[i][0]);
        // gdaldem says nothing beside a void and at the rim.
        if (theirs[i][2] < 0.0) continue;
        ++compared;
        ASSERT_NE(ours[i][2], no_value);
        largest_deg = std::max(largest_deg, std::abs(ours[i][2] - theirs[i][2]));
        steepest_deg = std::max(steepest_deg, theirs[i][2]);
    }
    std::printf("%zu posts, up to %.1f degrees; largest difference from gdaldem %.4f degrees\n", compared,
                steepest_deg, largest_deg);
    EXPECT_GT(compared, 100000U);
    EXPECT_GT(steepest_deg, 30.0);
    EXPECT_LT(largest_deg, 0.02);
    const auto info =
        oro::test::one_object(run_program({"gdalinfo", "-json", (folder / "slope.tif").string()}).out);
    EXPECT_EQ(info["metadata"]["IMAGE_STRUCTURE"]["LAYOUT"], "COG");
    EXPECT_EQ(info["bands"][0]["unit"], "degree");
    EXPECT_EQ(info["bands"][0]["noDataValue"], no_value);
}

// A canopy on the posts' own cells, of the ground's heights by 0.05: each post has its pixel's value, and
// none south of 36.5 degrees, where the canopy's file ends.
TEST(ExportLayers, CanopyIsThatOfItsFile) {
    if (!has_gdal()) GTEST_SKIP() << "needs GDAL's programs";
    const fs::path folder = oro::test::scratch_folder(), trees = folder / "trees.tif";
    ASSERT_EQ(run_program({"gdal_translate", "-q", "-ot", "Float32", "-scale", "0", "1000", "0", "50",
                           "-srcwin", "0", "0", "403", "200", bundled(), trees.string()})
                  .exit_code,
              0);
    const auto said =
        object_said_by(layer_words(bundled(), "canopy", folder / "c.tif", {"--canopy", trees.string()}));
    EXPECT_EQ(said["voids"], 403 * (344 - 200));
    const auto ours = pixels_by_gdal(folder / "c.tif"), theirs = pixels_by_gdal(trees);
    ASSERT_EQ(ours.size(), 403U * 344U);
    ASSERT_EQ(theirs.size(), 403U * 200U);
    double largest_m = 0.0, highest_m = 0.0;
    for (std::size_t i = 0; i < ours.size(); ++i) {
        if (i >= theirs.size()) {
            ASSERT_EQ(ours[i][2], no_value);
            continue;
        }
        largest_m = std::max(largest_m, std::abs(ours[i][2] - theirs[i][2]));
        highest_m = std::max(highest_m, theirs[i][2]);
    }
    // Text has seven digits.
    EXPECT_LT(largest_m, 1e-4);
    EXPECT_GT(highest_m, 40.0);
}

TEST(ExportLayers, WordsThatDoNotFit) {
    const fs::path out = oro::test::scratch_folder() / "o.tif";
    const auto refused = [&](const Words& words, const std::string& line) {
        expect_refusal(
            run_orograph(oro::test::joined({"export", bundled(), "-q", "--out", out.string()}, words)),
            oro::test::usage, {line});
        EXPECT_FALSE(fs::exists(out));
    };
    refused({"--to", "gltf", "--layer", "slope"}, "--layer slope: needs --to cog");
    refused({"--to", "cog", "--layer", "canopy"}, "--layer canopy: needs --canopy");
    refused({"--to", "cog", "--canopy", "trees.tif"}, "--canopy trees.tif: needs --layer canopy");
    refused({"--to", "cog", "--layer", "slope", "--detail", "1"}, "--detail 1: needs --layer H");
    refused({"--to", "cog", "--layer", "canopy", "--canopy", "class"}, "--canopy");
}

}  // namespace
