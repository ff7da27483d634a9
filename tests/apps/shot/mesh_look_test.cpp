// How meshes look, and terrain that is cut out under them, as users see it.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

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
using oro::test::says;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;

// A pit 89 m by 222 m whose floor is at 300 m above sea level; the ground around it is at about 350 m.
const std::string pit_obj =
    "v -84.1765 36.604 300\nv -84.1755 36.604 300\nv -84.1755 36.606 300\nv -84.1765 36.606 300\n"
    "f 1 2 3\nf 1 3 4\n";
// A roof over the same place, at 420 m.
const std::string roof_obj =
    "v -84.1765 36.604 420\nv -84.1755 36.604 420\nv -84.1755 36.606 420\nv -84.1765 36.606 420\n"
    "f 1 2 3\nf 1 3 4\n";

class MeshLook : public ::testing::Test {
  protected:
    void SetUp() override {
        oro::test::write_bytes(pit_, pit_obj);
        oro::test::write_bytes(roof_, roof_obj);
    }
    // From 300 m above the ground, straight down.
    json shot(const Words& more) const {
        const Outcome drawn =
            run_orograph(joined({"shot", bundled(), "--at", "36.605,-84.176", "--altitude", "650", "--pitch",
                                 "-90", "--size", "64x48", "--out", picture_, "--overwrite", "-q", "--json"},
                                more));
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return drawn.exit_code == 0 ? json::parse(drawn.out) : json::object();
    }
    // The middle of the last picture: red, green and blue.
    [[nodiscard]] std::array<int, 3> middle() const {
        const Pixels pixels = pixels_of(picture_);
        const std::size_t at = 3 * (24 * 64 + 32);
        return {pixels.rgb[at], pixels.rgb[at + 1], pixels.rgb[at + 2]};
    }

    const fs::path folder_ = oro::test::scratch_folder();
    const std::string pit_ = (folder_ / "pit.obj").string(), roof_ = (folder_ / "roof.obj").string(),
                      picture_ = (folder_ / "look.png").string();
};

// A level roof: grey where nobody knows what the file is of, gravel where it is built, green as ground.
TEST_F(MeshLook, IsByTheFileOrAsAsked) {
    const Words on{"--style", "natural", "--mesh-file", roof_, "--mesh-crs", "EPSG:4326"};
    static_cast<void>(shot(on));
    const std::array<int, 3> plain = middle();
    EXPECT_LT(std::abs(plain[0] - plain[1]), 16) << "grey";
    EXPECT_FALSE(json::parse(view_in(picture_))["meshes"].contains("look"));
    static_cast<void>(shot(joined(on, {"--mesh-look", "built"})));
    const std::array<int, 3> built = middle();
    EXPECT_LT(built[0], plain[0]) << "gravel is darker";
    EXPECT_EQ(json::parse(view_in(picture_))["meshes"]["look"], "built");
    static_cast<void>(shot(joined(on, {"--mesh-look", "ground"})));
    const std::array<int, 3> ground = middle();
    EXPECT_GT(ground[1], ground[2] + 10) << "green";
    expect_refusal(
        run_orograph({"shot", bundled(), "--mesh-look", "built", "-q", "--out", picture_, "--overwrite"}),
        usage, {"--mesh-look", "without --mesh-file"});
    expect_refusal(
        run_orograph(joined({"shot", bundled(), "-q", "--out", picture_, "--mesh-look", "wood"}, on)), usage,
        {"--mesh-look", "wood"});
}

// Without the cut the terrain hides the pit; with it the floor is seen, and the picture draws itself again.
TEST_F(MeshLook, APitIsSeenWhereTheTerrainIsCut) {
    const Words on{"--mesh-file", pit_, "--mesh-crs", "EPSG:4326", "--mesh-look", "ground"};
    EXPECT_FALSE(says(shot(on)["destination"].dump(), "pit.obj"));
    const json said = shot(joined(on, {"--cut-under", "--verify"}));
    EXPECT_TRUE(says(said["destination"].dump(), "pit.obj")) << said["destination"].dump();
    // Walls along the rim reach out by a pixel (SeamSkirt): a few pixels there show what is beside it, and
    // the walls themselves are as far from the true ones.
    EXPECT_LT(said["error"]["seen_px"]["mean"].get<double>(), 0.05) << said["error"].dump();
    EXPECT_LT(said["error"]["surface_px"]["mean"].get<double>(), 0.05) << said["error"].dump();
    EXPECT_LT(said["error"]["surface_px"]["max"].get<double>(), 1.05) << said["error"].dump();
    const json view = json::parse(view_in(picture_));
    EXPECT_EQ(view["meshes"]["cut_under"], true);
    const std::string again = (folder_ / "again.png").string();
    const Outcome redrawn = run_orograph({"shot", "--view", picture_, "--out", again, "--overwrite", "-q"});
    ASSERT_EQ(redrawn.exit_code, 0) << redrawn.err;
    EXPECT_EQ(json::parse(view_in(again))["fingerprints"]["pixels"], view["fingerprints"]["pixels"]);
}

// The floor is what there is to stand on, and to look at.
TEST_F(MeshLook, APitIsStoodInAndLookedAt) {
    const auto seen = [&](const Words& eye) {
        const Outcome drawn = run_orograph(joined(
            {"shot", bundled(), "--mesh-file", pit_, "--mesh-crs", "EPSG:4326", "--mesh-look", "ground",
             "--cut-under", "--size", "64x48", "--out", picture_, "--overwrite", "-q", "--json"},
            eye));
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
        return drawn.exit_code == 0 ? json::parse(drawn.out) : json::object();
    };
    const json over = seen({"--at", "36.6045,-84.1785", "--above", "300", "--look-at", "36.605,-84.176"});
    EXPECT_TRUE(says(over["destination"].dump(), "pit.obj")) << over["destination"].dump();
    EXPECT_NEAR(over["destination"]["H_m"].get<double>(), 300.0, 0.01);
    const json in = seen({"--at", "36.605,-84.176", "--above", "2", "--heading", "0"});
    EXPECT_NEAR(in["eye"]["H_m"].get<double>(), 302.0, 0.01);
}

// A line across the pit, and one that stays in it: the floor is drawn where there is no terrain.
TEST_F(MeshLook, ProfilesGoThroughThePit) {
    const fs::path out = folder_ / "pit.svg";
    const auto profile = [&](const char* line) {
        return run_orograph({"profile", bundled(), "--mesh-file", pit_, "--mesh-crs", "EPSG:4326",
                             "--mesh-look", "ground", "--cut-under", "--along", line, "--out", out.string(),
                             "--overwrite", "-q"});
    };
    const Outcome across = profile("36.605,-84.178; 36.605,-84.174");
    ASSERT_EQ(across.exit_code, 0) << across.err;
    EXPECT_TRUE(says(across.out, "Over meshes: 149.1 m of the line")) << across.out;
    EXPECT_TRUE(says(across.out, "Without terrain: 0.149 km, left out of all sums")) << across.out;
    EXPECT_TRUE(says(oro::test::bytes_of(out), "class=\"top\" d=\"M"));
    EXPECT_FALSE(says(oro::test::bytes_of(out), "class=\"void\""));
    const Outcome within = profile("36.6045,-84.176; 36.6055,-84.176");
    ASSERT_EQ(within.exit_code, 0) << within.err;
    EXPECT_TRUE(says(within.out, "Over meshes: 111.0 m of the line; highest top H 300.00 m")) << within.out;
    EXPECT_TRUE(says(oro::test::bytes_of(out), "class=\"top\" d=\"M"));
    EXPECT_EQ(profile("36.5,-84.9; 36.51,-84.9").exit_code, oro::test::no_data);
}

// Out of the pit, whose floor is under the terrain: from 2 m over the floor past its rim, which is 44.7 m
// away and some 50 m higher, to places 233 m away. What the first of them lacks, 31.8 m, the second one has.
TEST_F(MeshLook, SightGoesOutOfThePit) {
    const auto line = [&](const char* target_m) {
        return Words{"sight",       bundled(), "--from",          "36.605,-84.176", "--altitude",
                     "302",         "--to",    "36.605,-84.1734", "--target",       target_m,
                     "--mesh-file", pit_,      "--mesh-crs",      "EPSG:4326",      "--mesh-look",
                     "ground",      "-q",      "--json"};
    };
    expect_refusal(run_orograph(line("203")), usage, {"47.0 m under the ground"});
    const Outcome hidden = run_orograph(joined(line("170"), {"--cut-under"}));
    ASSERT_EQ(hidden.exit_code, 0) << hidden.err;
    const json found = json::parse(hidden.out);
    EXPECT_EQ(found["visible"], false);
    EXPECT_EQ(found["obstacle"]["mesh"], pit_) << "the wall at its rim";
    EXPECT_NEAR(found["obstacle"]["distance_m"].get<double>(), 44.7, 0.1);
    EXPECT_NEAR(found["target_missed_by_m"].get<double>(), 31.85, 0.1);
    const Outcome seen = run_orograph(joined(line("203"), {"--cut-under"}));
    ASSERT_EQ(seen.exit_code, 0) << seen.err;
    EXPECT_EQ(json::parse(seen.out)["visible"], true) << seen.out;
}

TEST_F(MeshLook, CutsAreRefusedInOneLine) {
    const Words shot{"shot", bundled(), "--at", "36.605,-84.176", "-q", "--out", picture_, "--overwrite"};
    expect_refusal(run_orograph(joined(shot, {"--cut-under"})), usage,
                   {"--cut-under", "without --mesh-file"});
    expect_refusal(
        run_orograph(joined(shot, {"--cut-under", "--mesh-file", pit_, "--mesh-crs", "EPSG:4326"})), usage,
        {"--cut-under", "needs a mesh that is ground"});
}

}  // namespace
