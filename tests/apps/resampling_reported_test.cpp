// A file in projected coordinates that states no CRS: what is told of it, and of what resampling costs.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

// Hills of 100 x 80 posts, 50 m apart, around one spike; an Esri ASCII grid has no CRS.
std::string hills() {
    std::string text =
        "ncols 100\nnrows 80\nxllcorner 2600000\nyllcorner 1200000\ncellsize 50\nNODATA_value -9999\n";
    for (int r = 0; r < 80; ++r) {
        for (int c = 0; c < 100; ++c) {
            const double height =
                r == 40 && c == 51 ? 1500.0 : 700.0 + 60.0 * std::sin(r / 5.0) * std::cos(c / 7.0);
            text += (r == 10 && c == 10 ? "-9999" : std::to_string(height)) + (c == 99 ? "\n" : " ");
        }
    }
    return text;
}

class ResamplingReported : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();
    const fs::path file = folder / "hills.asc";
    void SetUp() override { oro::test::write_bytes(file, hills()); }

    [[nodiscard]] Words with_crs(Words words) const {
        words.insert(words.begin() + 1, {file.string(), "--source-crs", "EPSG:2056", "--resample"});
        return words;
    }
    // As it is opened without being asked to resample.
    [[nodiscard]] Words kept(Words words) const {
        words = with_crs(std::move(words));
        std::erase(words, "--resample");
        return words;
    }
};

void expect_words(const std::string& text, const Words& words) {
    for (const std::string& word : words)
        EXPECT_NE(text.find(word), std::string::npos) << text << "\nlacks: " << word;
}

TEST_F(ResamplingReported, WithoutACrsThereIsAdvice) {
    expect_refusal(run_orograph({"info", file}), 1,
                   {"hills.asc: states no coordinate reference system",
                    "Its x run from 2600000 to 2605000, its y from 1200000 to 1204000: metres or feet",
                    "--source-crs EPSG:CODE tells it"});
}

TEST_F(ResamplingReported, InfoTellsTheFilesOwnRangeAndWhatTheRegionShows) {
    const Outcome outcome = run_orograph(with_crs({"info"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(
        outcome.out,
        {"EPSG:2056 CH1903+ / LV95 (as told)\n", "stored      640.0 to 1500.0 m: the file's own values\n",
         "at the region's posts\n", "\n  resampling  up to ", " m RMS, of 7,",
         "\n  highest     its post of 1500.0 m at 46.9", "\n  outside     ", "\n  missing     none\n"});
    const json info = object_said_by(with_crs({"info", "--json"}));
    const json& source = info.at("sources").at(0);
    EXPECT_NEAR(source.at("stored").at("highest_m").get<double>(), 1500.0, 1e-3);
    EXPECT_TRUE(source.at("stored").at("whole_file"));
    const json& found = source.at("resampling");
    EXPECT_EQ(found.at("posts"), 100 * 80 - 1);
    EXPECT_NEAR(found.at("highest").at("own_H_m").get<double>(), 1500.0, 1e-3);
    EXPECT_LT(found.at("highest").at("shown_H_m").get<double>(), 1450.0);
    EXPECT_EQ(info.at("region").at("resampling").at("files"), 1);
    EXPECT_EQ(info.at("region").at("resampling").at("rms_m"), found.at("rms_m"));
}

// Unless it is asked for nothing is resampled, and nothing is told of it.
TEST_F(ResamplingReported, WithoutBeingAskedForThereIsNone) {
    const Outcome outcome = run_orograph(kept({"info"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(outcome.out, {"\n  posts       100 x 80, the file's own, every 49.9996",
                               "\n  H           640.0 to 1500.0 m"});
    EXPECT_EQ(outcome.out.find("esampl"), std::string::npos) << outcome.out;
    const json info = object_said_by(kept({"info", "--json"}));
    EXPECT_TRUE(info.at("region").at("resampling").is_null());
    EXPECT_EQ(info.at("region").at("own_posts"), true);
    EXPECT_NEAR(info.at("region").at("H_m").at("highest").get<double>(), 1500.0, 5e-4);
    EXPECT_EQ(info.at("region").at("voids"), 1);
    const json plan = object_said_by(kept({"plan", "--json", "-q"}));
    EXPECT_FALSE(plan.contains("resampling"));
}

TEST_F(ResamplingReported, PlanHasARowForIt) {
    const Outcome outcome = run_orograph(with_crs({"plan", "--all"}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(outcome.out, {"\nresampled heights "});
    expect_words(outcome.err, {"heights of 1 file are resampled: its own posts are up to ",
                               "its highest post: 1500.0 m at"});
    const json plan = object_said_by(with_crs({"plan", "--json", "-q"}));
    const json& size = plan.at("resampling");
    EXPECT_GT(size.at("worst_m").get<double>(), 50.0);
    EXPECT_GT(size.at("worst_px").get<double>(), size.at("typical_px").get<double>());
    EXPECT_GT(size.at("typical_px").get<double>(), 0.0);
}

// In the picture, in what --verify says, and in the view from which the picture is drawn again.
TEST_F(ResamplingReported, PicturesCarryItAndAreDrawnAgain) {
    const fs::path picture = folder / "p.png";
    const Outcome outcome =
        run_orograph(with_crs({"shot", "--out", picture.string(), "--size", "64x48", "--verify", "--json"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    expect_words(outcome.err, {"\nResampled: heights of 1 file are resampled: its own posts are up to "});
    const json shot = oro::test::one_object(outcome.out);
    const json& facts = shot.at("view").at("fingerprints").at("resampling");
    EXPECT_EQ(facts.at("files"), 1);
    EXPECT_EQ(facts, shot.at("region").at("resampling"));
    EXPECT_EQ(facts, shot.at("error").at("resampling"));
    const json view = json::parse(oro::test::view_in(picture));
    EXPECT_EQ(view.at("source_crs"), "EPSG:2056");
    EXPECT_EQ(view.at("fingerprints").at("resampling"), facts);
    const Outcome again = run_orograph({"shot", "--view", picture, "--out", folder / "q.png"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(oro::test::bytes_of(picture), oro::test::bytes_of(folder / "q.png"));
    EXPECT_EQ(run_orograph({"compare", picture, "-q"}).exit_code, 0);
    expect_refusal(run_orograph({"compare", picture, "--source-crs", "EPSG:2056"}), 2, {"--source-crs"});
}

TEST_F(ResamplingReported, BakedRegionsKeepIt) {
    const fs::path baked = folder / "r.oro";
    ASSERT_EQ(run_orograph(with_crs({"bake", "--out", baked.string(), "-q"})).exit_code, 0);
    const json from_file = object_said_by(with_crs({"info", "--json"}));
    const json from_baked = object_said_by({"info", baked, "--json"});
    for (const char* field : {"resampling", "stored", "crs", "H_m"})
        EXPECT_EQ(from_baked.at("sources").at(0).at(field), from_file.at("sources").at(0).at(field)) << field;
    EXPECT_EQ(from_baked.at("region").at("resampling"), from_file.at("region").at("resampling"));
    expect_refusal(run_orograph({"info", baked, "--source-crs", "EPSG:2056"}), 2, {"--source-crs", "baked"});
}

TEST_F(ResamplingReported, WhatHeightsReferToCanBeToldAndSaysNothingWhereFilesSayIt) {
    const json at_sea = object_said_by(with_crs({"info", "--json"}));
    const json above = object_said_by(with_crs({"info", "--json", "--source-vertical", "EPSG:4979"}));
    EXPECT_NE(above.at("sources").at(0).at("vertical_datum").get<std::string>().find("ellipsoidal height"),
              std::string::npos);
    EXPECT_NE(above.at("sources").at(0).at("vertical_datum").get<std::string>().find("(as told)"),
              std::string::npos);
    // N is some 49.5 m there, with EGM96.
    EXPECT_NEAR(at_sea.at("region").at("H_m").at("lowest").get<double>() -
                    above.at("region").at("H_m").at("lowest").get<double>(),
                49.5, 1.5);
    const std::string bundled = (oro::test::bundled_data() / "jacksboro.tif").string();
    const Outcome stated = run_orograph({"info", bundled, "--source-crs", "EPSG:2056"});
    EXPECT_EQ(stated.exit_code, 0);
    expect_words(stated.out, {"--source-crs EPSG:2056 says nothing here: each file states its own"});
}

// A folder with a broken file: all is listed, and the error stays one line.
TEST_F(ResamplingReported, AFolderIsListedWhateverIsInIt) {
    oro::test::write_bytes(folder / "broken.tif", "no raster");
    oro::test::write_bytes(folder / "N46E008.hgt", std::string(2 * 1201 * 1201, '\1'));
    const Outcome outcome = run_orograph({"info", folder});
    EXPECT_EQ(outcome.exit_code, 1);
    ASSERT_EQ(outcome.err_lines().size(), 1U) << outcome.err;
    expect_words(outcome.err, {"broken.tif: cannot be opened as a raster"});
    expect_words(outcome.out,
                 {"N46E008.hgt\n", "not read", "cannot be opened: 1 file\n",
                  "broken.tif  cannot be opened as a raster", "passed over, without elevation: 1 file\n",
                  "hills.asc  states no coordinate reference system"});
    const json reported = oro::test::one_object(run_orograph({"info", folder, "--json"}).out);
    EXPECT_EQ(reported.at("sources").size(), 1U);
    EXPECT_EQ(reported.at("not_opened").size(), 1U);
    EXPECT_EQ(reported.at("passed_over").size(), 1U);
}

}  // namespace
