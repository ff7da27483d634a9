// Ground that is not loaded: what shot, shot --verify, compare and plan tell of it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
using nlohmann::json;
using oro::test::bundled;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::Words;

std::string line_with(const std::string& text, const std::string& words) {
    const std::size_t at = text.find(words);
    if (at == std::string::npos) return {};
    const std::size_t before = text.rfind('\n', at);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    return text.substr(begin, text.find('\n', at) - begin);
}

// What all four tell of a view.
struct Reported {
    std::string note;      // of shot
    std::string verified;  // of shot --verify
    std::string compared;
    std::string planned;  // the whole table
    json shot, comparison, plan;
};
Reported reported_of(const Words& data, const Words& view, const Words& more = {}) {
    const std::string picture = (oro::test::scratch_folder() / "p.png").string();
    const Words out = joined({"--overwrite", "--out", picture}, more);
    const auto run = [](const Words& words) {
        Outcome outcome = run_orograph(words);
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return outcome;
    };
    Reported reported;
    const Outcome shot = run(joined(joined(joined({"shot", "--json"}, data), view), out));
    reported.note = line_with(shot.err, "past the data");
    reported.shot = json::parse(shot.out).at("unseen");
    const Outcome verified = run(joined(joined(joined({"shot", "--verify"}, data), view), out));
    reported.verified = line_with(verified.err, "past the data");
    EXPECT_FALSE(says(reported.verified, "note: ")) << verified.err << "said twice";
    const Outcome compared = run(joined({"compare", picture, "--json"}, more));
    reported.compared = line_with(compared.err, "past the data");
    reported.comparison = json::parse(compared.out).at("unseen");
    reported.planned = run(joined(joined(joined({"plan", "--all"}, data), view), more)).out;
    reported.plan =
        json::parse(run(joined(joined(joined({"plan", "--json"}, data), view), more)).out).at("unseen");
    return reported;
}

// From 1,500 m above 46.5 N 9.95 E, eastwards: with N46E010 the skyline lies 182 px higher in the mean, in
// 640 of 640 columns (tests/geo/region/unseen_tiles_test.cpp).
TEST(Unseen, TheTileThatIsMissingIsNamedWithItsBound) {
    const auto tile = oro::test::real_data("alps/N46E009.SRTMGL3.hgt.zip");
    if (!tile) GTEST_SKIP() << "needs alps/N46E009";
    const Reported reported =
        reported_of({tile->string()}, {"--at", "46.5,9.95", "--above", "1500", "--heading", "90", "--pitch",
                                       "-10", "--fov", "50", "--size", "640x400"});
    for (const json& unseen : {reported.shot, reported.comparison, reported.plan}) {
        EXPECT_EQ(unseen.at("columns"), 640);
        EXPECT_EQ(unseen.at("columns_beyond"), 640);
        EXPECT_GE(unseen.at("bound_px").get<double>(), 182.0);
        EXPECT_EQ(unseen.at("missing"), json::array({"N46E010"}));
        EXPECT_EQ(unseen.at("ceiling_m"), 9000.0);
        EXPECT_EQ(unseen, reported.shot);
    }
    const std::string px = std::to_string(reported.plan.at("bound_px").get<int>());
    const std::string words =
        "the view reaches past the data in 640 of 640 columns (missing: N46E010): terrain there, if it is up "
        "to 9,000 m high, could rise up to " +
        px + " px above what is drawn";
    EXPECT_EQ(reported.note,
              "orograph: note: the view reaches past the data in 640 of 640 columns (missing: N46E010): "
              "ground up to "
              "9,000 m high there could rise up to " +
                  px + " px above what is drawn; give these tiles, too, or --fetch skadi gets them");
    EXPECT_EQ(reported.verified, "Where the data end: " + words);
    EXPECT_EQ(reported.compared, reported.verified);
    EXPECT_TRUE(says(reported.planned,
                     " px where the data reach: within the tolerance of 1 px.\nIn 640 of 640 columns "
                     "ground beyond the data could be up to " +
                         px + " px higher (missing: N46E010).\n"))
        << reported.planned;
    const std::string row = line_with(reported.planned, "ground beyond the data   ");
    EXPECT_TRUE(says(row, " " + px + " ") && says(row, "in 640 of 640 columns")) << row;
}

TEST(Unseen, TheBundledRegionEndsToo) {
    const Words view{"--at", "36.6,-84.2", "--above", "300", "--heading", "200", "--size", "200x100"};
    const Reported reported = reported_of({bundled()}, view);
    EXPECT_EQ(reported.shot.at("columns"), 200);
    EXPECT_EQ(reported.shot.at("columns_beyond"), 200);
    EXPECT_EQ(reported.shot.at("missing"), json::array({"N36W085"}));
    EXPECT_EQ(reported.shot, reported.plan);
    EXPECT_EQ(reported.shot, reported.comparison);
    EXPECT_TRUE(
        says(reported.note, "note: the view reaches past the data in 200 of 200 columns (missing: N36W085)"))
        << reported.note;
    EXPECT_EQ(reported.verified, reported.compared);
    // Whoever knows how high the ground is near there knows more.
    const Reported lower = reported_of({bundled()}, view, {"--unseen-ceiling", "1200"});
    EXPECT_TRUE(says(lower.note, "up to 1,200 m")) << lower.note;
    EXPECT_LT(lower.shot.at("bound_px").get<double>(), reported.shot.at("bound_px").get<double>());
    EXPECT_EQ(lower.shot, lower.comparison);
}

// Found: cells that are loaded were "missing" beyond --bbox.
TEST(Unseen, APartThatWasChosenEndsAndMissesNothing) {
    const Words part{bundled(), "--bbox", "-84.3,36.45,-84.15,36.55"};
    const Reported reported =
        reported_of(part, {"--at", "36.5,-84.2", "--above", "300", "--heading", "200", "--size", "200x100"});
    EXPECT_EQ(reported.note + reported.verified + reported.compared, "");
    for (const json& unseen : {reported.shot, reported.comparison, reported.plan}) {
        EXPECT_EQ(unseen.at("columns_beyond"), 0);
        EXPECT_EQ(unseen.at("missing"), json::array());
        EXPECT_EQ(unseen.at("chosen_part_ends").at("columns_beyond"), 200);
        EXPECT_EQ(unseen.at("chosen_part_ends").at("cells"), json::array({"N36W085"}));
        EXPECT_GT(unseen.at("chosen_part_ends").at("bound_px").get<double>(), 0.0);
        EXPECT_EQ(unseen, reported.shot);
    }
    EXPECT_TRUE(
        says(reported.planned,
             "\nThe part of the data that you chose ends here: in 200 of 200 columns ground beyond it"))
        << reported.planned;
    EXPECT_FALSE(says(reported.planned, "missing")) << reported.planned;
    // A box that is larger than the data leaves them ending where they end.
    const Reported larger =
        reported_of({bundled(), "--bbox", "-86,35,-83,38"},
                    {"--at", "36.5,-84.2", "--above", "300", "--heading", "200", "--size", "64x32"});
    EXPECT_TRUE(says(larger.note, "past the data in 64 of 64 columns (missing: N36W085)")) << larger.note;
}

// Found: every overview said "up to 720 px higher".
TEST(Unseen, APictureOfAllTheDataSaysNothing) {
    for (const Words& data : {Words{bundled()}, Words{bundled(), "--bbox", "-84.3,36.45,-84.15,36.55"}}) {
        const Reported reported = reported_of(data, {"--size", "128x72"});
        EXPECT_EQ(reported.note + reported.verified + reported.compared, "");
        EXPECT_EQ(reported.plan.at("all_data_in_view"), true);
        EXPECT_FALSE(says(reported.planned, " px higher") || says(reported.planned, "ground beyond"))
            << reported.planned;
        EXPECT_TRUE(
            says(reported.planned, "All of the data are in the picture, which shows where they end."));
    }
}

TEST(Unseen, NothingIsSaidWhereAllLinesEndOnData) {
    const Reported reported = reported_of(
        {bundled()}, {"--at", "36.6,-84.2", "--above", "300", "--pitch", "-90", "--size", "100x100"});
    EXPECT_EQ(reported.note + reported.verified + reported.compared, "");
    EXPECT_FALSE(says(reported.planned, "beyond the data") || says(reported.planned, "where the data reach"))
        << reported.planned;
    EXPECT_EQ(reported.plan.at("columns_beyond"), 0);
    EXPECT_EQ(reported.plan.at("bound_px"), 0.0);
    EXPECT_EQ(reported.plan.at("missing"), json::array());
}

TEST(Unseen, ACeilingOutOfRangeIsRefused) {
    expect_refusal(run_orograph({"plan", bundled(), "--at", "36.6,-84.2", "--unseen-ceiling", "200000"}), 2,
                   {"--unseen-ceiling", "200000"});
    expect_refusal(run_orograph({"plan", bundled(), "--at", "36.6,-84.2", "--unseen-ceiling", "nan"}), 2,
                   {"--unseen-ceiling"});
}

}  // namespace
