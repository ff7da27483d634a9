// orograph viewshed --realisations as people and programs use it.
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/apps/said_json.h"

namespace {
namespace fs = std::filesystem;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::run_orograph;
using oro::test::run_program;
using oro::test::says;
using oro::test::Words;

const std::string hills = "made:fbm?seed=7&H=-200:4000&spacing=3s&box=8.2,46.2,8.3,46.3";

Words probability_words(const fs::path& out, const Words& more) {
    return joined({"viewshed", hills, "-q", "--at", "46.25,8.25", "--above", "10", "--radius", "3", "--out",
                   out.string()},
                  more);
}

// One processor or all of them, now and again: the same bytes. Another seed gives others.
TEST(ProbableViewshed, OfASeedIsTheSameFileFromAnyNumberOfThreads) {
    const fs::path folder = oro::test::scratch_folder();
    const Words words{"--realisations", "12", "--accuracy", "16", "--seed", "5"};
    ASSERT_EQ(run_orograph(probability_words(folder / "all.tif", words)).exit_code, 0);
    const auto one = run_program(
        joined({"taskset", "-c", "0", OROGRAPH_PROGRAM}, probability_words(folder / "one.tif", words)));
    if (one.exit_code == 127) GTEST_SKIP() << "needs taskset";
    ASSERT_EQ(one.exit_code, 0) << one.err;
    EXPECT_EQ(bytes_of(folder / "one.tif"), bytes_of(folder / "all.tif"));
    Words others = words;
    others.back() = "6";
    ASSERT_EQ(run_orograph(probability_words(folder / "others.tif", others)).exit_code, 0);
    EXPECT_NE(bytes_of(folder / "others.tif"), bytes_of(folder / "all.tif"));
}

TEST(ProbableViewshed, IsAFurtherBandAndTheOthersAreAsEver) {
    const fs::path folder = oro::test::scratch_folder();
    ASSERT_EQ(run_orograph(probability_words(folder / "plain.tif", {})).exit_code, 0);
    const auto reported = object_said_by(
        probability_words(folder / "probable.tif",
                          {"--json", "--realisations", "20", "--accuracy", "16", "--correlation", "150"}));
    EXPECT_EQ(reported["realisations"]["count"], 20);
    EXPECT_EQ(reported["realisations"]["seed"], 1);
    EXPECT_EQ(reported["realisations"]["le90_m"], 16.0);
    EXPECT_EQ(reported["realisations"]["correlation_m"], 150.0);
    const auto plain = run_program({"gdalinfo", "-json", "-checksum", (folder / "plain.tif").string()});
    if (plain.exit_code == 127) GTEST_SKIP() << "needs gdalinfo";
    const auto probable =
        run_program({"gdalinfo", "-json", "-checksum", "-stats", (folder / "probable.tif").string()});
    const auto before = oro::test::one_object(plain.out), after = oro::test::one_object(probable.out);
    ASSERT_EQ(before["bands"].size(), 2U);
    ASSERT_EQ(after["bands"].size(), 3U);
    for (std::size_t band = 0; band < 2; ++band)
        EXPECT_EQ(before["bands"][band]["checksum"], after["bands"][band]["checksum"]);
    EXPECT_EQ(after["bands"][2]["description"], "probability of being seen, of 20 realisations");
    EXPECT_GE(after["bands"][2]["minimum"].get<double>(), 0.0);
    EXPECT_EQ(after["bands"][2]["maximum"].get<double>(), 1.0);
    // The sum of the shares is what is expected; gdalinfo rounds the mean to 0.001.
    EXPECT_NEAR(after["bands"][2]["mean"].get<double>() * reported["cells"].get<double>(),
                reported["realisations"]["expected_seen"].get<double>(),
                0.0006 * reported["cells"].get<double>());
    EXPECT_EQ(after["metadata"][""]["HEIGHT_ERROR_LE90_M"], "16");
    EXPECT_EQ(before["metadata"][""].count("HEIGHT_ERROR_LE90_M"), 0U);
}

// The file has the data's posts, however fine the realisations are; ground between them hides some.
TEST(ProbableViewshed, OfFinerRealisationsHasTheSamePosts) {
    const fs::path folder = oro::test::scratch_folder();
    const Words words{"--json", "--realisations", "10", "--accuracy", "16"};
    const auto plain = object_said_by(probability_words(folder / "plain.tif", words)),
               finer =
                   object_said_by(probability_words(folder / "finer.tif", joined(words, {"--finer", "2"})));
    EXPECT_EQ(plain["rows"], finer["rows"]);
    EXPECT_EQ(plain["columns"], finer["columns"]);
    EXPECT_EQ(plain["realisations"]["finer"], 1);
    EXPECT_EQ(finer["realisations"]["finer"], 2);
    const double of_plain = plain["realisations"]["expected_seen"].get<double>(),
                 of_finer = finer["realisations"]["expected_seen"].get<double>();
    EXPECT_GT(of_finer, 0.5 * of_plain);
    EXPECT_LT(of_finer, of_plain);
}

// Heights without errors leave one answer: that of the plain viewshed.
TEST(ProbableViewshed, OfExactHeightsIsYesOrNo) {
    const fs::path out = oro::test::scratch_folder() / "exact.tif";
    const auto reported =
        object_said_by(probability_words(out, {"--json", "--realisations", "5", "--accuracy", "0.01"}));
    const double seen = reported["seen"].get<double>();
    EXPECT_GT(seen, 100.0);
    EXPECT_NEAR(reported["realisations"]["expected_seen"].get<double>(), seen, 0.02 * seen);
}

TEST(ProbableViewshed, WordsThatMeanNothingAreOneLine) {
    const fs::path out = oro::test::scratch_folder() / "none.tif";
    const struct {
        Words words;
        std::string says;
    } cases[] = {
        {{"--realisations", "1"}, "--realisations 1: must be between 2 and 10000"},
        {{"--realisations", "nan"}, "--realisations nan: is not a whole number"},
        {{"--realisations", "99999999999"}, "--realisations 99999999999"},
        {{"--realisations", "-7"}, "--realisations -7: must be between 2 and 10000"},
        {{"--realisations", "9"}, "needs --accuracy METRES"},
        {{"--realisations", "9", "--accuracy", "nan"}, "--accuracy nan"},
        {{"--realisations", "9", "--accuracy", "0"}, "--accuracy 0: must be between 0.01 and 1000"},
        {{"--realisations", "9", "--accuracy", "-1"}, "--accuracy -1"},
        {{"--realisations", "9", "--accuracy", "1e300"}, "--accuracy 1e+300"},
        {{"--realisations", "9", "--accuracy", "5", "--correlation", "inf"}, "--correlation inf"},
        {{"--realisations", "9", "--accuracy", "5", "--correlation", "0"}, "--correlation 0"},
        {{"--realisations", "9", "--accuracy", "5", "--seed", "-1"}, "--seed -1"},
        {{"--realisations", "9", "--accuracy", "5", "--finer", "0"}, "--finer 0: must be between 1 and 4"},
        {{"--realisations", "9", "--accuracy", "5", "--finer", "1e9"}, "--finer 1e9"},
        {{"--finer", "2"}, "--finer: needs --realisations"},
        {{"--accuracy", "5"}, "--accuracy: needs --realisations"},
        {{"--correlation", "5"}, "--correlation: needs --realisations"},
        {{"--seed", "5"}, "--seed: needs --realisations"}};
    for (const auto& [words, text] : cases) {
        expect_refusal(run_orograph(probability_words(out, words)), oro::test::usage, {text});
        EXPECT_FALSE(fs::exists(out));
    }
}

Words sight_words(const std::string& to, const Words& more) {
    return joined({"sight", hills, "-q", "--from", "46.25,8.25", "--above", "10", "--to", to}, more);
}

// Of the same posts: what two commands predict from the same data differs by what their numbers of
// realisations leave open, and by roughness that is estimated from other posts. Four standard errors and 0.1.
TEST(ProbableSight, IsWhatAViewshedSaysOfThePost) {
    const fs::path out = oro::test::scratch_folder() / "probable.tif";
    ASSERT_EQ(run_orograph(probability_words(out, {"--realisations", "100", "--accuracy", "16"})).exit_code,
              0);
    int compared = 0, uncertain = 0;
    for (int step = 4; step <= 24; step += 2) {
        char to[40];
        const double lat_deg = 46.25 + step / 1200.0, lon_deg = 8.25 - (step - 6) / 1200.0;
        std::snprintf(to, sizeof to, "%.9f,%.9f", lat_deg, lon_deg);
        const auto band = run_program({"gdallocationinfo", "-valonly", "-b", "3", "-wgs84", out.string(),
                                       std::to_string(lon_deg), std::to_string(lat_deg)});
        if (band.exit_code == 127) GTEST_SKIP() << "needs gdallocationinfo";
        const double share = std::stod(band.out);
        const auto found =
            object_said_by(sight_words(to, {"--json", "--realisations", "100", "--accuracy", "16"}));
        const double probability = found["realisations"]["probability"].get<double>(),
                     error = found["realisations"]["standard_error"].get<double>();
        EXPECT_GT(error, 0.0);
        EXPECT_NEAR(probability, share, 0.1 + 4.0 * error) << to;
        ++compared;
        uncertain += share > 0.05 && share < 0.95;
    }
    EXPECT_EQ(compared, 11);
    EXPECT_GE(uncertain, 3);
}

TEST(ProbableSight, SaysTheSameForASeedAndItsStandardError) {
    const Words words{"--realisations", "50", "--accuracy", "16", "--seed", "3"};
    const auto once = run_orograph(sight_words("46.262,8.243", words)),
               again = run_orograph(sight_words("46.262,8.243", words));
    ASSERT_EQ(once.exit_code, 0);
    EXPECT_EQ(once.out, again.out);
    EXPECT_TRUE(says(once.out, "Probability of being seen: ")) << once.out;
    EXPECT_TRUE(says(once.out, ", standard error 0.")) << once.out;
    EXPECT_TRUE(says(once.out, "50 realisations of heights with an error of 16 m (90 %)")) << once.out;
    EXPECT_FALSE(says(run_orograph(sight_words("46.262,8.243", {})).out, "Probability"));
}

TEST(ProbableSight, WordsThatMeanNothingAreOneLine) {
    expect_refusal(run_orograph(sight_words("46.262,8.243", {"--realisations", "9"})), oro::test::usage,
                   {"needs --accuracy METRES"});
    expect_refusal(run_orograph(sight_words("46.262,8.243", {"--accuracy", "9"})), oro::test::usage,
                   {"--accuracy: needs --realisations"});
    expect_refusal(run_orograph(sight_words("46.262,8.243", {"--realisations", "0", "--accuracy", "9"})),
                   oro::test::usage, {"--realisations 0: must be between 2 and 10000"});
}

}  // namespace
