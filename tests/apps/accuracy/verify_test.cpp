// shot --verify and compare: the error of a picture, as a table, as JSON and as a picture.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

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
using oro::test::names_in;
using oro::test::one_object;
using oro::test::Outcome;
using oro::test::Pixels;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::Words;

class Verify : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path picture = folder / "p.png";
    const fs::path error_picture = folder / "p.error.png";

    Outcome shoot(Words more) const {
        Words words{"shot",      bundled(), "--out",   picture, "--at",   "36.6,-84.2", "--above", "300",
                    "--heading", "200",     "--pitch", "-5",    "--size", "400x200",    "--verify"};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
};

// What must hold of every verification: fields, order, and the bound that tau promises.
void expect_errors(const json& error, double tau_px) {
    for (const char* part :
         {"displacement_m", "displacement_px", "surface_m", "surface_px", "seen_px", "skyline_px"}) {
        SCOPED_TRACE(part);
        const json& of = error.at(part);
        EXPECT_GE(of.at("max").get<double>(), of.at("p9999").get<double>());
        EXPECT_GE(of.at("p9999").get<double>(), of.at("p99").get<double>());
        EXPECT_GE(of.at("max").get<double>(), of.at("mean").get<double>());
        EXPECT_GE(of.at("mean").get<double>(), 0.0);
    }
    // An edge is found to 1/64 px.
    for (const char* part : {"displacement_px", "surface_px", "seen_px", "skyline_px"})
        EXPECT_LE(error.at(part).at("max").get<double>(), tau_px + 0.05 + 1.0 / 64.0) << part;
    EXPECT_GT(error.at("displacement_px").at("max").get<double>(), 0.0)
        << "nothing is drawn without any error";
    EXPECT_LE(error.at("surface_px").at("max"), error.at("displacement_px").at("max"));
    EXPECT_LE(error.at("surface_m").at("max"), error.at("displacement_m").at("max"));
    EXPECT_GT(error.at("drawn_pixels").get<int>(), 20000);
    EXPECT_EQ(error.at("pixels_beyond_data").get<int>(), 0);
    EXPECT_GT(error.at("skyline_columns").get<int>(), 300);
    EXPECT_TRUE(error.at("skyline_in_one_only").is_number_integer());
}

TEST_F(Verify, SaysHowFarOffThePictureIs) {
    const Outcome outcome = shoot({"--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const json said = one_object(outcome.out);
    expect_errors(said.at("error"), 1.0);
    EXPECT_EQ(said.at("error_picture"), error_picture.string());
    for (const char* words :
         {"largest", "99.99 %", "displacement, m", "displacement, px", "surface, m", "surface, px",
          "seen, px", "skyline, px", "p.error.png", "Displacement: ", "Surface: ", "Seen: ", "Skyline: ",
          "99 %: 99 of 100 are off by no more than this.\n",
          "\nAllowed: 1.05 px (--tau 1, and 0.05 px that drawing rounds off)\n"})
        EXPECT_NE(outcome.err.find(words), std::string::npos) << words << " in " << outcome.err;
    EXPECT_EQ(outcome.err.find("interior"), std::string::npos) << "a word that nothing explains";
    EXPECT_EQ(names_in(folder), (Words{"p.error.png", "p.png"}));
}

TEST_F(Verify, TheErrorPictureHasALegend) {
    ASSERT_EQ(shoot({"-q", "--tau", "8"}).exit_code, 0);
    const Pixels pixels = pixels_of(error_picture);
    // Two beside two pictures of 400 x 200, 2 px between them; below a legend of 2 * 6 + 18 + 10 * 11 = 140.
    ASSERT_EQ(pixels.width, 802U);
    ASSERT_EQ(pixels.height, 542U);
    const auto colours = [&](std::size_t from_row, std::size_t to_row, std::size_t from, std::size_t to) {
        std::set<std::vector<png_byte>> found;
        for (std::size_t row = from_row; row < to_row; ++row) {
            for (std::size_t i = 3 * (802 * row + from); i < 3 * (802 * row + to); i += 3)
                found.insert({pixels.rgb[i], pixels.rgb[i + 1], pixels.rgb[i + 2]});
        }
        return found;
    };
    const auto legend = colours(402, 542, 0, 802);
    const auto displacement = colours(0, 200, 0, 400), surface = colours(0, 200, 402, 802),
               seen = colours(202, 402, 0, 400), skyline = colours(202, 402, 402, 802);
    for (const auto& drawn : {displacement, surface, seen, skyline}) {
        EXPECT_TRUE(drawn.contains({190, 190, 190})) << "sky is grey";
        EXPECT_FALSE(drawn.contains({255, 0, 255})) << "all of it could be measured";
        EXPECT_GT(drawn.size(), 50U) << "errors of many sizes";
    }
    EXPECT_NE(displacement, surface);
    EXPECT_NE(displacement, seen);
    EXPECT_TRUE(legend.contains({20, 20, 20})) << "letters";
    EXPECT_TRUE(legend.contains({68, 1, 84}) && legend.contains({253, 231, 37})) << "both ends of the scale";
}

// What was asked for stays: the table, or the same as JSON.
TEST_F(Verify, QuietLeavesWhatWasAskedFor) {
    const Outcome loud = shoot({}), quiet = shoot({"-q", "--overwrite"});
    ASSERT_EQ(loud.exit_code, 0) << loud.err;
    EXPECT_EQ(quiet.exit_code, 0);
    EXPECT_EQ(quiet.out, "");
    EXPECT_EQ(quiet.err.rfind("Displacement: ", 0), 0U) << quiet.err;
    EXPECT_NE(loud.err.find(quiet.err), std::string::npos) << loud.err;
    EXPECT_GT(pixels_of(error_picture).width, 0U);
    const Outcome compared = run_orograph({"compare", picture, "-q", "--out", folder / "again.png"});
    EXPECT_EQ(compared.exit_code, 0);
    EXPECT_EQ(compared.out, "");
    EXPECT_EQ(compared.err, quiet.err);
    EXPECT_EQ(shoot({"-q", "--overwrite", "--json"}).err, "") << "it is all in the JSON";
    const Outcome as_json = run_orograph({"compare", picture, "-q", "--json"});
    EXPECT_EQ(as_json.err, "");
    EXPECT_TRUE(one_object(as_json.out).contains("error"));
}

TEST_F(Verify, ReplacesOnlyWhenTold) {
    oro::test::write_bytes(error_picture, "mine");
    expect_refusal(shoot({"-q"}), 1, {"p.error.png", "--overwrite"});
    EXPECT_EQ(bytes_of(error_picture), "mine");
    EXPECT_EQ(names_in(folder), Words{"p.error.png"}) << "refused before anything was drawn";
    ASSERT_EQ(shoot({"-q", "--overwrite"}).exit_code, 0);
    EXPECT_EQ(pixels_of(error_picture).width, 802U);
}

// The picture is the same with and without, and a check writes the picture of errors only.
TEST_F(Verify, DoesNotChangeThePicture) {
    ASSERT_EQ(shoot({"-q", "--pipeline", "compute"}).exit_code, 0);
    const std::string bytes = bytes_of(picture), errors = bytes_of(error_picture);
    fs::remove(error_picture);
    const Outcome again = run_orograph({"shot", "--view", picture, "--verify", "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(bytes_of(picture) == bytes);
    EXPECT_TRUE(bytes_of(error_picture) == errors);
}

TEST_F(Verify, CompareTellsTheSameOfAWrittenPicture) {
    const Outcome shot = shoot({"--json", "-q"});
    ASSERT_EQ(shot.exit_code, 0) << shot.err;
    const json error = one_object(shot.out).at("error");
    const std::string bytes = bytes_of(picture);
    oro::test::write_bytes(folder / "v.json", oro::test::view_in(picture));
    for (const fs::path& from : {picture, folder / "v.json"}) {
        const fs::path out = folder / "again.png";
        const Outcome outcome = run_orograph({"compare", from, "--out", out, "--json", "--overwrite"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
        const json said = one_object(outcome.out);
        EXPECT_EQ(said.at("error"), error);
        EXPECT_EQ(said.at("error_picture"), out.string());
        EXPECT_NE(outcome.err.find("displacement, px"), std::string::npos) << outcome.err;
        EXPECT_TRUE(bytes_of(out) == bytes_of(error_picture));
    }
    EXPECT_TRUE(bytes_of(picture) == bytes);
    const Outcome table = run_orograph({"compare", picture, bundled()});
    EXPECT_EQ(table.exit_code, 0) << "the data named again";
    EXPECT_EQ(table.out, "");
    EXPECT_EQ(names_in(folder), (Words{"again.png", "p.error.png", "p.png", "v.json"}));
}

TEST_F(Verify, CompareRefusesWhatItMustNotWrite) {
    ASSERT_EQ(shoot({"-q"}).exit_code, 0);
    const std::string bytes = bytes_of(picture);
    expect_refusal(run_orograph({"compare", picture, "--out", picture, "--overwrite", "-q"}), 2,
                   {"would replace", "p.png"});
    EXPECT_TRUE(bytes_of(picture) == bytes);
    expect_refusal(run_orograph({"compare", picture, "--out", error_picture, "-q"}), 1, {"p.error.png"});
    expect_refusal(run_orograph({"compare", picture, "--out", folder / "e.jpg", "-q"}), 2, {"e.jpg", ".png"});
    expect_refusal(run_orograph({"compare", bundled(), "-q"}), 1, {"jacksboro.tif"});
}

// A view whose models leave something out is still measured against all of it.
TEST_F(Verify, WhatAModelLeavesOutIsMeasured) {
    const auto worst_px = [&](Words more) {
        more.insert(more.end(), {"--json", "-q", "--overwrite"});
        const Outcome outcome = shoot(more);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return one_object(outcome.out).at("error").at("largest_px").get<double>();
    };
    EXPECT_LE(worst_px({"--refraction", "0.13"}), 1.05);
    // N falls by less than 1 m over this view: near 0.1 px at most, but no longer nothing. The Earth as a
    // plane is off by 8 m at 10 km and 70 m at 30 km: many pixels.
    EXPECT_LE(worst_px({"--geoid", "none"}), 2.0);
    EXPECT_GT(worst_px({"--earth", "flat"}), 0.5);
}

TEST_F(Verify, BakedRegionsAreMeasured) {
    const fs::path region = folder / "r.oro";
    ASSERT_EQ(run_orograph({"bake", bundled(), "--out", region, "-q"}).exit_code, 0);
    const Outcome from_tiles = shoot({"--json", "-q"});
    ASSERT_EQ(from_tiles.exit_code, 0) << from_tiles.err;
    const Outcome outcome =
        run_orograph({"shot", region, "--out", folder / "b.png", "--at", "36.6,-84.2", "--above", "300",
                      "--heading", "200", "--pitch", "-5", "--size", "400x200", "--verify", "--json", "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(one_object(outcome.out).at("error"), one_object(from_tiles.out).at("error"));
}

}  // namespace
