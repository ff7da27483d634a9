// Colours that files of meshes state, as users see them.
#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;

// A level roof 89 m by 222 m at 420 m, of a colour in the west and one in the east; "": without colours.
std::string roof_ply(const std::string& west, const std::string& east) {
    std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
        "property double z\n";
    if (!west.empty()) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    return text + "element face 1\nproperty list uchar int vertex_indices\nend_header\n-84.1765 36.604 420 " +
           west + "\n-84.1755 36.604 420 " + east + "\n-84.1755 36.606 420 " + east +
           "\n-84.1765 36.606 420 " + west + "\n4 0 1 2 3\n";
}

class MeshColoursSeen : public ::testing::Test {
  protected:
    // The middle of a picture from 300 m above the ground, straight down, of a roof: red, green and blue.
    [[nodiscard]] std::array<int, 3> middle_of(const std::string& ply, const std::string& style,
                                               const Words& more = {}) const {
        oro::test::write_bytes(roof_, ply);
        const Outcome drawn = run_orograph(joined(
            {"shot",       bundled(),   "--at",  "36.605,-84.176", "--altitude",  "650",         "--pitch",
             "-90",        "--size",    "64x48", "--style",        style,         "--mesh-file", roof_,
             "--mesh-crs", "EPSG:4326", "--out", picture_,         "--overwrite", "-q"},
            more));
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        if (drawn.exit_code != 0) return {};
        const Pixels pixels = pixels_of(picture_);
        const std::size_t at = 3 * (24 * 64 + 32);
        return {pixels.rgb[at], pixels.rgb[at + 1], pixels.rgb[at + 2]};
    }

    const fs::path folder_ = oro::test::scratch_folder();
    const std::string roof_ = (folder_ / "roof.ply").string(), picture_ = (folder_ / "roof.png").string();
};

// The style plain has one colour for all ground, #eae6de: a roof in this colour is drawn as one without any,
// to the code of 8 bits that rounding may take. A red one is red, by both ways of drawing.
TEST_F(MeshColoursSeen, AreThoseOfTheFileInThePlainStyle) {
    const std::array<int, 3> bare = middle_of(roof_ply("", ""), "plain"),
                             same = middle_of(roof_ply("234 230 222", "234 230 222"), "plain");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(same[i], bare[i], 1);
    for (const std::string pipeline : {"compute", "mesh"}) {
        const std::array<int, 3> red =
            middle_of(roof_ply("234 0 0", "234 0 0"), "plain", {"--pipeline", pipeline});
        EXPECT_NEAR(red[0], bare[0], 1) << pipeline << ": of the same red, in the same light";
        EXPECT_EQ(red[1], 0) << pipeline;
        EXPECT_EQ(red[2], 0) << pipeline;
    }
    const std::array<int, 3> as_asked =
        middle_of(roof_ply("234 0 0", "234 0 0"), "plain", {"--mesh-look", "plain"});
    EXPECT_EQ(as_asked, bare);
    EXPECT_EQ(json::parse(view_in(picture_))["meshes"]["look"], "plain");
}

// A roof by OBJ whose texture, of one texel, is red looks as one of red vertices does; without the texture it
// has the colour of its material, and a note names what is missing.
TEST_F(MeshColoursSeen, AreThoseOfATexture) {
    const std::array<int, 3> red = middle_of(roof_ply("234 0 0", "234 0 0"), "plain");
    const std::string obj = (folder_ / "roof.obj").string(), png = (folder_ / "red.png").string();
    oro::test::write_bytes(
        obj,
        "mtllib roof.mtl\nv -84.1765 36.604 420\nv -84.1755 36.604 420\nv -84.1755 36.606 420\n"
        "v -84.1765 36.606 420\nvt 0 0\nvt 1 1\nusemtl roof\nf 1/1 2/1 3/2 4/2\n");
    oro::test::write_bytes((folder_ / "roof.mtl").string(), "newmtl roof\nKd 1 1 1\nmap_Kd red.png\n");
    const std::vector<std::uint8_t> texel{234, 0, 0};
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = image.height = 1;
    image.format = PNG_FORMAT_RGB;
    ASSERT_NE(png_image_write_to_file(&image, png.c_str(), 0, texel.data(), 0, nullptr), 0);
    const Words shot{"shot",        bundled(), "--at",       "36.605,-84.176", "--altitude", "650",
                     "--pitch",     "-90",     "--size",     "64x48",          "--style",    "plain",
                     "--mesh-file", obj,       "--mesh-crs", "EPSG:4326",      "--out",      picture_,
                     "--overwrite"};
    Outcome drawn = run_orograph(shot);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_TRUE(oro::test::says(drawn.err, "colours of its texture are averaged at vertices")) << drawn.err;
    const std::size_t at = 3 * (24 * 64 + 32);
    Pixels pixels = pixels_of(picture_);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(pixels.rgb[at + i], red[i], 1);
    fs::remove(png);
    drawn = run_orograph(shot);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_TRUE(oro::test::says(drawn.err, "its texture red.png cannot be opened")) << drawn.err;
    pixels = pixels_of(picture_);
    EXPECT_GT(pixels.rgb[at + 1], 200) << "white, as Kd says";
}

// In the style natural a mesh without colours is grey, of light 0.40, 0.395 and 0.385, with a grain of a few
// per cent (built_colour.glsl): codes 170, 169 and 167 are the same colour. Blue stays blue through the air.
TEST_F(MeshColoursSeen, AreThoseOfTheFileInTheStyleNatural) {
    const std::array<int, 3> bare = middle_of(roof_ply("", ""), "natural"),
                             same = middle_of(roof_ply("170 169 167", "170 169 167"), "natural"),
                             blue = middle_of(roof_ply("0 0 170", "0 0 170"), "natural");
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(same[i], bare[i], 8);
    EXPECT_NEAR(blue[2], bare[2], 12);
    EXPECT_LT(blue[0], bare[0] / 3);
}

// Styles that colour by height or slope are of these. Between two colours light changes evenly: in the middle
// it is half of white's, which less than half of its code would not be.
TEST_F(MeshColoursSeen, AreMixedAsLight) {
    EXPECT_EQ(middle_of(roof_ply("255 0 0", "255 0 0"), "slope"), middle_of(roof_ply("", ""), "slope"));
    const std::array<int, 3> white = middle_of(roof_ply("255 255 255", "255 255 255"), "plain"),
                             half = middle_of(roof_ply("0 0 0", "255 255 255"), "plain");
    EXPECT_NEAR(half[1], 0.7354 * white[1], 6);
}

// Of clusters, and of a baked file, too.
TEST_F(MeshColoursSeen, StayWithClustersAndBakedFiles) {
    const std::string red = roof_ply("234 0 0", "234 0 0");
    const std::array<int, 3> all = middle_of(red, "plain");
    EXPECT_EQ(middle_of(red, "plain", {"--mesh", "clusters"}), all);
    const std::string baked = (folder_ / "roof.oro").string();
    const Outcome bake = run_orograph(
        {"bake", bundled(), "--mesh-file", roof_, "--mesh-crs", "EPSG:4326", "--out", baked, "-q"});
    ASSERT_EQ(bake.exit_code, 0) << bake.err;
    const Outcome drawn =
        run_orograph({"shot", baked, "--at", "36.605,-84.176", "--altitude", "650", "--pitch", "-90",
                      "--size", "64x48", "--style", "plain", "--out", picture_, "--overwrite", "-q"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Pixels pixels = pixels_of(picture_);
    const std::size_t at = 3 * (24 * 64 + 32);
    EXPECT_EQ((std::array<int, 3>{pixels.rgb[at], pixels.rgb[at + 1], pixels.rgb[at + 2]}), all);
}

// A picture draws itself again with the crease that it was drawn with.
TEST_F(MeshColoursSeen, TheCreaseIsRecorded) {
    static_cast<void>(middle_of(roof_ply("", ""), "plain", {"--crease", "45"}));
    const json view = json::parse(view_in(picture_));
    EXPECT_EQ(view["meshes"]["crease_deg"], 45.0);
    const std::string again = (folder_ / "again.png").string();
    const Outcome redrawn = run_orograph({"shot", "--view", picture_, "--out", again, "--overwrite", "-q"});
    ASSERT_EQ(redrawn.exit_code, 0) << redrawn.err;
    EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"], view["fingerprints"]["pixels"]);
    expect_refusal(
        run_orograph({"shot", bundled(), "--crease", "45", "-q", "--out", picture_, "--overwrite"}), usage,
        {"--crease", "without --mesh-file"});
    expect_refusal(run_orograph({"shot", bundled(), "--mesh-file", roof_, "--crease", "181", "-q", "--out",
                                 picture_, "--overwrite"}),
                   usage, {"--crease", "181"});
}

// The ground as 3D Tiles and as a model, over the ground that it was made of: within the errors that are
// proven.
TEST_F(MeshColoursSeen, WhatIsExportedOpensAgain) {
    const std::string tiles = (folder_ / "tiles").string(), model = (folder_ / "model.glb").string();
    const Words box{"--bbox", "-84.20,36.58,-84.15,36.63", "-q"};
    for (const Words& to : {Words{"--to", "3dtiles", "--out", tiles},
                            Words{"--to", "gltf", "--max-error", "5", "--out", model}}) {
        const Outcome made = run_orograph(joined(joined({"export", bundled()}, box), to));
        ASSERT_EQ(made.exit_code, 0) << made.err;
    }
    for (const std::string& file : {tiles + "/tileset.json", model}) {
        const Outcome listed = run_orograph({"info", bundled(), "--mesh-file", file});
        ASSERT_EQ(listed.exit_code, 0) << listed.err;
        EXPECT_TRUE(oro::test::says(listed.out + listed.err, "heights above the WGS84 ellipsoid"))
            << listed.out << listed.err;
    }
}

}  // namespace
