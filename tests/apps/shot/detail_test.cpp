// --detail as users meet it: what is told of invented ground, that it is drawn as it is, and what is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::no_data;
using oro::test::object_said_by;
using oro::test::one_object;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::says;
using oro::test::usage;
using oro::test::Words;

class ShotDetail : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    [[nodiscard]] std::string path(const std::string& name) const { return (folder / name).string(); }
    [[nodiscard]] Words shot(const Words& more, const std::string& out) const {
        Words words{"shot",      oro::test::bundled(),
                    "--at",      "36.5,-84.25",
                    "--above",   "20",
                    "--heading", "320",
                    "--pitch",   "-8",
                    "--size",    "320x160",
                    "--sun",     "300,30",
                    "--time",    "2026-01-02T03:04:05Z",
                    "--out",     path(out),
                    "--quiet"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
};

TEST_F(ShotDetail, IsDrawnAsItIsAndToldInMetres) {
    const auto said = object_said_by(shot({"--detail", "2,3", "--verify", "--json"}, "p.png"));
    const auto& detail = said["detail"];
    EXPECT_EQ(detail["invented"], true);
    EXPECT_EQ(detail["halvings"], 2);
    EXPECT_EQ(detail["radius_km"], 3.0);
    EXPECT_EQ(detail["none_on"], "rule");
    EXPECT_GT(detail["rms_m"], 0.3);
    EXPECT_LT(detail["rms_m"], 20.0);
    EXPECT_GT(detail["largest_m"], detail["rms_m"]);
    EXPECT_EQ(said["view"]["detail"]["halvings"], 2);
    EXPECT_NEAR(said["view"]["detail"]["lat_deg"], 36.5, 1.0e-9);
    EXPECT_EQ(said["sources"].size(), 1U);
    EXPECT_FALSE(said.contains("apart"));
    // Held against the surface with it, and told how far that is from the data's.
    const auto& error = said["error"];
    EXPECT_LE(error["largest_px"].get<double>(), 1.0 + error["slack_px"].get<double>());
    EXPECT_GT(error["invented"]["pixels"], 20000);
    EXPECT_GT(error["invented"]["rms_m"], 0.1);
    EXPECT_LE(error["invented"]["max_m"].get<double>(), detail["largest_m"].get<double>() + 0.01);
}

// The ground that lies over the data there was invented: no finer file was given.
TEST_F(ShotDetail, IsNotCalledFinerGround) {
    Words words = shot({"--detail", "2,3", "--trees", "off"}, "p.png");
    std::erase(words, "--quiet");
    const Outcome drawn = run_orograph(words);
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_NE(drawn.err.find("within two posts of invented ground (--detail), is split along"),
              std::string::npos)
        << drawn.err;
    EXPECT_EQ(drawn.err.find("finer"), std::string::npos) << drawn.err;
}

TEST_F(ShotDetail, OfAPictureIsDrawnAgain) {
    ASSERT_EQ(run_orograph(shot({"--detail", "3,1", "--legend"}, "p.png")).exit_code, 0);
    const Outcome again =
        run_orograph({"shot", "--view", path("p.png"), "--out", path("again.png"), "--quiet"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(bytes_of(path("p.png")) == bytes_of(path("again.png")));
    const Outcome compared = run_orograph({"compare", path("p.png")});
    EXPECT_EQ(compared.exit_code, 0) << compared.err;
    EXPECT_TRUE(says(compared.err, "Invented between posts: ")) << compared.err;
}

// What is off changes nothing, and takes a recorded one away.
TEST_F(ShotDetail, OfNoHalvingsIsNone) {
    ASSERT_EQ(run_orograph(shot({}, "none.png")).exit_code, 0);
    ASSERT_EQ(run_orograph(shot({"--detail", "0"}, "zero.png")).exit_code, 0);
    EXPECT_TRUE(bytes_of(path("none.png")) == bytes_of(path("zero.png")));
    ASSERT_EQ(run_orograph(shot({"--detail", "2,1"}, "two.png")).exit_code, 0);
    EXPECT_FALSE(bytes_of(path("none.png")) == bytes_of(path("two.png")));
    // The eye stays where it was recorded, on the invented ground.
    const auto said = object_said_by(
        {"shot", "--view", path("two.png"), "--detail", "0", "--out", path("off.png"), "--json", "--quiet"});
    EXPECT_FALSE(said.contains("detail"));
    EXPECT_FALSE(said["view"].contains("detail"));
}

TEST_F(ShotDetail, HasARowInThePlan) {
    const Words plan{
        "plan",   oro::test::bundled(), "--at", "36.5,-84.25", "--above", "20", "--pitch", "-8", "--size",
        "160x120"};
    const Outcome with = run_orograph(oro::test::joined(plan, {"--all", "--detail", "2,1"}));
    ASSERT_EQ(with.exit_code, 0) << with.err;
    EXPECT_TRUE(says(with.out, "invented ground")) << with.out;
    EXPECT_TRUE(says(with.out, "--detail 0")) << with.out;
    EXPECT_FALSE(says(run_orograph(oro::test::joined(plan, {"--all"})).out, "invented ground"));
    const auto predicted = object_said_by(oro::test::joined(plan, {"--detail", "2,1", "--json"}));
    EXPECT_GT(predicted["invented"]["worst_px"], 0.1);
}

TEST_F(ShotDetail, OfTooMuchIsRefusedInOneLine) {
    expect_refusal(run_orograph(shot({"--detail", "7"}, "p.png")), usage, {"--detail 7", "0 to 6"});
    expect_refusal(run_orograph(shot({"--detail", "few"}, "p.png")), usage, {"--detail few"});
    expect_refusal(run_orograph(shot({"--detail", "2,0"}, "p.png")), usage, {"--detail 2,0", "km"});
    expect_refusal(run_orograph(shot({"--detail", "3,"}, "p.png")), usage,
                   {"--detail 3,: the radius in km must be between 0.05 and 500"});
    expect_refusal(run_orograph(shot({"--detail", "2,nan"}, "p.png")), usage, {"--detail 2,nan"});
    expect_refusal(run_orograph(shot({"--detail", "6,20"}, "p.png")), usage,
                   {"--detail", "million posts", "would fit"});
    expect_refusal(run_orograph({"trade", oro::test::bundled(), "--detail", "2", "--quiet"}), usage,
                   {"--detail", "leave it out"});
    expect_refusal(run_orograph({"export", oro::test::bundled(), "--to", "gltf", "--out", path("a.glb"),
                                 "--detail", "2"}),
                   usage, {"--detail 2: needs --to cog"});
    expect_refusal(run_orograph({"shot", oro::test::bundled(), "--ortho", "--out", path("map.png"),
                                 "--detail", "2", "--quiet"}),
                   usage, {"--detail", "not together with --ortho"});
}

// A panorama has it, too, and tells of it.
TEST_F(ShotDetail, IsInPanoramas) {
    const Words words{
        "panorama", oro::test::bundled(), "--at", "36.5,-84.25", "--above", "20", "--width", "400", "--quiet",
        "--json"};
    const auto without = object_said_by(joined(words, {"--out", path("without.png")}));
    const auto with = object_said_by(joined(words, {"--detail", "2,1", "--out", path("with.png")}));
    EXPECT_FALSE(without.contains("detail"));
    EXPECT_EQ(with["detail"]["invented"], true);
    EXPECT_EQ(with["detail"]["radius_km"], 1.0);
    EXPECT_NE(with["view"]["fingerprints"]["pixels"], without["view"]["fingerprints"]["pixels"]);
}

// A denser GeoTIFF: its posts are those of the data where the data have any, as GDAL reads both.
TEST_F(ShotDetail, GoesIntoAGeoTiff) {
    const Outcome wrote = run_orograph({"export", oro::test::bundled(), "--to", "cog", "--out",
                                        path("dense.tif"), "--detail", "1", "--json"});
    ASSERT_EQ(wrote.exit_code, 0) << wrote.err;
    const auto said = one_object(wrote.out);
    EXPECT_EQ(said["detail"]["halvings"], 1);
    const auto info = one_object(run_program({"gdalinfo", "-json", path("dense.tif")}).out);
    EXPECT_TRUE(says(info["metadata"][""]["INVENTED"], "Ground between posts: invented"));
    const auto before = one_object(run_program({"gdalinfo", "-json", oro::test::bundled()}).out);
    EXPECT_EQ(info["size"][0], 2 * before["size"][0].get<int>() - 1);
    EXPECT_EQ(info["size"][1], 2 * before["size"][1].get<int>() - 1);
    for (const auto& [x, y] : {std::pair{7, 11}, {120, 60}, {200, 133}}) {
        const auto read = [&](const std::string& file, int times) {
            return run_program({"gdallocationinfo", "-valonly", file, std::to_string(times * x),
                                std::to_string(times * y)})
                .out;
        };
        EXPECT_EQ(std::stod(read(path("dense.tif"), 2)), std::stod(read(oro::test::bundled(), 1)));
    }
}

}  // namespace
