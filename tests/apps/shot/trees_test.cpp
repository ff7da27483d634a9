// --trees: natural without its invented trees.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::Words;

// Low over a wooded slope: trees fill the picture.
class TreesOfShots : public testing::Test {
  protected:
    fs::path folder = oro::test::scratch_folder();
    std::string path(const std::string& name) const { return (folder / name).string(); }
    json shot(const std::string& out, const Words& more) const {
        return object_said_by(
            joined({"shot", bundled(), "--at", "36.52,-84.24", "--above", "12", "--heading", "220", "--size",
                    "96x64", "--time", "2026-01-02T03:04:05Z", "-q", "--json", "--out", path(out)},
                   more));
    }
};

TEST_F(TreesOfShots, OffDrawsWhatAStyleWithoutTreesDraws) {
    const json on = shot("on.png", {"--style", "natural"});
    EXPECT_EQ(on["growth"]["trees"], "invented, by a rule, where the ground cover is forest");
    EXPECT_FALSE(on["view"].contains("trees"));
    const json off = shot("off.png", {"--style", "natural", "--trees", "off"});
    EXPECT_EQ(off["growth"]["trees"], "left out (--trees off)");
    EXPECT_EQ(off["view"]["trees"], false);
    EXPECT_NE(pixels_of(path("on.png")).rgb, pixels_of(path("off.png")).rgb) << "trees were in view";
    json style = json::parse(bytes_of(oro::test::bundled_data() / "styles" / "natural.json"));
    style["growth"]["trees"] = false;
    oro::test::write_bytes(path("bare.json"), style.dump());
    shot("bare.png", {"--style", path("bare.json")});
    EXPECT_EQ(pixels_of(path("off.png")).rgb, pixels_of(path("bare.png")).rgb);
    // A picture is drawn again so, and changed back.
    ASSERT_EQ(run_orograph({"shot", "--view", path("off.png"), "-q", "--out", path("again.png")}).exit_code,
              0);
    EXPECT_EQ(bytes_of(path("again.png")), bytes_of(path("off.png")));
    ASSERT_EQ(
        run_orograph({"shot", "--view", path("off.png"), "--trees", "on", "-q", "--out", path("back.png")})
            .exit_code,
        0);
    EXPECT_EQ(pixels_of(path("back.png")).rgb, pixels_of(path("on.png")).rgb);
}

// A picture low inside a forest shows little but trees: found with not a word about it.
TEST_F(TreesOfShots, SayWhereTheyHideTheView) {
    const auto taken = [&](const Words& more) {
        return run_orograph(
            joined({"shot", bundled(), "--at", "36.52,-84.24", "--heading", "220", "--style", "natural",
                    "--size", "96x64", "--overwrite", "--json", "--out", path("one.png")},
                   more));
    };
    const auto near_eye = [](const auto& run) {
        return json::parse(run.out).at("growth").value("near_eye", json::object());
    };
    const std::string said = "of the picture; --trees off shows the ground, and so does a greater --above";
    const auto low = taken({"--above", "3"});
    ASSERT_EQ(low.exit_code, 0) << low.err;
    EXPECT_NE(low.err.find(said), std::string::npos) << low.err;
    ASSERT_TRUE(near_eye(low).contains("share")) << low.out;
    EXPECT_EQ(near_eye(low)["within_m"], 100.0);
    EXPECT_GT(near_eye(low)["share"].get<double>(), 0.5);
    EXPECT_NE(near_eye(low)["note"].get<std::string>().find(said), std::string::npos);
    // As the same sees it by mesh shaders, and in several samples.
    const auto mesh = taken({"--above", "3", "--pipeline", "mesh", "--samples", "3"});
    ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
    EXPECT_NEAR(near_eye(mesh)["share"].get<double>(), near_eye(low)["share"].get<double>(), 0.02);
    for (const Words& more :
         {Words{"--above", "3", "--trees", "off"}, Words{"--above", "300"}, Words{"--altitude", "3000"}}) {
        const auto run = taken(more);
        ASSERT_EQ(run.exit_code, 0) << run.err;
        EXPECT_EQ(run.err.find(said), std::string::npos) << run.err;
        EXPECT_EQ(run.out.find("near_eye"), std::string::npos);
    }
}

// Grass hides no more than the ground that it stands on.
TEST_F(TreesOfShots, AreNoGrassToTheNote) {
    json style = json::parse(bytes_of(oro::test::bundled_data() / "styles" / "natural.json"));
    // All of the ground lies above the trees, and below the snow.
    style["cover"]["forest_m"] = -4000.0;
    oro::test::write_bytes(path("meadow.json"), style.dump());
    const json meadow = object_said_by({"shot", bundled(), "--at", "36.52,-84.24", "--above", "1.7",
                                        "--pitch", "-75", "--style", path("meadow.json"), "--size", "96x64",
                                        "-q", "--json", "--out", path("meadow.png")});
    EXPECT_TRUE(meadow["growth"].contains("grass"));
    // What stands there are single trees.
    const json near_eye = meadow["growth"].value("near_eye", json::object());
    EXPECT_LT(near_eye.value("share", 0.0), 0.05) << near_eye;
    EXPECT_FALSE(near_eye.contains("note")) << near_eye;
}

TEST_F(TreesOfShots, AreRefusedWhereNoneCanBe) {
    const auto refused = [&](const Words& more, const std::string& line) {
        expect_refusal(run_orograph(joined({"shot", bundled(), "-q", "--out", path("none.png")}, more)),
                       usage, {line});
    };
    refused({"--style", "plain", "--trees", "on"},
            "--trees on: the style 'plain' knows no ground that trees could stand on");
    refused({"--trees", "perhaps"}, "--trees perhaps: choose on or off");
}

}  // namespace
