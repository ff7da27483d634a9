// Files that lie far apart: each is drawn where it is, at the cost of what it holds.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

// Two tiles of 1,201 x 1,201 posts, 180 degrees from each other, all 500 and all 700 m high but for some
// hills.
fs::path tile(const fs::path& folder, const std::string& name, int middle_m) {
    const fs::path file = folder / name;
    std::string bytes;
    for (int row = 0; row <= 1200; ++row) {
        for (int column = 0; column <= 1200; ++column) {
            const int H_m = middle_m + (row / 20 % 7) * (column / 20 % 5) * 9;
            bytes.push_back(static_cast<char>(H_m >> 8));
            bytes.push_back(static_cast<char>(H_m & 255));
        }
    }
    oro::test::write_bytes(file, bytes);
    return file;
}

std::vector<std::string> words(const std::vector<std::string>& first, const std::vector<std::string>& more) {
    std::vector<std::string> all = first;
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

class FilesFarApart : public ::testing::Test {
  protected:
    void SetUp() override {
        folder_ = oro::test::scratch_folder();
        north_ = tile(folder_, "N46E008.hgt", 500).string();
        south_ = tile(folder_, "S47W172.hgt", 700).string();
    }
    // A picture's pixels, as its own fingerprint has them.
    static std::string pixels(const fs::path& picture) {
        const json view = json::parse(oro::test::view_in(picture));
        return view["fingerprints"]["pixels"].get<std::string>();
    }
    fs::path folder_;
    std::string north_, south_;
};

// One grid over both would have 226 million posts or more.
TEST_F(FilesFarApart, AreEachDrawnAsAlone) {
    for (const auto& [file, place] : {std::pair{north_, "46.5,8.5"}, std::pair{south_, "-46.5,-171.5"}}) {
        const std::vector<std::string> eye{"--at",    place, "--above", "900",
                                           "--pitch", "-10", "--size",  "160x120"};
        const fs::path alone = folder_ / "alone.png", both = folder_ / "both.png";
        const Outcome one =
            run_orograph(words({"shot", file, "--out", alone.string(), "--overwrite", "-q"}, eye));
        ASSERT_EQ(one.exit_code, 0) << one.err;
        const Outcome two = run_orograph(
            words({"shot", north_, south_, "--out", both.string(), "--overwrite", "--json"}, eye));
        ASSERT_EQ(two.exit_code, 0) << two.err;
        EXPECT_EQ(pixels(alone), pixels(both)) << place;
        const json reported = json::parse(two.out);
        EXPECT_EQ(reported["sources"].size(), 2U);
        EXPECT_EQ(reported["region"]["posts"]["rows"], 1201);
        const Outcome again = run_orograph({"shot", "--view", both.string(), "--out",
                                            (folder_ / "again.png").string(), "-q", "--overwrite"});
        ASSERT_EQ(again.exit_code, 0) << again.err;
        EXPECT_EQ(pixels(both), pixels(folder_ / "again.png"));
    }
}

TEST_F(FilesFarApart, AreListedAsRegionsOfTheirOwn) {
    const Outcome info = run_orograph({"info", north_, south_, "--json"});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    const json reported = json::parse(info.out);
    ASSERT_EQ(reported["apart"].size(), 1U);
    EXPECT_EQ(reported["region"]["posts"]["rows"], 1201);
    EXPECT_EQ(reported["apart"][0]["region"]["posts"]["rows"], 1201);
    const Outcome text = run_orograph({"info", north_, south_});
    EXPECT_NE(text.out.find("2 grids of posts"), std::string::npos) << text.out;
}

// What measures a picture does so on one grid yet: it refuses such a picture, and says why.
TEST_F(FilesFarApart, AreMeasured) {
    const fs::path both = folder_ / "both.png";
    const Outcome drawn = run_orograph({"shot", north_, south_, "--at", "46.5,8.5", "--above", "900",
                                        "--size", "80x60", "--out", both.string(), "-q"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    for (const Words& words : {Words{"compare", both.string(), "--json", "-q"},
                               Words{"shot", "--view", both.string(), "--verify", "--json", "-q", "--out",
                                     (folder_ / "x.png").string()}}) {
        const json reported = object_said_by(words);
        EXPECT_GT(reported["error"]["drawn_pixels"].get<int>(), 1000);
        EXPECT_EQ(reported["error"]["pixels_beyond_data"], 0);
        EXPECT_LE(reported["error"]["largest_px"].get<double>(),
                  1.0 + reported["error"]["slack_px"].get<double>());
    }
}

// What was measured was drawn as one grid, and is drawn again so.
TEST_F(FilesFarApart, AreDrawnAgainAsTheyWere) {
    const fs::path folder = folder_ / "near";
    fs::create_directory(folder);
    const std::string a = tile(folder, "N46E008.hgt", 500).string(),
                      b = tile(folder, "N48E010.hgt", 600).string();
    const fs::path both = folder / "both.png";
    const Outcome drawn =
        run_orograph({"shot", a, b, "--bbox=8.9,46.9,10.1,48.1", "--at", "46.95,8.95", "--above", "900",
                      "--size", "80x60", "--verify", "--out", both.string(), "-q"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Outcome again =
        run_orograph({"shot", "--view", both.string(), "--out", (folder / "again.png").string(), "-q"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(pixels(both), pixels(folder / "again.png"));
}

// A file without any height is left out where others have some.
TEST_F(FilesFarApart, AreLeftOutWhereTheyAreEmpty) {
    std::string bytes;
    for (int post = 0; post < 1201 * 1201; ++post) bytes += std::string{static_cast<char>(0x80), '\0'};
    oro::test::write_bytes(south_, bytes);
    const Outcome info = run_orograph({"info", north_, south_});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    EXPECT_NE(info.out.find("left out: no height"), std::string::npos) << info.out;
}

// Tiles with a gap between them that is not larger than they are make one region, as ever.
TEST_F(FilesFarApart, AreOneRegionWhereTheGapIsSmall) {
    const std::string near = tile(folder_, "N46E010.hgt", 600).string();
    const Outcome info = run_orograph({"info", north_, near, "--json"});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    const json reported = json::parse(info.out);
    EXPECT_FALSE(reported.contains("apart"));
    EXPECT_EQ(reported["region"]["posts"]["columns"], 3601);
}

}  // namespace
