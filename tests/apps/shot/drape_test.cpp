// --drape as users meet it: what the view tells of images, and what is said of those that are no longer as
// they were, or cannot lie over any ground.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

// Terrain, and the same file as an image over it: grey by its heights.
class ShotDrape : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const std::string land = (folder / "land.tif").string(), image = (folder / "image.tif").string();

    ShotDrape() {
        fs::copy_file(oro::test::bundled_data() / "jacksboro.tif", land);
        fs::copy_file(land, image);
    }
    [[nodiscard]] std::string path(const char* name) const { return (folder / name).string(); }
    static Outcome shoot(const Words& more) {
        Words words{"shot", "--size", "96x64", "-q", "--time", "2026-01-01T00:00:00Z"};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
    static json fingerprints_in(const std::string& png) { return json::parse(view_in(png))["fingerprints"]; }
};

TEST_F(ShotDrape, IsInTheViewWhichDrawsItAgain) {
    ASSERT_EQ(
        shoot({land, "--drape", image, "--drape", land, "--drape-opacity", "0.5", "--out", path("a.png")})
            .exit_code,
        0);
    const json view = json::parse(view_in(path("a.png")));
    EXPECT_EQ(view["drape"], (json{{"files", {"image.tif", "land.tif"}}, {"opacity", 0.5}}));
    EXPECT_EQ(view["fingerprints"]["images"].size(), 2U);
    EXPECT_EQ(view["fingerprints"]["images"][0]["posts"], view["fingerprints"]["images"][1]["posts"]);
    ASSERT_EQ(shoot({"--view", path("a.png"), "--out", path("b.png")}).exit_code, 0);
    EXPECT_EQ(bytes_of(path("a.png")), bytes_of(path("b.png")));
}

TEST_F(ShotDrape, LeavesPicturesWithoutItAsTheyWere) {
    ASSERT_EQ(shoot({land, "--out", path("bare.png")}).exit_code, 0);
    EXPECT_FALSE(json::parse(view_in(path("bare.png"))).contains("drape"));
    EXPECT_FALSE(fingerprints_in(path("bare.png")).contains("images"));
    // Images that nothing is seen of.
    ASSERT_EQ(shoot({land, "--drape", image, "--drape-opacity", "0", "--out", path("clear.png")}).exit_code,
              0);
    EXPECT_EQ(fingerprints_in(path("bare.png"))["pixels"], fingerprints_in(path("clear.png"))["pixels"]);
    ASSERT_EQ(shoot({land, "--drape", image, "--out", path("draped.png")}).exit_code, 0);
    EXPECT_NE(fingerprints_in(path("bare.png"))["pixels"], fingerprints_in(path("draped.png"))["pixels"]);
}

TEST_F(ShotDrape, IsTheSameOverABakedRegion) {
    ASSERT_EQ(run_orograph({"bake", land, "--out", path("land.oro"), "-q"}).exit_code, 0);
    const Words eye{"--at", "36.5,-84.25", "--above", "1500", "--pitch", "-30", "--drape", image};
    Words tile{land, "--out", path("tile.png")}, baked{path("land.oro"), "--out", path("baked.png")};
    tile.insert(tile.end(), eye.begin(), eye.end());
    baked.insert(baked.end(), eye.begin(), eye.end());
    ASSERT_EQ(shoot(tile).exit_code, 0);
    ASSERT_EQ(shoot(baked).exit_code, 0);
    EXPECT_EQ(fingerprints_in(path("tile.png"))["pixels"], fingerprints_in(path("baked.png"))["pixels"]);
}

TEST_F(ShotDrape, ThatChangedIsTold) {
    ASSERT_EQ(shoot({land, "--drape", image, "--out", path("a.png")}).exit_code, 0);
    write_bytes(image, bytes_of(image) + "x");
    const Outcome changed = shoot({"--view", path("a.png"), "--out", path("b.png")});
    expect_refusal(changed, failed, {"image.tif", "is another image", "--data-changed"});
    EXPECT_EQ(shoot({"--view", path("a.png"), "--out", path("b.png"), "--data-changed"}).exit_code, 0);
    fs::remove(image);
    expect_refusal(shoot({"--view", path("a.png"), "--out", path("c.png")}), failed,
                   {"image.tif", "no such image"});
}

// An image of one colour over all of the terrain.
void make_even_image(const std::string& file, const char* type, const char* value, const Words& more = {}) {
    Words words{"gdal_create", "-q",      "-of",    "GTiff", "-ot",   type,  "-outsize",
                "40",          "40",      "-bands", "3",     "-burn", value, "-a_srs",
                "EPSG:4326",   "-a_ullr", "-85",    "37",    "-84",   "36"};
    words.insert(words.end(), more.begin(), more.end());
    words.push_back(file);
    const Outcome made = run_program(words);
    ASSERT_EQ(made.exit_code, 0) << made.err;
}

// A profile of grey whose curve has the exponent 2.2: 128 bytes of header, one tag, 'curv' with 0x0233.
const char* const profile_of_pictures =
    "AAAAngAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAYWNzcAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"
    "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAABa1RS"
    "QwAAAJAAAAAOY3VydgAAAAAAAAABAjM=";

// 32,896 of 65,535 is 128 of 255.
TEST_F(ShotDrape, OfSixteenBitsIsWhatItsProfileOrTheOptionSays) {
    make_even_image(path("bytes.tif"), "Byte", "128");
    make_even_image(path("plain.tif"), "UInt16", "32896");
    make_even_image(path("picture.tif"), "UInt16", "32896",
                    {"-co", std::string("SOURCE_ICC_PROFILE=") + profile_of_pictures});
    const auto drawn = [&](const char* file, const Words& more = {}) {
        const std::string png = path(file) + (more.empty() ? "" : more.back()) + ".png";
        Words words{land, "--drape", path(file), "--out", png};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_EQ(shoot(words).exit_code, 0);
        return fingerprints_in(png)["pixels"];
    };
    const json bytes = drawn("bytes.tif");
    EXPECT_EQ(drawn("picture.tif"), bytes);
    EXPECT_EQ(drawn("plain.tif", {"--drape-values", "codes"}), bytes);
    const json light = drawn("plain.tif");
    EXPECT_NE(light, bytes) << "without a profile it is light";
    EXPECT_EQ(drawn("plain.tif", {"--drape-values", "auto"}), light);
    EXPECT_EQ(drawn("picture.tif", {"--drape-values", "reflectance"}), light);

    const std::string as_codes = path("plain.tif") + "codes.png";
    EXPECT_EQ(json::parse(view_in(as_codes))["drape"],
              (json{{"files", {"plain.tif"}}, {"opacity", 1.0}, {"values", "codes"}}));
    ASSERT_EQ(shoot({"--view", as_codes, "--out", path("again.png")}).exit_code, 0);
    EXPECT_EQ(bytes_of(as_codes), bytes_of(path("again.png")));
}

TEST_F(ShotDrape, ThatCannotLieOverGroundIsOneLine) {
    write_bytes(path("text.tif"), "this is no image");
    expect_refusal(shoot({land, "--drape", path("text.tif"), "--out", path("a.png")}), failed,
                   {"text.tif", "is not an image in an accepted format"});
    const auto vrt = [&](const char* crs, const char* map) {
        write_bytes(path("image.vrt"), std::string("<VRTDataset rasterXSize=\"9\" rasterYSize=\"9\">") + crs +
                                           "<GeoTransform>" + map +
                                           "</GeoTransform><VRTRasterBand dataType=\"Byte\" band=\"1\"/>"
                                           "</VRTDataset>");
        return shoot({land, "--drape", path("image.vrt"), "--out", path("a.png")});
    };
    expect_refusal(vrt("", "-85, 0.1, 0, 37, 0, -0.1"), failed, {"image.vrt", "coordinate reference system"});
    expect_refusal(vrt("<SRS>EPSG:4326</SRS>", "nan, 0.1, 0, 37, 0, -0.1"), failed,
                   {"image.vrt", "no map from pixels to places"});
    expect_refusal(vrt("<SRS>EPSG:4326</SRS>", "-85, 0, 0, 37, 0, 0"), failed,
                   {"image.vrt", "no map from pixels to places"});
    expect_refusal(shoot({land, "--drape-opacity", "1", "--out", path("a.png")}), usage, {"--drape-opacity"});
    expect_refusal(shoot({land, "--drape", image, "--drape-opacity", "1.5", "--out", path("a.png")}), usage,
                   {"--drape-opacity 1.5", "between 0 and 1"});
    expect_refusal(shoot({land, "--drape-values", "codes", "--out", path("a.png")}), usage,
                   {"--drape-values", "says nothing without --drape FILE"});
    expect_refusal(shoot({land, "--drape", image, "--drape-values", "bright", "--out", path("a.png")}), usage,
                   {"--drape-values bright", "auto, codes or reflectance"});
    expect_refusal(shoot({land, "--drape", image, "--out", image, "--overwrite"}), usage, {"image.tif"});
}

// 16,000 million pixels of which the file holds none, or few: as quick as a small one.
TEST_F(ShotDrape, OfAnEmptyGiantIsQuick) {
    for (const char* type : {"Byte", "UInt16"}) {
        fs::remove(path("giant.tif"));
        ASSERT_EQ(run_program({"gdal_create",
                               "-q",
                               "-of",
                               "GTiff",
                               "-outsize",
                               "128000",
                               "128000",
                               "-bands",
                               "3",
                               "-ot",
                               type,
                               "-co",
                               "SPARSE_OK=TRUE",
                               "-co",
                               "TILED=YES",
                               "-co",
                               "BLOCKXSIZE=4096",
                               "-co",
                               "BLOCKYSIZE=4096",
                               "-co",
                               "COMPRESS=DEFLATE",
                               "-a_srs",
                               "EPSG:4269",
                               "-a_ullr",
                               "-85",
                               "37",
                               "-84",
                               "36",
                               path("giant.tif")})
                      .exit_code,
                  0);
        ASSERT_LT(fs::file_size(path("giant.tif")), 40'000U);
        const auto start = std::chrono::steady_clock::now();
        const Outcome drawn =
            shoot({land, "--drape", path("giant.tif"), "--out", path("p.png"), "--overwrite"});
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        EXPECT_LT(took.count(), 20.0) << type;
    }
}

}  // namespace
