// orograph shot --legend as people use it: the picture above stays as it is, and its view draws both again.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::names_in;
using oro::test::object_said_by;
using oro::test::pixels_of;
using oro::test::run_orograph;
using oro::test::Words;

Words shot_with_legend(const fs::path& out, const Words& more = {}) {
    Words words{"shot",   bundled(),   "--at", "36.5,-84.25", "--above",
                "200",    "--heading", "320",  "--pitch",     "-8",
                "--size", "320x120",   "-q",   "--time",      "2026-01-02T03:04:05Z",
                "--out",  out.string()};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(ShotLegend, StandsBelowThePictureAsItIs) {
    const fs::path folder = oro::test::scratch_folder();
    ASSERT_EQ(run_orograph(shot_with_legend(folder / "bare.png")).exit_code, 0);
    const auto reported = object_said_by(shot_with_legend(folder / "with.png", {"--legend", "--json"}));
    const auto bare = pixels_of(folder / "bare.png"), with = pixels_of(folder / "with.png");
    ASSERT_EQ(bare.height, 120U);
    ASSERT_EQ(with.width, 320U);
    const int strip_px = reported["view"]["legend_px"].get<int>();
    EXPECT_EQ(with.height, 120U + static_cast<unsigned>(strip_px));
    EXPECT_GT(strip_px, 120);
    EXPECT_TRUE(std::equal(bare.rgb.begin(), bare.rgb.end(), with.rgb.begin()));
    // Paper with something on it.
    std::size_t dark = 0;
    for (std::size_t i = bare.rgb.size(); i < with.rgb.size(); i += 3) dark += with.rgb[i] < 90;
    EXPECT_GT(dark, 500U);
    EXPECT_LT(dark, (with.rgb.size() - bare.rgb.size()) / 12);
    EXPECT_EQ(reported["view"]["size_px"], nlohmann::json({320, 120}));
}

TEST(ShotLegend, ItsViewDrawsItAgain) {
    for (const char* name : {"p.png", "p.jpg", "p.tif"}) {
        const fs::path folder = oro::test::scratch_folder(), file = folder / name;
        ASSERT_EQ(run_orograph(shot_with_legend(file, {"--legend"})).exit_code, 0);
        const auto again = run_orograph({"shot", "--view", file.string(), "-q", "--out",
                                         (folder / ("again-" + std::string(name))).string()});
        EXPECT_EQ(again.exit_code, 0) << again.err;
        EXPECT_EQ(bytes_of(folder / ("again-" + std::string(name))), bytes_of(file));
        const auto check = run_orograph({"shot", "--view", file.string()});
        EXPECT_NE(check.err.find("its view draws the same bytes"), std::string::npos) << check.err;
        const auto compared = run_orograph({"compare", file.string()});
        EXPECT_EQ(compared.exit_code, 0) << compared.err;
        EXPECT_EQ(compared.err.find("note: " + file.string()), std::string::npos) << compared.err;
    }
}

TEST(ShotLegend, OfAMapIsOpaqueBelowIt) {
    const fs::path folder = oro::test::scratch_folder(), file = folder / "m.tif";
    const Words words{"shot",      bundled(), "--ortho", "--legend", "--size", "240x200",    "--crs",
                      "EPSG:3857", "--style", "slope",   "-q",       "--out",  file.string()};
    ASSERT_EQ(run_orograph(words).exit_code, 0);
    const auto again =
        run_orograph({"shot", "--view", file.string(), "-q", "--out", (folder / "n.tif").string()});
    EXPECT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(bytes_of(folder / "n.tif"), bytes_of(file));
    EXPECT_EQ(bytes_of(folder / "n.tfw"), bytes_of(folder / "m.tfw"));
}

// What explains a frame has a legend without being asked, and needs nothing but a word to have none.
TEST(ShotLegend, OfShowIsThereByItself) {
    const fs::path folder = oro::test::scratch_folder();
    const auto reported =
        object_said_by(shot_with_legend(folder / "with.png", {"--show", "levels", "--json"}));
    const auto none =
        object_said_by(shot_with_legend(folder / "bare.png", {"--show", "levels", "--no-legend", "--json"}));
    ASSERT_TRUE(reported["view"].contains("legend_px"));
    EXPECT_FALSE(none["view"].contains("legend_px"));
    const auto bare = pixels_of(folder / "bare.png"), with = pixels_of(folder / "with.png");
    EXPECT_EQ(bare.height, 120U);
    EXPECT_EQ(with.height, 120U + reported["view"]["legend_px"].get<unsigned>());
    EXPECT_TRUE(std::equal(bare.rgb.begin(), bare.rgb.end(), with.rgb.begin()));
    for (const char* name : {"with.png", "bare.png"}) {
        const fs::path again = folder / ("again-" + std::string(name));
        ASSERT_EQ(run_orograph({"shot", "--view", (folder / name).string(), "-q", "--out", again}).exit_code,
                  0);
        EXPECT_TRUE(bytes_of(again) == bytes_of(folder / name)) << name;
    }
    const fs::path without = folder / "without.png";
    ASSERT_EQ(run_orograph(
                  {"shot", "--view", (folder / "with.png").string(), "--no-legend", "-q", "--out", without})
                  .exit_code,
              0);
    EXPECT_TRUE(pixels_of(without).rgb == bare.rgb);
}

TEST(ShotLegend, OfShowIsLeftOutOfNarrowPictures) {
    const fs::path folder = oro::test::scratch_folder();
    Words words = shot_with_legend(folder / "p.png", {"--show", "levels"});
    words[11] = "199x100";
    std::erase(words, "-q");
    const auto outcome = run_orograph(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("note: a picture less than 200 px wide has no room for the legend of --show"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(pixels_of(folder / "p.png").height, 100U);
    expect_refusal(run_orograph(shot_with_legend(folder / "q.png", {"--legend", "--no-legend"})), 2,
                   {"--legend", "--no-legend"});
}

TEST(ShotLegend, NeedsAPictureThatIsWideEnough) {
    const fs::path folder = oro::test::scratch_folder();
    Words words = shot_with_legend(folder / "p.png", {"--legend"});
    words[11] = "199x100";
    expect_refusal(run_orograph(words), 2, {"--legend: needs a picture at least 200 px wide"});
    EXPECT_EQ(names_in(folder), Words{});
}

// A name that is no UTF-8 is a name: it is drawn with a replacement, and in other characters' stead.
TEST(ShotLegend, OfAFileWithALatin1Name) {
    const fs::path folder = oro::test::scratch_folder(), land = folder / "Z\xfcrich\xc2\x9b.tif";
    fs::copy_file(bundled(), land);
    for (const Words& more : {Words{"--legend"}, Words{"--show", "levels"}}) {
        Words words = shot_with_legend(folder / "p.png", more);
        words[1] = land.string();
        words.insert(words.end(), {"--drape", land.string(), "--overwrite"});
        const auto outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        EXPECT_GT(pixels_of(folder / "p.png").height, 120U);
        const auto again = run_orograph({"shot", "--view", (folder / "p.png").string(), "-q"});
        EXPECT_EQ(again.exit_code, 0) << again.err;
    }
    const auto reported = run_orograph({"info", land.string()});
    EXPECT_NE(reported.out.find("Z\xEF\xBF\xBDrich?.tif"), std::string::npos) << reported.out;
}

}  // namespace
