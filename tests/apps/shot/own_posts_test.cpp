// --own-posts as users meet it: pictures of a projected file's own posts, drawn again from their views, and
// what is refused.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using Words = std::vector<std::string>;

// The bundled region in UTM, zone 16: at its eastern edge.
std::string utm(const fs::path& folder) {
    const std::string file = folder / "utm.tif";
    const Outcome warped =
        run_program({"gdalwarp", "-q", "-t_srs", "EPSG:32616", "-tr", "80", "80", "-r", "bilinear",
                     "-dstnodata", "-9999", oro::test::bundled_data() / "jacksboro.tif", file});
    EXPECT_EQ(warped.exit_code, 0) << warped.err;
    return file;
}

oro::test::Circumstances as_users_do() {
    oro::test::Circumstances circumstances;
    circumstances.natural = true;
    return circumstances;
}

const Words eye{"--at",    "36.55,-84.25", "--above", "1500",   "--heading", "30",
                "--pitch", "-25",          "--size",  "160x90", "-q"};

Words shot(const std::string& file, const fs::path& out, const Words& more = {}) {
    Words words{"shot", file, "--own-posts", "--out", out};
    words.insert(words.end(), eye.begin(), eye.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

TEST(OwnPostsOfShots, AreDrawnAgainByEitherWayFromTheirView) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    const Outcome mesh =
        run_orograph(shot(file, folder / "mesh.png", {"--pipeline", "mesh", "--tau", "0"}), as_users_do());
    ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
    const json view = json::parse(oro::test::view_in(folder / "mesh.png"));
    EXPECT_EQ(view["own_posts"], true);
    const Outcome again = run_orograph(
        {"shot", "--view", folder / "mesh.png", "--out", folder / "again.png", "-q"}, as_users_do());
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_TRUE(bytes_of(folder / "again.png") == bytes_of(folder / "mesh.png"));
    // The same view without: another picture, whose view says nothing of it.
    Words resampled = shot(file, folder / "resampled.png", {"--pipeline", "mesh", "--tau", "0"});
    std::erase(resampled, "--own-posts");
    ASSERT_EQ(run_orograph(resampled, as_users_do()).exit_code, 0);
    EXPECT_FALSE(json::parse(oro::test::view_in(folder / "resampled.png")).contains("own_posts"));
    EXPECT_FALSE(bytes_of(folder / "resampled.png") == bytes_of(folder / "mesh.png"));
}

TEST(OwnPostsOfShots, AreWithinTauOfTheTruth) {
    const fs::path folder = oro::test::scratch_folder();
    const Outcome shown = run_orograph(shot(utm(folder), folder / "a.png", {"--verify", "--json"}));
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    const json told = json::parse(shown.out);
    EXPECT_TRUE(told.dump().find("\"within\":false") == std::string::npos) << told.dump();
}

TEST(OwnPostsOfShots, AreWhatInfoTells) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    const Outcome info = run_orograph({"info", file, "--own-posts"});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    // 80 m of UTM's plane are 79.98 m of the ellipsoid where its scale is 1.00025 (2.6 degrees from its middle).
    EXPECT_NE(info.out.find("the file's own, every 79.9"), std::string::npos) << info.out;
    const Outcome told = run_orograph({"info", file, "--own-posts", "--json"});
    const json region = json::parse(told.out)["region"];
    EXPECT_EQ(region["own_posts"], true);
    // UTM stretches by up to 0.04 % at 3 degrees from its middle.
    EXPECT_NEAR(region["largest_spacing_m"]["rows"].get<double>(), 80.0, 0.1);
    EXPECT_FALSE(region.contains("spacing_deg"));
}

TEST(OwnPostsOfShots, AreRefusedWhereTheyCannotBe) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    expect_refusal(run_orograph({"bake", file, "--own-posts", "--out", folder / "a.oro"}), 2,
                   {"--own-posts", "bake"});
    expect_refusal(run_orograph({"plan", file, "--own-posts"}), 2, {"--own-posts", "plan"});
    expect_refusal(run_orograph({"trade", file, "--own-posts", "--out", folder / "t"}), 2,
                   {"--own-posts", "trade"});
    expect_refusal(
        run_orograph({"viewshed", file, "--own-posts", "--at", "36.55,-84.25", "--out", folder / "v.tif"}), 2,
        {"--own-posts", "viewshed"});
    expect_refusal(run_orograph(shot(file, folder / "b.png", {"--earth", "sphere"})), 2,
                   {"--earth", "--own-posts"});
    expect_refusal(run_orograph(shot(file, folder / "b.png", {"--precision", "naive"})), 2,
                   {"--precision", "--own-posts"});
    expect_refusal(run_orograph(shot(file, folder / "b.png", {"--drape", file})), 2,
                   {"--drape", "--own-posts"});
    // Beside a file on degrees there is no lattice.
    Words both = shot(file, folder / "b.png");
    both.insert(both.begin() + 2, oro::test::bundled_data() / "jacksboro.tif");
    expect_refusal(run_orograph(both), 2, {"--own-posts", "one lattice"});
    EXPECT_FALSE(fs::exists(folder / "b.png"));
}

// Sight lines and profiles over own posts: from the highest, 0 m over it.
TEST(OwnPostsOfShots, AreSeenAndWalkedOver) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    const Outcome sight = run_orograph(
        {"sight", file, "--own-posts", "--from", "36.55,-84.25", "--to", "36.65,-84.2", "--json", "-q"});
    ASSERT_EQ(sight.exit_code, 0) << sight.err;
    const Outcome profile = run_orograph({"profile", file, "--own-posts", "--along",
                                          "36.5,-84.3; 36.55,-84.2", "--out", folder / "p.csv", "-q"});
    ASSERT_EQ(profile.exit_code, 0) << profile.err;
    EXPECT_GT(bytes_of(folder / "p.csv").size(), 1000U);
}

}  // namespace
