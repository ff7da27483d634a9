// What `plan` says before and after its table: where the eye is, and how good the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
using nlohmann::json;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::Words;

Outcome reported_plan(const Words& more) {
    const auto land = oro::test::bundled_data() / "jacksboro.tif";
    Words words{"plan",      "--all", land,      "--at", "36.6,-84.2", "--above", "300",
                "--heading", "200.5", "--pitch", "-5",   "--size",     "96x54"};
    words.insert(words.end(), more.begin(), more.end());
    return run_orograph(words);
}

TEST(Plan, BeginsWithTheEye) {
    const auto eye_of = [](const Words& more) {
        const auto land = oro::test::bundled_data() / "jacksboro.tif";
        Words words{"plan", land, "--size", "96x54"};
        words.insert(words.end(), more.begin(), more.end());
        const std::string text = run_orograph(words).out;
        return text.substr(0, text.find('\n'));
    };
    EXPECT_EQ(eye_of({"--at", "36.6,-84.2", "--above", "300", "--heading", "200.5", "--pitch", "-5"}),
              "Eye: 36.600000 -84.200000, H 688 m, 300 m above the ground, towards 200.5 degrees (SSW).");
    EXPECT_EQ(eye_of({"--at", "36.6,-90.5", "--altitude", "12345", "--heading", "360", "--pitch", "-5"}),
              "Eye: 36.600000 -90.500000, H 12,345 m, towards 0 degrees (N).");
}

// The effective k: that of the air which is taken for true.
TEST(Plan, SaysHowLightGoes) {
    EXPECT_TRUE(says(reported_plan({"--accuracy", "survey"}).out, "\nLight: k 0.12 at the eye's h of "));
    EXPECT_TRUE(says(reported_plan({"--accuracy", "survey"}).out, " m (standard air).\n"));
    EXPECT_TRUE(says(reported_plan({}).out, " m (standard air); in this picture it goes straight.\n"));
    EXPECT_TRUE(says(reported_plan({"--refraction", "0.2"}).out, "\nLight: k 0.2 at all heights.\n"));
    const json light = json::parse(reported_plan({"--json", "-q", "--refraction", "0.2"}).out).at("light");
    EXPECT_EQ(light.at("k"), 0.2);
    EXPECT_EQ(light.at("air"), "constant");
    // An eye in space bends no light by itself: refraction left out costs nothing there.
    const json high =
        json::parse(run_orograph({"plan", oro::test::bundled_data() / "jacksboro.tif", "--at", "36.6,-84.2",
                                  "--above", "400000", "--pitch", "-90", "--size", "32x18", "--json", "-q"})
                        .out);
    EXPECT_LT(high.at("light").at("k").get<double>(), 1e-20);
    for (const json& effect : high.at("effects")) {
        if (effect.at("kind") == "refraction") {
            EXPECT_LT(effect["size"]["worst_px"].get<double>(), 1e-9);
        }
    }
}

// Found: "no" in the table for 1.03 px, and "Good to 1 px." below it.
TEST(Plan, TheLastLineIsOnTheTablesSideOfTheTolerance) {
    const json said = json::parse(reported_plan({"--json", "-q", "--accuracy", "draft"}).out);
    const double worst_px = said.at("total").at("worst_px").get<double>();
    for (const double off : {-0.003, 0.003}) {
        char tolerance[40];
        std::snprintf(tolerance, sizeof tolerance, "%.4f", worst_px + off);
        const std::string text = reported_plan({"--accuracy", "draft", "--tolerance", tolerance}).out;
        const std::size_t at = text.find("\nGood to ") + 9;
        const double shown_px = std::stod(text.substr(at));
        EXPECT_EQ(shown_px > std::stod(tolerance), off < 0.0) << text;
        EXPECT_TRUE(says(text.substr(at), off < 0.0 ? " px where the data reach: more than the tolerance of "
                                                    : " px where the data reach: within the tolerance of "))
            << text;
    }
}

// Some twelve lines say how accurate the picture will be, and why; --all says the same of it, and more.
TEST(Plan, FirstSaysHowGoodThePictureIsAndWhy) {
    const auto land = oro::test::bundled_data() / "jacksboro.tif";
    const Outcome brief = run_orograph({"plan", land, "--at", "36.6,-84.2", "--above", "300", "--heading",
                                        "200.5", "--pitch", "-5", "--size", "96x54"});
    EXPECT_EQ(brief.exit_code, 0) << brief.err;
    const auto lines = std::count(brief.out.begin(), brief.out.end(), '\n');
    EXPECT_GE(lines, 10) << brief.out;
    EXPECT_LE(lines, 15) << brief.out;
    for (const char* const words : {"Eye: 36.600000 -84.200000", "\nGround in view: ", "\nGood to ",
                                    "\nLargest errors ", " of the data\n", "\n--all lists every effect"})
        EXPECT_TRUE(says(brief.out, words)) << words << "\n" << brief.out;
    EXPECT_FALSE(says(brief.out, "left out by")) << brief.out;
    const std::string all = reported_plan({}).out;
    const auto good = [](const std::string& text) {
        const std::size_t at = text.find("\nGood to ");
        return text.substr(at, text.find('\n', at + 1) - at);
    };
    EXPECT_EQ(good(brief.out), good(all));
    // The first row is the largest error, which the table marks.
    const std::size_t row = brief.out.find('\n', brief.out.find("Largest errors ")) + 1;
    const std::string first = brief.out.substr(row, brief.out.find("  ", row) - row);
    const std::size_t mark = all.find("\n  ^ largest error of this picture");
    ASSERT_NE(mark, std::string::npos) << all;
    const std::size_t begin = all.rfind('\n', mark - 1) + 1;
    EXPECT_EQ(all.substr(begin, first.size()), first) << all;
}

TEST(Plan, QuietLeavesTheTableAlone) {
    const Outcome outcome = reported_plan({"-q"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(says(outcome.out, "full detail")) << outcome.out;
    EXPECT_EQ(reported_plan({}).out, outcome.out);
}

}  // namespace
