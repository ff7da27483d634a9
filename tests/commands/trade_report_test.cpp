// What a trade writes: sums, the settings that nothing beats, the table of values and the terminal's text.
#include "apps/trade/trade_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "apps/report/base64.h"
#include "apps/trade/trade_page.h"
#include "apps/trade/trade_parts.h"
#include "tests/commands/trade_page.h"

namespace oro {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// A setting for each number.
TradeKey level(double tau_px) {
    return {EffectKind::detail, tau_px, {}};
}

TradeShot shot(const std::string& view, const TradeKey& setting, double gpu_ms, double px) {
    TradeShot made;
    made.view = view;
    made.setting = setting;
    made.first = {gpu_ms, 1000};
    made.settled = {0.5 * gpu_ms, 400};
    made.bytes = 250000;
    made.displacement_m = {10.0 * px, 8.0 * px, 4.0 * px, px, 100};
    made.displacement_px = {px, 0.75 * px, 0.5 * px, 0.25 * px, 100};
    made.skyline_px = {2.0 * px, 2.0 * px, px, 0.5 * px, 16};
    return made;
}

std::vector<TradeKey> front_of(const TradeReport& report) {
    std::vector<TradeKey> keys;
    for (const TradeSetting& setting : report.settings)
        if (setting.on_front) keys.push_back(setting.key);
    return keys;
}

TEST(TradeReport, SumsSettingsOverTheViews) {
    TradeReport report;
    report.shots = {shot("a", level(1), 3.0, 0.5), shot("a", level(2), 1.0, 1.5),
                    shot("b", level(1), 1.0, 1.0), shot("b", level(2), 2.0, 2.0),
                    shot("c", level(1), 2.0, 0.75)};
    TradeSetting known;
    known.key = level(2);
    known.options = "--tau 2";
    known.limit_px = 2.0;
    known.displacement_px = 99.0;
    report.settings = {known};
    sum_up(report);
    ASSERT_EQ(report.settings.size(), 2U);
    const TradeSetting& one = report.settings[0];
    EXPECT_EQ(one.key, level(1));
    EXPECT_EQ(one.options, "");
    EXPECT_EQ(one.first.gpu_ms, 2.0);  // of 1, 2, 3
    EXPECT_EQ(one.first.triangles, 3000U);
    EXPECT_EQ(one.settled.gpu_ms, 1.0);  // of 0.5, 1, 1.5
    EXPECT_EQ(one.settled.triangles, 1200U);
    EXPECT_EQ(one.bytes, 750000U);
    EXPECT_EQ(one.displacement_m, 10.0);
    EXPECT_EQ(one.displacement_px, 1.0);
    EXPECT_EQ(one.displacement_p99_px, 0.5);
    EXPECT_EQ(one.displacement_mean_px, 0.1875);  // (0.125 + 0.25 + 0.1875) / 3
    EXPECT_EQ(one.skyline_px, 2.0);
    EXPECT_EQ(one.displacement_pixels, 300U);
    EXPECT_EQ(one.skyline_columns, 48U);
    const TradeSetting& two = report.settings[1];
    EXPECT_EQ(two.options, "--tau 2");
    EXPECT_EQ(two.limit_px, 2.0);
    EXPECT_EQ(two.first.gpu_ms, 1.5);  // of 1, 2
    EXPECT_EQ(two.displacement_px, 2.0);
}

TEST(TradeReport, TheFrontHoldsWhatNothingBeats) {
    TradeReport report;
    const TradeKey fast = level(1), even = level(2), beaten = level(3), close = level(4),
                   close_too = level(5), close_slower = level(6), even_farther = level(7);
    report.shots = {shot("v", fast, 1.0, 8.0),        shot("v", even, 2.0, 4.0),
                    shot("v", beaten, 3.0, 5.0),      shot("v", close, 4.0, 1.0),
                    shot("v", close_too, 4.0, 1.0),   shot("v", close_slower, 5.0, 1.0),
                    shot("v", even_farther, 2.0, 4.5)};
    sum_up(report);
    EXPECT_EQ(front_of(report), (std::vector<TradeKey>{fast, even, close, close_too}));
}

// A summary of nothing is all 0: that is not the closest picture of all.
TEST(TradeReport, WhatWasNotMeasuredIsNotOnTheFront) {
    TradeReport report;
    const TradeKey real = level(1), blank = level(2), broken = level(3);
    report.shots = {shot("v", real, 2.0, 1.0), shot("v", blank, 1.0, 0.0), shot("v", broken, 0.5, no_number),
                    shot("w", broken, 0.5, 0.1)};
    report.shots[1].displacement_px = report.shots[1].displacement_m = {};
    sum_up(report);
    EXPECT_EQ(front_of(report), std::vector<TradeKey>{real});
    EXPECT_TRUE(std::isnan(report.settings[2].displacement_px)) << "a good view hid a bad one";
}

TEST(TradeReport, CsvIsRfc4180WithAllDigits) {
    TradeReport report;
    report.shots = {shot("far, over \"the\" Alps", level(1), 0.1, 0.5),
                    shot("b", {EffectKind::flat, {}, {}}, 1.0 / 3.0, 256.0)};
    report.shots[1].skyline_px = {};
    report.shots[1].skyline_in_one_only = 7;
    report.shots[1].displacement_px.at_least = 3;
    EXPECT_EQ(
        trade_csv(report),
        "view,setting,first_gpu_ms,first_triangles,settled_gpu_ms,settled_triangles,bytes,"
        "displacement_m_max,displacement_m_p9999,displacement_m_p99,displacement_m_mean,displacement_m_count,"
        "displacement_m_at_least,"
        "displacement_px_max,displacement_px_p9999,displacement_px_p99,displacement_px_mean,displacement_px_"
        "count,"
        "displacement_px_at_least,"
        "surface_px_max,surface_px_p9999,surface_px_p99,surface_px_mean,surface_px_count,"
        "surface_px_at_least,"
        "seen_px_max,seen_px_p9999,seen_px_p99,seen_px_mean,seen_px_count,"
        "seen_px_at_least,"
        "skyline_px_max,skyline_px_p9999,skyline_px_p99,skyline_px_mean,skyline_px_count,"
        "skyline_px_at_least,"
        "skyline_in_one_only\r\n"
        "\"far, over \"\"the\"\" Alps\",tau 1,0.1,1000,0.05,400,250000,"
        "5,4,2,0.5,100,0,0.5,0.375,0.25,0.125,100,0,0,0,0,0,0,0,0,0,0,0,0,0,1,1,0.5,0.25,16,0,0\r\n"
        "b,no curve of the Earth,0.3333333333333333,1000,0.16666666666666666,400,250000,"
        "2560,2048,1024,256,100,0,256,192,128,64,100,3,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,7\r\n");
}

TEST(TradeReport, FiguresHaveTheDigitsThatMatter) {
    EXPECT_EQ(figure(0.0), "0");
    EXPECT_EQ(figure(0.01234), "0.012");
    EXPECT_EQ(figure(1.26), "1.3");
    EXPECT_EQ(figure(12.44), "12.4");
    EXPECT_EQ(figure(316.2), "316");
    EXPECT_EQ(figure(-316.2), "-316");
    EXPECT_EQ(figure(9922.0), "9922");
    EXPECT_EQ(figure(0.0000423), "4.2e-5");
    EXPECT_EQ(figure(0.00009999), "1.0e-4");
    EXPECT_EQ(figure(36000000.0), "3.6e7");
    EXPECT_EQ(figure(no_number), "n/a");
    EXPECT_EQ(figure(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(figure(std::nullopt), "n/a");
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(12345678), "12,345,678");
}

TEST(TradeReport, FiguresBesideALimitStayOnTheirSide) {
    EXPECT_EQ(about_near(1.0, 1.03), "1.03");
    EXPECT_EQ(about_near(1.0, 1.0004), "1.0004");
    EXPECT_EQ(about_near(1.26, 1.256), "1.26");
    EXPECT_EQ(about_near(1.254, 1.2533), "1.25");
    EXPECT_EQ(about_near(1.0, 2.14), "2.1");
    EXPECT_EQ(about_near(1.0, 0.0), "0");
    EXPECT_EQ(coarse_figure(0.0004), "<0.001");
    EXPECT_EQ(coarse_figure(0.0), "0");
    EXPECT_EQ(metres(297974.2), "297,974");
    EXPECT_EQ(metres(2490.3), "2490");
    EXPECT_EQ(metres(2.0), "2");
    EXPECT_EQ(metres(-36.44), "-36.4");
    EXPECT_EQ(metres(0.354), "0.35");
}

// RFC 4648, 10.
TEST(TradeReport, Base64) {
    const auto of = [](const std::string& text) {
        return base64(std::vector<std::uint8_t>(text.begin(), text.end()));
    };
    EXPECT_EQ(of(""), "");
    EXPECT_EQ(of("f"), "Zg==");
    EXPECT_EQ(of("fo"), "Zm8=");
    EXPECT_EQ(of("foo"), "Zm9v");
    EXPECT_EQ(of("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64(std::vector<std::uint8_t>{0xFB, 0xFF, 0xFE}), "+//+");
}

TEST(TradeReport, TextThatIsNoneIsReplaced) {
    EXPECT_EQ(valid_text("Z\xC3\xBCrich \xF0\x9F\x8F\x94"), "Z\xC3\xBCrich \xF0\x9F\x8F\x94");
    EXPECT_EQ(valid_text("a\xFF"
                         "b\xC3"),
              "a\xEF\xBF\xBD"
              "b\xEF\xBF\xBD");
    EXPECT_EQ(valid_text("\x1B[31m"), "\xEF\xBF\xBD[31m");                          // a terminal would obey
    EXPECT_EQ(valid_text("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // overlong
    EXPECT_EQ(valid_text("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // a surrogate
}

TEST(TradeReport, EffectsSayTheWorstAndTheirRatios) {
    const TradeKey sphere{EffectKind::sphere, {}, {}};
    TradeReport report;
    report.effects = {{"a", sphere, 100.0, 10.0, 50.0, 8.0},
                      {"b", sphere, 40.0, 2.0, 10.0, 4.0},
                      {"a", {EffectKind::source, {}, {}}, 16.0, 9.0, {}, {}, EffectMeasure::stated},
                      {"b", sphere, 0.0, 0.0, 0.0, 0.0}};
    const std::vector<EffectWorst> effects = worst_effects(report);
    ASSERT_EQ(effects.size(), 2U);
    EXPECT_EQ(effects[0].predicted_m, 100.0);
    EXPECT_EQ(effects[0].measured_m, 50.0);
    EXPECT_EQ(effects[0].measured_px, 8.0);
    EXPECT_EQ(effects[0].ratio_m->least, 2.0);
    EXPECT_EQ(effects[0].ratio_m->most, 4.0);
    EXPECT_EQ(effects[0].ratio_px->least, 0.5);
    EXPECT_EQ(effects[0].ratio_px->most, 1.25);
    EXPECT_EQ(effects[0].measured_by, EffectMeasure::picture);
    EXPECT_EQ(effects[1].measured_by, EffectMeasure::stated);
    EXPECT_EQ(effects[0].broken_in, std::vector<std::string>{"b"});
    EXPECT_FALSE(effects[1].measured_m);
    EXPECT_FALSE(effects[1].ratio_px);
    const std::string text = trade_text(report);
    EXPECT_NE(text.find("MORE THAN PREDICTED in 1 of 3"), std::string::npos) << text;
    EXPECT_NE(text.find("stated by the source"), std::string::npos) << text;
    report.effects = {{"a", sphere, 1.0, 1.0, 0.0004, 8.0}};
    const std::string one = trade_text(report);
    EXPECT_NE(one.find("MORE THAN PREDICTED in the one view"), std::string::npos) << one;
    EXPECT_NE(one.find("<0.001"), std::string::npos) << one;
}

TEST(TradeReport, ABoundThatIsNoNumberHoldsNothing) {
    const TradeKey sphere{EffectKind::sphere, {}, {}};
    TradeReport report;
    report.effects = {{"a", sphere, no_number, no_number, 50.0, 8.0}, {"b", sphere, 100.0, 10.0, 50.0, 8.0}};
    const std::vector<EffectWorst> effects = worst_effects(report);
    ASSERT_EQ(effects.size(), 1U);
    EXPECT_EQ(effects[0].broken_in, std::vector<std::string>{"a"});
    EXPECT_TRUE(std::isnan(effects[0].predicted_px)) << "a good view hid a bad one";
    const std::string text = trade_text(report);
    EXPECT_NE(text.find("MORE THAN PREDICTED in 1 of 2"), std::string::npos) << text;
}

// No bound, and so none that is broken, loose or counted.
TEST(TradeReport, ClustersAreMeasuredAndNotPredicted) {
    const TradeKey clusters{EffectKind::detail, 2.0, {}, true};
    TradeReport report;
    report.effects = {{"a", level(2), 100.0, 2.0, 50.0, 1.0}, {"a", clusters, 0.0, 0.0, 60.0, 1.5}};
    EXPECT_FALSE(bound_broken(report.effects[1]));
    const std::vector<EffectWorst> effects = worst_effects(report);
    ASSERT_EQ(effects.size(), 2U);
    EXPECT_TRUE(effects[1].broken_in.empty());
    EXPECT_FALSE(effects[1].ratio_m);
    EXPECT_FALSE(effects[1].ratio_px);
    EXPECT_EQ(effects[1].measured_px, 1.5);
    const std::string text = trade_text(report);
    const std::size_t from = text.find("\nclusters, tau 2 ");
    ASSERT_NE(from, std::string::npos) << text;
    std::istringstream line(text.substr(from + 1, text.find('\n', from + 1) - from - 1));
    const std::vector<std::string> words{std::istream_iterator<std::string>(line), {}};
    EXPECT_EQ(words, (std::vector<std::string>{"clusters,", "tau", "2", "-", "60.0", "-", "1.5"})) << text;
    EXPECT_EQ(text.find("MORE THAN"), std::string::npos) << text;
    const nlohmann::ordered_json page = trade_page_json(report);
    for (const char* list : {"effects", "effects_of_views"}) {
        const nlohmann::ordered_json& row = page[list][1];
        for (const char* unknown : {"predicted_m", "predicted_px", "ratio_m", "ratio_px"})
            EXPECT_TRUE(row[unknown].is_null()) << list << " " << unknown;
        EXPECT_EQ(row["measured_m"], 60.0) << list;
    }
    EXPECT_EQ(page["bounds"].dump(), R"({"measured":1,"over":0,"loose":0,"unmeasured":0})");
}

// Figures of a column stand below each other by their points.
TEST(TradeReport, FiguresOfTheTextAreAligned) {
    TradeReport report;
    report.shots = {shot("v", level(1), 1.3, 0.5), shot("v", level(2), 123.0, 40.0),
                    shot("v", level(3), 12.5, 0.0125)};
    sum_up(report);
    const std::string text = trade_text(report);
    std::vector<std::size_t> units;  // where the units of the times stand
    for (const auto& [setting, time] :
         {std::pair{"\n* tau 1 ", "1.3"}, {"\n  tau 2 ", "123"}, {"\n* tau 3 ", "12.5"}}) {
        const std::size_t from = text.find(setting);
        ASSERT_NE(from, std::string::npos) << text;
        const std::string line = text.substr(from + 1, text.find('\n', from + 1) - from - 1);
        const std::size_t at = line.find(time);
        ASSERT_NE(at, std::string::npos) << line;
        units.push_back(at + std::string(time).substr(0, std::string(time).find('.')).size());
    }
    EXPECT_EQ(units, std::vector<std::size_t>(3, units[0])) << text;
}

// Loose is what is more than 10 times what was measured, where that is more than nobody asks for.
TEST(TradeReport, ALooseBoundIsOneThatSaysLittle) {
    const auto effect = [](double predicted_px, std::optional<double> measured_px) {
        return TradeEffect{"v", {}, 1.0, predicted_px, 1.0, measured_px};
    };
    EXPECT_TRUE(bound_loose(effect(1.0, 0.09)));
    EXPECT_FALSE(bound_loose(effect(1.0, 0.11)));
    EXPECT_FALSE(bound_loose(effect(0.09, 0.001)));
    EXPECT_FALSE(bound_loose(effect(1.0, 0.0)));
    EXPECT_FALSE(bound_loose(effect(1.0, {})));
}

TEST(TradeReport, TextFitsATerminal) {
    const std::string text = trade_text(test::sample_report());
    std::size_t from = 0;
    for (std::size_t to = text.find('\n'); to != std::string::npos; to = text.find('\n', from)) {
        EXPECT_LE(to - from, 120U) << text.substr(from, to - from);
        from = to + 1;
    }
    EXPECT_NE(text.find("\n* tau 2 "), std::string::npos);
    EXPECT_NE(text.find("\n  no ellipsoid "), std::string::npos);
    // Each measure is explained where it is printed.
    for (const char* line :
         {"\n* unbeaten: ", "\nfirst picture: ", "\nsettled: ", "\nground: ", "\nsurface: ", "\nseen: ",
          "\nskyline: ", "\nlimit: ", "\nterrain: ", "\npredicted: ", "\nratio: "})
        EXPECT_NE(text.find(line), std::string::npos) << line << text;
    for (const char* word : {"interior", "promise", "Pareto"})
        EXPECT_EQ(text.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace oro
