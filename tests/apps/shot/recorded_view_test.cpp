// What a picture tells of its view: it opens again, wherever picture and data have gone together, and tells
// no more of its maker than that needs.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::view_in;
using oro::test::Words;
using oro::test::write_bytes;

// A folder with data and pictures in folders of their own.
class RecordedView : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder(), data = folder / "data",
                   pictures = folder / "pictures";

    RecordedView() {
        fs::create_directory(data);
        fs::create_directory(pictures);
        fs::copy_file(bundled(), data / "land.tif");
    }
    Outcome shoot(const Words& more, const fs::path& from = {}) const {
        Words words{"shot", "--size", "64x48", "-q"};
        words.insert(words.end(), more.begin(), more.end());
        Circumstances circumstances;
        circumstances.folder = from;
        return run_orograph(words, circumstances);
    }
};

// Found: pictures whose own view could not be opened again.
TEST_F(RecordedView, WhatCannotBeOpenedAgainIsNotWritten) {
    const std::vector<Words> far{{"--at", "geo:36.5,-84.3,3000000000"},
                                 {"--at", "geo:36.5,-84.3,-8000000"},
                                 {"--sun", "1e308,90"},
                                 {"--sun", "-1e10,0"}};
    for (const Words& words : far) {
        Words all{data / "land.tif", "--out", pictures / "p.png"};
        all.insert(all.end(), words.begin(), words.end());
        expect_refusal(shoot(all), usage, {words[0], words[1]});
    }
    for (const char* epoch : {"253402300800", "-62167219201", "soon", "1e9"}) {
        Circumstances then;
        then.environment = {std::string("SOURCE_DATE_EPOCH=") + epoch};
        expect_refusal(run_orograph({"shot", data / "land.tif", "--out", pictures / "p.png"}, then), usage,
                       {"SOURCE_DATE_EPOCH", epoch});
    }
    EXPECT_EQ(names_in(pictures), Words{});
}

// The least and the most of each option: written, and opened again to the same bytes.
TEST_F(RecordedView, LimitsAreTheSameOnBothSides) {
    const std::vector<Words> edges{{"--at", "geo:36.5,-84.3,2000000000"},
                                   {"--at", "geo:90,180,-7000000", "--look-at", "36.6,-84.2"},
                                   {"--at", "36.5,-84.3", "--altitude", "1e9", "--heading", "-360"},
                                   {"--at", "36.5,-84.3", "--altitude", "-12000", "--heading", "360"},
                                   {"--sun", "1e9,90", "--samples", "64"},
                                   {"--sun", "-1e9,-90", "--tau", "1000", "--refraction", "-1"},
                                   {"--exaggeration", "100", "--refraction", "0.9", "--tau", "0"},
                                   {"--exaggeration", "0.01", "--at", "36.5,-84.3", "--fov", "0.05"},
                                   {"--fov", "120", "--at", "36.5,-84.3", "--pitch", "-90", "--roll", "-180"},
                                   {"--pitch", "90", "--roll", "180", "--at", "36.5,-84.3", "--above", "1e9"},
                                   {"--time", "1000-01-01T00:00:00Z"},
                                   {"--time", "9999-12-31T23:59:59Z"}};
    for (std::size_t i = 0; i < edges.size(); ++i) {
        SCOPED_TRACE(edges[i][0] + " " + edges[i][1]);
        const fs::path picture = pictures / (std::to_string(i) + ".png");
        Words all{data / "land.tif", "--out", picture};
        all.insert(all.end(), edges[i].begin(), edges[i].end());
        const Outcome drawn = shoot(all);
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        const Outcome again = run_orograph({"shot", "--view", picture, "-q"});
        EXPECT_EQ(again.exit_code, 0) << again.err;
    }
}

// Names of files are bytes, not text.
TEST_F(RecordedView, NamesThatAreNoUtf8LeadToTheirFiles) {
    const std::string land = data / "land\xff.tif", style = data / "st\xfe.json";
    fs::copy_file(bundled(), land);
    fs::copy_file(oro::test::bundled_data() / "styles" / "haze.json", style);
    const fs::path picture = pictures / "p.png";
    const Outcome drawn = shoot({land, "--style", style, "--out", picture});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Outcome again = run_orograph({"shot", "--view", picture, "-q"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    for (const char* hex : {"", "f", "zz", "00", "41 4", "4g"}) {
        json view = json::parse(view_in(picture));
        view["sources"] = {{{"hex", hex}}};
        write_bytes(pictures / "v.json", view.dump());
        expect_refusal(run_orograph({"plan", "--view", pictures / "v.json"}), failed,
                       {"'sources'", "hexadecimal"});
    }
}

TEST_F(RecordedView, PathsStartFromThePicture) {
    const fs::path picture = pictures / "p.png";
    for (const auto& [named, out, from] :
         std::vector<std::tuple<fs::path, fs::path, fs::path>>{{data / "land.tif", picture, ""},
                                                               {"data/land.tif", "pictures/p.png", folder},
                                                               {"../data/land.tif", "p.png", pictures},
                                                               {"land.tif", "../pictures/p.png", data}}) {
        SCOPED_TRACE(named);
        const Outcome drawn =
            shoot({named, "--out", out, "--overwrite", "--time", "2026-01-01T00:00:00Z"}, from);
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        EXPECT_EQ(json::parse(view_in(picture))["sources"], json({"../data/land.tif"}));
        EXPECT_EQ(bytes_of(picture).find(folder.filename().string()), std::string::npos)
            << "the picture tells where it was made";
    }
    // Everything goes elsewhere, and is opened from anywhere.
    const fs::path elsewhere = oro::test::scratch_folder() / "moved";
    fs::rename(folder, elsewhere);
    const Outcome again = run_orograph({"shot", "--view", elsewhere / "pictures" / "p.png"});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(again.err.find("draws the same bytes"), std::string::npos) << again.err;
    Circumstances there;
    there.folder = elsewhere / "pictures";
    ASSERT_EQ(run_orograph({"shot", "--view", "p.png", "--out", "again.png", "-q"}, there).exit_code, 0);
    EXPECT_TRUE(bytes_of(elsewhere / "pictures" / "again.png") == bytes_of(elsewhere / "pictures" / "p.png"));
    fs::rename(elsewhere, folder);
}

// Links: as named where that leads there, else as things really lie.
TEST_F(RecordedView, PathsThroughLinks) {
    fs::create_directory_symlink(data, folder / "link");
    fs::create_directories(folder / "deep" / "er");
    fs::create_directory_symlink(folder / "deep" / "er", folder / "short");
    ASSERT_EQ(shoot({folder / "link" / "land.tif", "--out", pictures / "p.png"}).exit_code, 0);
    EXPECT_EQ(json::parse(view_in(pictures / "p.png"))["sources"], json({"../link/land.tif"}));
    ASSERT_EQ(shoot({"data/land.tif", "--out", "short/p.png"}, folder).exit_code, 0);
    EXPECT_EQ(json::parse(view_in(folder / "short" / "p.png"))["sources"], json({"../../data/land.tif"}));
    for (const fs::path& picture : {pictures / "p.png", folder / "short" / "p.png"})
        EXPECT_EQ(run_orograph({"shot", "--view", picture, "-q"}).exit_code, 0) << picture;
}

// Views of before had no word about it: their paths start from the working folder.
TEST_F(RecordedView, ViewsOfBeforeStartFromTheWorkingFolder) {
    const Outcome reported = shoot({"data/land.tif", "--out", "pictures/p.png", "--json"}, folder);
    ASSERT_EQ(reported.exit_code, 0) << reported.err;
    const json view = json::parse(reported.out).at("view");
    EXPECT_FALSE(view.contains("paths_from"));
    write_bytes(pictures / "p.json", view.dump());
    Circumstances there;
    there.folder = folder;
    const Outcome again = run_orograph({"shot", "--view", "pictures/p.json"}, there);
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(again.err.find("pictures/p.png is there already"), std::string::npos) << again.err;
}

TEST_F(RecordedView, NoPathsWhereNoneAreWanted) {
    const fs::path style = data / "mine.json", picture = pictures / "p.png";
    fs::copy_file(oro::test::bundled_data() / "styles" / "haze.json", style);
    const Outcome drawn =
        shoot({data / "land.tif", "--style", style, "--no-paths", "--out", picture, "--json"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(json::parse(drawn.out).at("view").at("sources"), json::array());
    for (const char* reported : {"land.tif", "data", folder.filename().c_str()})
        EXPECT_EQ(bytes_of(picture).find(reported), std::string::npos) << reported;
    expect_refusal(run_orograph({"shot", "--view", picture}), usage, {"--view", "elevation data"});
    const Outcome again = run_orograph({"shot", data / "land.tif", "--view", picture, "--style", style});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_NE(again.err.find("draws the same bytes"), std::string::npos) << "it tells no paths again";
}

// Found: who had moved the data was told that they are gone, and not what to do.
TEST_F(RecordedView, DataThatAreGoneCanBeNamed) {
    const fs::path picture = pictures / "p.png";
    ASSERT_EQ(shoot({data / "land.tif", "--out", picture}).exit_code, 0);
    fs::rename(data / "land.tif", data / "moved.tif");
    const std::string way = "; name the data after the picture: orograph compare PICTURE PATH...";
    expect_refusal(run_orograph({"compare", picture, "-q"}), 1, {"land.tif", way});
    expect_refusal(run_orograph({"shot", "--view", picture, "--out", pictures / "q.png"}), 1,
                   {"land.tif", way, "shot --view PICTURE PATH..."});
    EXPECT_EQ(run_orograph({"compare", picture, data / "moved.tif", "-q"}).exit_code, 0);
}

// Found: again.jpg could not be drawn where there was an again.png, whose view had its name.
TEST_F(RecordedView, PicturesOfOneNameDoNotMeet) {
    for (const char* name : {"p.png", "p.jpg", "p.tif"}) {
        const Outcome drawn = shoot({data / "land.tif", "--verify", "--out", pictures / name});
        EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    }
    EXPECT_EQ(shoot({"--view", pictures / "p.jpg", "--out", pictures / "again.jpg"}).exit_code, 0);
    EXPECT_EQ(names_in(pictures), (Words{"again.jpg", "p.error.png", "p.jpg", "p.jpg.error.png", "p.png",
                                         "p.tif", "p.tif.error.png"}));
}

// Found: --overwrite replaced whatever was NAME.json beside the picture.
TEST_F(RecordedView, OverwriteLeavesOtherFilesAlone) {
    write_bytes(pictures / "p.json", "{\"mine\": true}");
    const Outcome drawn = shoot({data / "land.tif", "--overwrite", "--out", pictures / "p.png"});
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_EQ(bytes_of(pictures / "p.json"), "{\"mine\": true}");
}

// The picture and the picture of its errors have their names both, or neither: the second cannot have its
// own.
TEST_F(RecordedView, PictureAndErrorsAreOneStep) {
    if (!fs::exists("/proc/self/fd")) GTEST_SKIP() << "needs /proc";
    ASSERT_EQ(shoot({data / "land.tif", "--verify", "--out", pictures / "p.png"}).exit_code, 0);
    const std::string picture = bytes_of(pictures / "p.png"), errors = bytes_of(pictures / "p.error.png");
    const std::string session = R"(
        there=$1; shift
        "$@" & child=$!
        # A file there that stays open: not the one that tries, before anything is drawn, whether there can be one.
        open=0
        until [ $open -ge 5 ]; do
            kill -0 $child 2>/dev/null || exit 97
            if ls -l /proc/$child/fd 2>/dev/null | grep -qF "$there"; then open=$((open + 1)); else open=0; fi
            sleep 0.02
        done
        mv "$there/p.png" "$there/old"; mkdir "$there/p.png"
        wait $child; code=$?
        rmdir "$there/p.png"; mv "$there/old" "$there/p.png"; exit $code)";
    const Outcome outcome = oro::test::run_program(
        {"bash", "-c", session, "bash", pictures, OROGRAPH_PROGRAM, "shot", data / "land.tif", "--style",
         "default", "--verify", "--overwrite", "-q", "--size", "1200x900", "--out", pictures / "p.png"});
    expect_refusal(outcome, failed, {pictures / "p.png", "cannot be written"});
    EXPECT_TRUE(bytes_of(pictures / "p.png") == picture);
    EXPECT_TRUE(bytes_of(pictures / "p.error.png") == errors);
    EXPECT_EQ(names_in(pictures), (Words{"p.error.png", "p.png"}));
}

}  // namespace
