// made: texts: what they say, what is refused, and the posts of such a source.
#include "geo/sources/made_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include "core/made/made_heights.h"
#include "geo/sources/made_truth.h"
#include "geo/sources/made_words.h"
#include "geo/sources/source_words.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/made_posts.h"

namespace oro {
namespace {

using namespace test;

TEST(MadeWords, SayWhatTheTerrainIs) {
    const auto made = made_terrain_of(
        "made:ridged?seed=7&octaves=5&H=-200.5:4000&spacing=3s&box=179,-17,-179,-16&gain=0.5&feature=1000");
    ASSERT_TRUE(made.ok()) << made.error().line();
    EXPECT_EQ(made->kind, MadeKind::ridged);
    EXPECT_EQ(made->seed, 7U);
    EXPECT_EQ(made->octaves, 5U);
    EXPECT_EQ(made->gain, 500U);
    EXPECT_EQ(made->low, -410624);  // -200.5 * 2048
    EXPECT_EQ(made->high, 8192000);
    EXPECT_EQ(made->posts_per_deg, 1200);
    EXPECT_EQ(made->west, 179 * 1200);
    EXPECT_EQ(made->east, 181 * 1200);
    EXPECT_EQ(made->south, -17 * 1200);
    EXPECT_EQ(made->rows(), 1201);
    EXPECT_EQ(made->columns(), 2401);
    EXPECT_EQ(made->cell_shift, 18U);  // 2^18 / 192 = 1365 m; 2^17 would be 683 m, farther by ratio

    // Boxes that are off the posts go outwards to the next ones.
    const auto off = made_terrain_of("made:fbm?spacing=1min&box=8.01,46.01,8.02,46.02");
    ASSERT_TRUE(off.ok()) << off.error().line();
    EXPECT_EQ(off->west, 480);
    EXPECT_EQ(off->east, 482);
    // Without a word: the Alps' cell, a second apart.
    const auto plain = made_terrain_of("made:fbm");
    ASSERT_TRUE(plain.ok());
    EXPECT_EQ(plain->columns(), 3601);
    EXPECT_EQ(plain->octaves, 9U);
}

const std::vector<const char*> no_terrains{"made:",
                                           "made:foo",
                                           "made:FBM",
                                           "made:fbm?",
                                           "made:fbm?seed=7&",
                                           "made:fbm?&",
                                           "made:fbm?seed",
                                           "made:fbm?=3",
                                           "made:fbm?seed=",
                                           "made:fbm?seed=-1",
                                           "made:fbm?seed=4294967296",
                                           "made:fbm?seed=1.5",
                                           "made:fbm?seed=1e99999",
                                           "made:fbm?seed=7 ",
                                           "made:fbm?seed=0x7",
                                           "made:fbm?octaves=1000000000",
                                           "made:fbm?octaves=0",
                                           "made:fbm?octaves=nan",
                                           "made:fbm?octaves=inf",
                                           "made:fbm?octaves=24",
                                           "made:fbm?feature=1&octaves=9",
                                           "made:fbm?feature=0",
                                           "made:fbm?gain=0.95",
                                           "made:fbm?gain=nan",
                                           "made:fbm?H=3",
                                           "made:fbm?H=nan:3",
                                           "made:fbm?H=4000:-200",
                                           "made:fbm?H=0:0",
                                           "made:fbm?H=0:9000",
                                           "made:fbm?H=-inf:0",
                                           "made:fbm?H=1:2:3",
                                           "made:fbm?seed=1&seed=2",
                                           "made:fbm?colour=red",
                                           "made:fbm?azimuth=3",
                                           "made:plane?seed=3",
                                           "made:plane?azimuth=360",
                                           "made:sine?length=0",
                                           "made:cone?radius=1e99",
                                           "made:cone?radius=0",
                                           "made:sphere?radius=1000001",
                                           "made:fbm?box=8,46,8,47",
                                           "made:fbm?box=8,47,9,46",
                                           "made:fbm?box=1,2,3",
                                           "made:fbm?box=8,46,nan,47",
                                           "made:fbm?box=0,0,9,91",
                                           "made:fbm?box=0,0,181,1",
                                           "made:fbm?box=",
                                           "made:fbm?spacing=0.7s",
                                           "made:fbm?spacing=0s",
                                           "made:fbm?spacing=-1s",
                                           "made:fbm?spacing=1",
                                           "made:fbm?spacing=1m",
                                           "made:fbm?spacing=1e308s",
                                           "made:fbm?spacing=1e-300s",
                                           "made:fbm?spacing=nans",
                                           "made:fbm?spacing=s",
                                           "made:fbm?spacing=2deg"};

TEST(MadeWords, WhatIsNoTerrainIsRefusedInOneLine) {
    for (const char* text : no_terrains) {
        const auto made = made_terrain_of(text);
        ASSERT_FALSE(made.ok()) << text;
        EXPECT_EQ(made.error().kind, ErrorKind::usage) << text;
        EXPECT_EQ(made.error().where, text);
        EXPECT_EQ(made.error().line().find('\n'), std::string::npos) << text;
        EXPECT_GT(made.error().what.size(), 10U) << text;
    }
}

// Values of keys: some that somebody would write, and hostile ones.
const std::vector<std::string> any_values{"1",
                                          "7",
                                          "9",
                                          "0.5",
                                          "1000",
                                          "-200:4000",
                                          "0:1",
                                          "3s",
                                          "1s",
                                          "0.1deg",
                                          "2min",
                                          "8,46,9,47",
                                          "45",
                                          "",
                                          "nan",
                                          "NaN",
                                          "-nan",
                                          "inf",
                                          "-inf",
                                          "1e308",
                                          "-1e308",
                                          "1e309",
                                          "1e-320",
                                          "1000000000",
                                          "-1",
                                          "0",
                                          "99999999999999999999999999",
                                          "-99999999999999999999",
                                          "0x10",
                                          "1,2",
                                          "1:2:3",
                                          "nan:nan",
                                          "-inf:inf",
                                          "8192:8193",
                                          "-9000:9000",
                                          ":",
                                          ",,,",
                                          "8,46,nan,47",
                                          "-1e9,-1e9,1e9,1e9",
                                          "181,91,182,92",
                                          "0,0,0,0",
                                          "-180,-90,180,90",
                                          "1s1s",
                                          "s",
                                          "infs",
                                          "1e-300s",
                                          "\n",
                                          "a\nb",
                                          "\t",
                                          "\x7f",
                                          "\xff\xfe",
                                          "%00",
                                          "..",
                                          "/etc/passwd",
                                          "=",
                                          "==",
                                          "&",
                                          "?",
                                          "\"",
                                          "'",
                                          "1 ",
                                          " 1",
                                          "+1",
                                          "1.",
                                          ".5",
                                          "1e",
                                          "\xe2\x80\xae"};
std::string any_value(std::mt19937& random) {
    return any_values[random() % any_values.size()];
}
// By a grammar: made: KIND [? KEY=VALUE [& KEY=VALUE ...]], each part now and then another one than it
// should.
std::string any_text(std::mt19937& random) {
    static const std::vector<std::string> kinds{
        "fbm", "ridged", "plane", "cone", "sine", "step", "sphere", "checker", "", "FBM", "fb", "nan", "\n"};
    static const std::vector<std::string> keys{"seed",   "octaves", "gain",    "feature", "azimuth", "length",
                                               "radius", "H",       "spacing", "box",     "",        "h",
                                               "Seed",   "octave",  "\n",      "%",       "seed\n"};
    std::string text = "made:" + kinds[random() % (random() % 4 == 0 ? kinds.size() : 8)];
    const std::uint64_t count = random() % 5;
    for (std::uint64_t i = 0; i < count; ++i) {
        text += i == 0 ? "?" : "&";
        text += keys[random() % (random() % 6 == 0 ? keys.size() : 10)];
        if (random() % 20 != 0) text += "=";
        text += any_value(random);
    }
    if (random() % 30 == 0) text += "&";
    if (random() % 200 == 0) text += std::string(70000, '9');
    return text;
}

// 30,000 texts by that grammar: each is a terrain within the bounds that it promises, or one clear line.
TEST(MadeWords, AnyTextByTheGrammarIsATerrainOrOneLine) {
    constexpr unsigned seed = 20261129;
    std::mt19937 random(seed);
    int refused = 0;
    for (int i = 0; i < 30000; ++i) {
        const std::string text = any_text(random);
        const auto made = made_terrain_of(text);
        if (!made.ok()) {
            ++refused;
            EXPECT_EQ(made.error().kind, ErrorKind::usage) << text;
            const std::string line = made.error().line();
            EXPECT_TRUE(std::ranges::none_of(line, [](char c) { return (c >= 0 && c < 32) || c == 127; }))
                << line;
            EXPECT_GT(made.error().what.size(), 10U) << text;
            continue;
        }
        EXPECT_LT(made->low, made->high) << text;
        EXPECT_GE(made->low, -8192 * 2048) << text;
        EXPECT_LE(made->high, 8192 * 2048) << text;
        EXPECT_GE(made->octaves, 1U) << text;
        EXPECT_LE(made->octaves, 24U) << text;
        EXPECT_GE(made->posts_per_deg, 1) << text;
        EXPECT_GE(made->south, -90 * made->posts_per_deg) << text;
        EXPECT_LE(made->north, 90 * made->posts_per_deg) << text;
        EXPECT_GE(made->north - made->south, 1) << text;
        EXPECT_GE(made->east - made->west, 1) << text;
        EXPECT_LE(made->east - made->west, 360 * made->posts_per_deg) << text;
        // A post of it: whatever else it says, made_rule and the rule hold.
        const gpu::MadeRule rule = made_rule(*made);
        std::vector<std::int32_t> steps(1);
        made_row_heights(*made, rule, 0, 0, made_columns(*made, 0, 1), steps);
        EXPECT_GE(steps[0], made->low) << text;
        EXPECT_LE(steps[0], made->high) << text;
    }
    EXPECT_GT(refused, 10000) << "seed " << seed;
    EXPECT_LT(refused, 29000) << "seed " << seed;
}

TEST(MadeSource, ItsPostsAreTheRegionsPosts) {
    const std::string text = "made:fbm?seed=7&H=-200:4000&spacing=1s&box=8,46,8.2775,46.2775";
    const auto region = opened(request_for({text}));
    ASSERT_TRUE(region);
    const std::vector<std::int32_t> steps = heights_of(made_example(MadeKind::fbm));
    ASSERT_EQ(region->field.grid.rows(), 1000);
    ASSERT_EQ(region->field.grid.columns(), 1000);
    for (int row = 0; row < 1000; ++row)
        for (int column = 0; column < 1000; ++column)
            ASSERT_EQ(region->field.H_at_post_m(row, column),
                      steps[static_cast<std::size_t>(row * 1000 + column)] / 2048.0);
    ASSERT_EQ(region->sources.size(), 1U);
    EXPECT_EQ(format_words(region->sources[0]), "made, not measured");
    EXPECT_EQ(region->sources[0].path, text);
    EXPECT_EQ(datum_words(region->sources[0].vertical_datum), "EGM96 height (made so)");
    EXPECT_EQ(placement_words(region->sources[0]), "posts copied");
    EXPECT_EQ(region->sources[0].voids, 0U);
}

// A part by --bbox has the posts that the whole has.
TEST(MadeSource, APartHasThePostsOfTheWhole) {
    const std::string text = "made:ridged?seed=3&spacing=3s&box=178,-1,-178,1";
    RegionRequest request = request_for({text});
    const auto whole = opened(request);
    request.box = BoundingBox{179.5, -0.5, -179.5, 0.5};
    const auto part = opened(request);
    ASSERT_TRUE(whole && part);
    EXPECT_EQ(part->field.grid.columns(), 1201);
    for (int row = 0; row < part->field.grid.rows(); row += 7)
        for (int column = 0; column < part->field.grid.columns(); column += 5)
            ASSERT_EQ(part->field.H_at_post_m(row, column),
                      whole->field.H_at_post_m(row + 600, column + 1800));
}

TEST(MadeSource, AWholeWorldGoesRoundTheEarth) {
    const auto region = opened(request_for({"made:fbm?spacing=30min&box=-180,-90,180,90&feature=2000000"}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->field.grid.rows(), 361);
    EXPECT_EQ(region->field.grid.columns(), 721);
    EXPECT_TRUE(region->field.grid.wraps_longitude());
    for (int row = 0; row < 361; ++row)
        EXPECT_EQ(region->field.H_at_post_m(row, 0), region->field.H_at_post_m(row, 720));
    for (int column = 1; column < 721; ++column)
        EXPECT_EQ(region->field.H_at_post_m(0, column), region->field.H_at_post_m(0, 0));
}

// A file of that name is reached by ./made:..., and made terrain lies beside files.
TEST(MadeSource, IsNoFile) {
    const auto found = find_sources({"made:fbm"});
    ASSERT_TRUE(found.ok());
    ASSERT_EQ(found->size(), 1U);
    EXPECT_TRUE(found->front().named);
    EXPECT_FALSE(find_sources({"./made:fbm"}).ok());
}

// At posts the rule is the data, to 2^-11 m and the rounding of places. Of several sources there is none.
TEST(MadeTruth, IsTheDataAtPosts) {
    SourcePath path;
    path.file = path.shown = "made:fbm?seed=7&H=-200:4000&spacing=3s&box=8,46,8.1,46.1";
    const auto source = inspect_made(path);
    ASSERT_TRUE(source.ok()) << source.error().line();
    const SourceReport report = source->report;
    const auto truth = MadeTruth::of(std::span(&report, 1));
    ASSERT_TRUE(truth.has_value());
    const auto block = read_made(source.value(), {0, 0, 40, 50});
    ASSERT_TRUE(block.ok());
    const PostWindow& window = block->window;
    double worst_m = 0.0;
    for (int row = 0; row < window.rows; ++row)
        for (int column = 0; column < window.columns; ++column)
            worst_m = std::max(
                worst_m,
                std::abs(truth->H_m(46.1 - row / 1200.0, 8.0 + column / 1200.0) -
                         static_cast<double>(
                             block->height_m[static_cast<std::size_t>(row * window.columns + column)])));
    EXPECT_LT(worst_m, 0.05);  // places to 2^-6 m on slopes up to 3
    const SourceReport two[] = {report, report};
    EXPECT_FALSE(MadeTruth::of(two).has_value());
    SourceReport other = report;
    other.path = "N46E008.hgt";
    EXPECT_FALSE(MadeTruth::of(std::span(&other, 1)).has_value());
}

}  // namespace
}  // namespace oro
