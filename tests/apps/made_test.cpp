// Made terrain from end to end: what users do with files they do with a made: text.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::run_orograph;

const std::string waves = "made:fbm?seed=7&H=-200:4000&spacing=3s&box=8.4,46.4,8.6,46.6";

TEST(MadeTerrain, InfoTellsThatItIsMade) {
    const auto outcome = run_orograph({"info", waves});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("made, not measured"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("241 x 241"), std::string::npos) << outcome.out;
}

TEST(MadeTerrain, ABadWordIsOneLineAndExitCode2) {
    for (const char* text : {"made:fbm?octaves=1000000000", "made:fbm?H=nan:1", "made:foo",
                             "made:fbm?box=8,46,8,47", "made:cone?radius=-5", "made:fbm?seed=1&seed=1"})
        for (const char* command : {"info", "plan"})
            expect_refusal(run_orograph({command, text}), oro::test::usage, {text});
    // More posts than there is memory for, as of files.
    for (const char* text :
         {"made:fbm?box=-180,-90,180,90&spacing=0.1s", "made:ridged?box=-180,-90,180,90&spacing=0.1s",
          "made:plane?box=-180,-90,180,90"})
        expect_refusal(run_orograph({"info", text}), oro::test::failed, {"region too large"});
    // Of a world as of a region.
    for (const char* text :
         {"made:ridged?octaves=25&box=-180,-90,180,90", "made:ridged?gain=inf&box=-180,-90,180,90",
          "made:ridged?H=9:-9&box=-180,-90,180,90", "made:ridged?feature=-1&box=-180,-90,180,90",
          "made:ridged?radius=9&box=-180,-90,180,90", "made:ridged?box=-180,-91,180,90",
          "made:ridged?seed=4294967296&box=-180,-90,180,90"})
        expect_refusal(run_orograph({"info", text}), oro::test::usage, {text});
}

// Nearly the whole Earth, a second apart: 432,001 x 1,288,801 posts, of which those are made that are asked
// for.
const std::string world = "made:fbm?seed=7&octaves=12&H=-200:4000&spacing=1s&box=-179,-60,179,60";
const std::string ridged_world = "made:ridged?seed=12&octaves=12&H=-200:4000&spacing=1s&box=-179,-60,179,60";

TEST(MadeTerrain, OfAWholeWorldIsThereWhereOneLooks) {
    const auto info = run_orograph({"info", world});
    EXPECT_EQ(info.exit_code, 0) << info.err;
    EXPECT_NE(info.out.find("1288801 x 432001"), std::string::npos) << info.out;
    // The same ground as of a small box with the same posts.
    const auto along = [](const std::string& text) {
        return object_said_by({"profile", text, "--along", "46.45,8.45;46.55,8.52", "--json"});
    };
    for (const std::string& all : {world, ridged_world}) {
        const auto whole = along(all),
                   small = along(all.substr(0, all.find("box=")) + "box=8.4,46.4,8.6,46.6");
        EXPECT_NEAR(whole["ascent_m"].get<double>(), small["ascent_m"].get<double>(), 1e-6) << whole.dump();
        EXPECT_NEAR(whole["descent_m"].get<double>(), small["descent_m"].get<double>(), 1e-6);
    }
    const fs::path folder = oro::test::scratch_folder();
    expect_refusal(run_orograph({"bake", world, "--out", folder / "w.oro"}), oro::test::usage,
                   {"bake", "--bbox"});
    EXPECT_FALSE(fs::exists(folder / "w.oro"));
}

// Pictures of it are certified as any: what is drawn is within tau of the surface that is asked at each
// pixel.
TEST(MadeTerrain, OfAWholeWorldIsDrawnWithinItsCertificate) {
    const fs::path folder = oro::test::scratch_folder();
    for (const auto& [of, at, heading, name] :
         {std::array{world.c_str(), "46.5,8.3", "80", "inside.png"},
          std::array{world.c_str(), "0.01,178.999", "280", "edge.png"},
          std::array{ridged_world.c_str(), "46.5,8.3", "80", "ridged.png"}}) {
        const auto shot =
            object_said_by({"shot", of, "--at", at, "--above", "1500", "--heading", heading, "--pitch", "-25",
                            "--size", "120x80", "--verify", "--out", folder / name, "--json"});
        const auto& error = shot["error"];
        EXPECT_LE(error["largest_px"].get<double>(), 1.0 + error["slack_px"].get<double>()) << error.dump();
        EXPECT_GT(error["largest_px"].get<double>(), 0.0);
        EXPECT_EQ(shot["settled"], true);
    }
    expect_refusal(run_orograph({"shot", world, "--at", "46.5,8.3", "--above", "1500", "--detail", "2",
                                 "--out", folder / "d.png"}),
                   oro::test::usage, {"--detail", "--bbox"});
    expect_refusal(run_orograph({"shot", world, "--at", "46.5,8.3", "--above", "1500", "--exaggeration", "2",
                                 "-q", "--out", folder / "e.png"}),
                   oro::test::usage, {"--exaggeration", "--bbox"});
}

// The usual style has shadows and light of the sky. From high up they would ask for more ground than anybody
// waits for, so there they are for who asks for them, and a note says so.
TEST(MadeTerrain, OfAWholeWorldHasTheLightOfItsStyleFromNearTheGround) {
    const fs::path folder = oro::test::scratch_folder();
    const auto pixels = [&](const std::string& above, const std::vector<std::string>& light,
                            const std::string& name) {
        std::vector<std::string> words{"shot",    world,     "--at",   "46.5,8.3",   "--above", above,
                                       "--pitch", "-30",     "--size", "60x40",      "--sun",   "200,30",
                                       "--style", "natural", "--out",  folder / name};
        words.insert(words.end(), light.begin(), light.end());
        const auto outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("--shadows on and --sky-openness on"), std::string::npos) << outcome.err;
        return oro::test::pixels_of(folder / name).rgb;
    };
    const std::vector<std::string> none{"--shadows", "off", "--sky-openness", "off"};
    const auto lit = pixels("1500", {}, "lit.png");
    EXPECT_EQ(lit, pixels("1500", {"--shadows", "on", "--sky-openness", "on"}, "asked.png"));
    EXPECT_NE(lit, pixels("1500", none, "none.png"));
    EXPECT_EQ(pixels("20000", {}, "high.png"), pixels("20000", none, "high_none.png"));
}

// 1,000 m over 10,000 m to the east, from the middle: 767.6 m over the 7,676 m of the line, by hand.
TEST(MadeTerrain, APlaneRisesAsItsWordsSay) {
    const auto profile =
        object_said_by({"profile", "made:plane?H=0:1000&azimuth=90&length=10000&box=8.4,46.4,8.6,46.6",
                        "--along", "46.5,8.45;46.5,8.55", "--json"});
    EXPECT_NEAR(profile["ascent_m"].get<double>(), 767.6, 0.1) << profile.dump();
    EXPECT_NEAR(profile["descent_m"].get<double>(), 0.0, 1e-9);
}

TEST(MadeTerrain, IsDrawnAgainFromItsPictureAndBakedWhole) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string picture = folder / "p.png", baked = folder / "b.oro";
    const auto drawn = run_orograph({"shot", waves, "--size", "160x120", "--out", picture});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const auto again = run_orograph({"shot", "--view", picture});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(again.err.find("draws the same bytes"), std::string::npos) << again.err;
    const auto bake = run_orograph({"bake", waves, "--out", baked});
    ASSERT_EQ(bake.exit_code, 0) << bake.err;
    const auto from_file = object_said_by({"info", baked, "--json"}),
               made = object_said_by({"info", waves, "--json"});
    ASSERT_EQ(made["sources"].size(), 1U) << made.dump();
    EXPECT_EQ(from_file["sources"][0]["H_m"], made["sources"][0]["H_m"]);
    EXPECT_EQ(made["sources"][0]["path"], waves);
}

// The cap of a sphere of 20 km hides what is beyond its horizon: from 10 m over its top the straight way to
// the horizon is sqrt(2 * 20000 * 10 + 100) = 632.5 m, and 0.063 % of the Earth's curvature is beside that.
TEST(MadeTerrain, FromTheTopOfASphereTheHorizonIsThatOfGeometry) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string sphere = "made:sphere?radius=20000&H=-100:1500&spacing=0.5s&box=8.48,46.48,8.52,46.52";
    const auto seen = object_said_by({"viewshed", sphere, "--at", "46.5,8.5", "--above", "10", "--radius",
                                      "1", "--refraction", "0", "--out", folder / "s.tif", "--json"});
    // Seen: a disc. The Earth's own curvature adds to the sphere's: 1 / (1 / 20000 + 1 / 6.378e6).
    const double bent_m = 1.0 / (1.0 / 20000.0 + 1.0 / 6.378e6), reach_m = std::sqrt(2.0 * bent_m * 10.0);
    EXPECT_NEAR(seen["seen_share"].get<double>(), reach_m * reach_m / 1e6, 0.02) << seen.dump();
}

}  // namespace
