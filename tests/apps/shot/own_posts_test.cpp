// Projected files as users meet them: their own posts are drawn, baked, looked around over and measured; and
// what is resampled, on request or because nothing else can be.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/picture_pixels.h"
#include "tests/apps/program.h"
#include "tests/apps/said_json.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::Words;

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

const Words eye_over_posts{"--at",    "36.55,-84.25", "--above", "1500",   "--heading", "30",
                           "--pitch", "-25",          "--size",  "160x90", "-q"};

Words shot_of_posts(const std::string& file, const fs::path& out, const Words& more = {}) {
    Words words{"shot", file, "--out", out};
    words.insert(words.end(), eye_over_posts.begin(), eye_over_posts.end());
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

void expect_drawn(const Words& words) {
    const Outcome outcome = run_orograph(words, as_users_do());
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
}

json view_of(const fs::path& picture) {
    return json::parse(oro::test::view_in(picture));
}

TEST(OwnPostsOfShots, AreDrawnAgainByEitherWayFromTheirView) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    expect_drawn(shot_of_posts(file, folder / "mesh.png", {"--pipeline", "mesh", "--tau", "0"}));
    EXPECT_EQ(view_of(folder / "mesh.png")["own_posts"], true);
    expect_drawn({"shot", "--view", folder / "mesh.png", "--out", folder / "again.png", "-q"});
    EXPECT_TRUE(bytes_of(folder / "again.png") == bytes_of(folder / "mesh.png"));
    EXPECT_EQ(run_orograph({"compare", folder / "mesh.png", "-q"}).exit_code, 0);
}

// Views of before posts were kept say nothing of them; so do those of resampled ones, which they were.
TEST(OwnPostsOfShots, ViewsThatSayNothingOfThemAreDrawnResampled) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    const Words detail{"--pipeline", "mesh", "--tau", "0"};
    expect_drawn(shot_of_posts(file, folder / "own.png", detail));
    Words resampled = shot_of_posts(file, folder / "resampled.png", detail);
    resampled.emplace_back("--resample");
    expect_drawn(resampled);
    EXPECT_FALSE(view_of(folder / "resampled.png").contains("own_posts"));
    EXPECT_FALSE(oro::test::pixels_of(folder / "resampled.png").rgb ==
                 oro::test::pixels_of(folder / "own.png").rgb);
    expect_drawn({"shot", "--view", folder / "resampled.png", "--out", folder / "again.png", "-q"});
    EXPECT_TRUE(bytes_of(folder / "again.png") == bytes_of(folder / "resampled.png"));
    expect_refusal(
        run_orograph({"shot", "--view", folder / "own.png", "--resample", "--out", folder / "x.png"}), 2,
        {"--resample", "view"});
}

TEST(OwnPostsOfShots, AreWithinTauOfTheTruth) {
    const fs::path folder = oro::test::scratch_folder();
    const Outcome shown = run_orograph(shot_of_posts(utm(folder), folder / "a.png", {"--verify", "--json"}));
    ASSERT_EQ(shown.exit_code, 0) << shown.err;
    const json reported = json::parse(shown.out);
    EXPECT_TRUE(reported.dump().find("\"within\":false") == std::string::npos) << reported.dump();
}

TEST(OwnPostsOfShots, AreWhatInfoTells) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    const Outcome info = run_orograph({"info", file});
    ASSERT_EQ(info.exit_code, 0) << info.err;
    // 80 m of UTM's plane are 79.98 m of the ellipsoid where its scale is 1.00025 (2.6 degrees from its
    // middle).
    EXPECT_NE(info.out.find("the file's own, every 79.99"), std::string::npos) << info.out;
    const json region = object_said_by({"info", file, "--json"})["region"];
    EXPECT_EQ(region["own_posts"], true);
    // UTM stretches by up to 0.04 % at 3 degrees from its middle.
    EXPECT_NEAR(region["largest_spacing_m"]["rows"].get<double>(), 80.0, 0.1);
    EXPECT_FALSE(region.contains("spacing_deg"));
    EXPECT_TRUE(object_said_by({"info", file, "--json", "--resample"})["region"].contains("spacing_deg"));
}

// 4,107.9 m in the Swiss CRS: its highest post, where it stands.
TEST(OwnPostsOfShots, OfTheSwissTileHaveItsSummit) {
    const auto file = oro::test::real_data("geotiff/N46E008_EPSG2056_f32_cog.tif");
    if (!file) GTEST_SKIP() << "needs geotiff";
    const json region = object_said_by({"info", file->string(), "--json"})["region"];
    EXPECT_NEAR(region["H_m"]["highest"].get<double>(), 4107.896, 5e-4);
    EXPECT_NEAR(region["H_m"]["lowest"].get<double>(), 431.0, 5e-4);
    // Who stands there stands on it; resampled, it is 20.8 m lower.
    const fs::path folder = oro::test::scratch_folder();
    const auto eye_H_m = [&](const Words& more) {
        Words words{"shot",       file->string(), "--at",  "46.536526910,8.125552471", "--above", "0.5",
                    "--size",     "64x36",        "--out", folder / "top.png",         "--json",  "-q",
                    "--overwrite"};
        words.insert(words.end(), more.begin(), more.end());
        return object_said_by(words)["eye"]["H_m"].get<double>();
    };
    EXPECT_NEAR(eye_H_m({}) - 0.5, 4107.896, 1e-3);
    EXPECT_NEAR(eye_H_m({"--resample"}) - 0.5, 4087.088, 1e-3);
}

TEST(OwnPostsOfShots, AreRefusedWhereTheyCannotBe) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    expect_refusal(run_orograph(shot_of_posts(file, folder / "b.png", {"--earth", "sphere"})), 2,
                   {"--earth", "--resample"});
    expect_refusal(run_orograph(shot_of_posts(file, folder / "b.png", {"--precision", "naive"})), 2,
                   {"--precision", "--resample"});
    EXPECT_FALSE(fs::exists(folder / "b.png"));
    expect_drawn(shot_of_posts(file, folder / "b.png", {"--earth", "sphere", "--resample"}));
}

// Beside a file on degrees there is no lattice. What is measured on one grid resamples both, and a note says
// so.
TEST(OwnPostsOfShots, BesideOtherFilesAreKeptByWhatPredicts) {
    const fs::path folder = oro::test::scratch_folder();
    Words both = shot_of_posts(utm(folder), folder / "b.png");
    both.insert(both.begin() + 2, oro::test::bundled_data() / "jacksboro.tif");
    std::erase(both, "-q");
    both.insert(both.end(), {"--tolerance", "1"});
    const Outcome outcome = run_orograph(both);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err.find("resampled"), std::string::npos) << outcome.err;
    EXPECT_TRUE(view_of(folder / "b.png")["own_posts"].get<bool>());
    EXPECT_TRUE(view_of(folder / "b.png")["several_grids"].get<bool>());
}

// Sight lines and profiles over own posts: from the highest, 0 m over it.
TEST(OwnPostsOfShots, AreSeenAndWalkedOver) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    const Outcome sight =
        run_orograph({"sight", file, "--from", "36.55,-84.25", "--to", "36.65,-84.2", "--json", "-q"});
    ASSERT_EQ(sight.exit_code, 0) << sight.err;
    const Outcome profile = run_orograph(
        {"profile", file, "--along", "36.5,-84.3; 36.55,-84.2", "--out", folder / "p.csv", "-q"});
    ASSERT_EQ(profile.exit_code, 0) << profile.err;
    EXPECT_GT(bytes_of(folder / "p.csv").size(), 1000U);
}

TEST(OwnPostsOfShots, ArePlannedAndTraded) {
    const fs::path folder = oro::test::scratch_folder();
    const std::string file = utm(folder);
    Words plan{"plan", file, "--json"};
    plan.insert(plan.end(), eye_over_posts.begin(), eye_over_posts.end());
    const json own = object_said_by(plan);
    plan.insert(plan.end(), "--resample");
    const json resampled = object_said_by(plan);
    EXPECT_FALSE(own.contains("resampling"));
    EXPECT_TRUE(resampled.contains("resampling"));
    ASSERT_EQ(own["effects"].size(), resampled["effects"].size());
    for (std::size_t i = 0; i < own["effects"].size(); ++i) {
        const json &one = own["effects"][i], &other = resampled["effects"][i];
        ASSERT_EQ(one["kind"], other["kind"]);
        // The same ground, but for what resampling changed.
        for (const char* kind : {"geoid", "sphere", "flat", "refraction", "float32_posts"}) {
            if (one["kind"] != kind) continue;
            const double m = one["size"]["worst_m"], resampled_m = other["size"]["worst_m"];
            EXPECT_NEAR(m, resampled_m, 0.15 * resampled_m) << kind;
        }
    }
    const Outcome trade =
        run_orograph({"trade", file, "--at", "36.55,-84.25", "--above", "1500", "--pitch", "-25", "--size",
                      "64x36", "--repeats", "1", "--out", folder / "t", "-q"});
    ASSERT_EQ(trade.exit_code, 0) << trade.err;
    EXPECT_NE(trade.out.find("left out: --earth and --precision"), std::string::npos) << trade.out;
    EXPECT_EQ(trade.out.find("MORE THAN PREDICTED"), std::string::npos) << trade.out;
    EXPECT_EQ(bytes_of(folder / "t" / "trade.csv").find("sphere"), std::string::npos);
}

}  // namespace
