// What a trade writes: sums, the Pareto front, the table of values, the terminal's text and the page.
#include "apps/trade_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "apps/trade_axis.h"
#include "apps/trade_labels.h"
#include "apps/trade_parts.h"
#include "tests/commands/trade_page.h"

namespace oro {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

TradeShot shot(const std::string& view, const std::string& setting, double gpu_ms, double px) {
    TradeShot made;
    made.view = view;
    made.setting = setting;
    made.gpu_ms = gpu_ms;
    made.triangles = 1000;
    made.bytes = 250000;
    made.interior_m = {10.0 * px, 8.0 * px, 4.0 * px, px, 100};
    made.interior_px = {px, 0.75 * px, 0.5 * px, 0.25 * px, 100};
    made.skyline_px = {2.0 * px, 2.0 * px, px, 0.5 * px, 16};
    return made;
}

std::size_t times(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
}

std::vector<std::string> front_of(const TradeReport& report) {
    std::vector<std::string> names;
    for (const TradeSetting& setting : report.settings)
        if (setting.on_front) names.push_back(setting.name);
    return names;
}

// From one start tag to the next end tag; what is opened last is closed first. Empty when all is well.
std::string first_unbalanced(const std::string& html) {
    const std::vector<std::string> void_tags{"meta", "link", "img", "br"};
    std::vector<std::string> open;
    for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        if (html[at + 1] == '!') continue;
        const std::size_t end = html.find('>', at);
        if (end == std::string::npos) return "a tag without an end";
        const bool closes = html[at + 1] == '/';
        std::size_t name_end = at + 1 + (closes ? 1U : 0U);
        const std::size_t name_from = name_end;
        while (std::isalnum(static_cast<unsigned char>(html[name_end])) != 0) ++name_end;
        const std::string name = html.substr(name_from, name_end - name_from);
        if (closes) {
            if (open.empty() || open.back() != name) return "</" + name + ">";
            open.pop_back();
        } else if (html[end - 1] != '/' &&
                   std::find(void_tags.begin(), void_tags.end(), name) == void_tags.end()) {
            open.push_back(name);
        }
    }
    return open.empty() ? "" : "<" + open.back() + ">";
}

TEST(TradeReport, SumsSettingsOverTheViews) {
    TradeReport report;
    report.shots = {shot("a", "tau 1", 3.0, 0.5), shot("a", "tau 2", 1.0, 1.5), shot("b", "tau 1", 1.0, 1.0),
                    shot("b", "tau 2", 2.0, 2.0), shot("c", "tau 1", 2.0, 0.75)};
    TradeSetting known;
    known.name = "tau 2";
    known.options = "--tau 2";
    known.promised_px = 2.0;
    known.interior_px = 99.0;
    report.settings = {known};
    sum_up(report);
    ASSERT_EQ(report.settings.size(), 2U);
    const TradeSetting& one = report.settings[0];
    EXPECT_EQ(one.name, "tau 1");
    EXPECT_EQ(one.options, "");
    EXPECT_EQ(one.gpu_ms, 2.0);  // of 1, 2, 3
    EXPECT_EQ(one.triangles, 3000U);
    EXPECT_EQ(one.bytes, 750000U);
    EXPECT_EQ(one.interior_m, 10.0);
    EXPECT_EQ(one.interior_px, 1.0);
    EXPECT_EQ(one.interior_p99_px, 0.5);
    EXPECT_EQ(one.interior_mean_px, 0.1875);  // (0.125 + 0.25 + 0.1875) / 3
    EXPECT_EQ(one.skyline_px, 2.0);
    EXPECT_EQ(one.interior_pixels, 300U);
    EXPECT_EQ(one.skyline_columns, 48U);
    const TradeSetting& two = report.settings[1];
    EXPECT_EQ(two.options, "--tau 2");
    EXPECT_EQ(two.promised_px, 2.0);
    EXPECT_EQ(two.gpu_ms, 1.5);  // of 1, 2
    EXPECT_EQ(two.interior_px, 2.0);
}

TEST(TradeReport, TheFrontHoldsWhatNothingBeats) {
    TradeReport report;
    report.shots = {shot("v", "fast", 1.0, 8.0),         shot("v", "even", 2.0, 4.0),
                    shot("v", "beaten", 3.0, 5.0),       shot("v", "close", 4.0, 1.0),
                    shot("v", "close too", 4.0, 1.0),    shot("v", "close, slower", 5.0, 1.0),
                    shot("v", "even, farther", 2.0, 4.5)};
    sum_up(report);
    EXPECT_EQ(front_of(report), (std::vector<std::string>{"fast", "even", "close", "close too"}));
}

// A summary of nothing is all 0: that is not the closest picture of all.
TEST(TradeReport, WhatWasNotMeasuredIsNotOnTheFront) {
    TradeReport report;
    report.shots = {shot("v", "real", 2.0, 1.0), shot("v", "blank", 1.0, 0.0),
                    shot("v", "broken", 0.5, no_number), shot("w", "broken", 0.5, 0.1)};
    report.shots[1].interior_px = report.shots[1].interior_m = {};
    sum_up(report);
    EXPECT_EQ(front_of(report), std::vector<std::string>{"real"});
    EXPECT_TRUE(std::isnan(report.settings[2].interior_px)) << "a good view hid a bad one";
}

TEST(TradeReport, CsvIsRfc4180WithAllDigits) {
    TradeReport report;
    report.shots = {shot("far, over \"the\" Alps", "tau 1", 0.1, 0.5), shot("b", "flat", 1.0 / 3.0, 256.0)};
    report.shots[1].skyline_px = {};
    report.shots[1].skyline_in_one_only = 7;
    EXPECT_EQ(trade_csv(report),
              "view,setting,gpu_ms,triangles,bytes,"
              "interior_m_max,interior_m_p9999,interior_m_p99,interior_m_mean,interior_m_count,"
              "interior_px_max,interior_px_p9999,interior_px_p99,interior_px_mean,interior_px_count,"
              "skyline_px_max,skyline_px_p9999,skyline_px_p99,skyline_px_mean,skyline_px_count,"
              "skyline_in_one_only\r\n"
              "\"far, over \"\"the\"\" Alps\",tau 1,0.1,1000,250000,"
              "5,4,2,0.5,100,0.5,0.375,0.25,0.125,100,1,1,0.5,0.25,16,0\r\n"
              "b,flat,0.3333333333333333,1000,250000,"
              "2560,2048,1024,256,100,256,192,128,64,100,0,0,0,0,0,7\r\n");
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
    EXPECT_EQ(escaped("<&\">'"), "&lt;&amp;&quot;&gt;&#39;");
}

TEST(TradeReport, AnAxisKeepsZerosAndWhatIsMissing) {
    const std::vector<double> values{0.01, 0.0, 100.0, no_number};
    const LogAxis axis(values, 100.0, 900.0);
    ASSERT_EQ(axis.bands().size(), 2U);
    EXPECT_EQ(axis.bands()[0].label, "n/a");
    EXPECT_EQ(axis.bands()[1].label, "0");
    EXPECT_EQ(axis.at(no_number), 117.0);  // bands of 34 px
    EXPECT_EQ(axis.at(0.0), 151.0);
    EXPECT_GT(axis.at(0.01), 168.0);
    EXPECT_NEAR(axis.at(1.0), (axis.at(0.01) + axis.at(100.0)) / 2.0, 1e-9);
    EXPECT_LT(axis.at(100.0), 900.0);
    std::vector<std::string> labels;
    for (const AxisTick& tick : axis.ticks()) labels.push_back(tick.label);
    EXPECT_EQ(labels, (std::vector<std::string>{"0.01", "0.1", "1", "10", "100"}));
}

// Of one value, of none, of numbers that a logarithm cannot hold, of the whole range of a double.
TEST(TradeReport, AnAxisOfAnythingHasFinitePlaces) {
    const double infinity = std::numeric_limits<double>::infinity();
    const std::vector<std::vector<double>> sets{
        {}, {0.0}, {5.0}, {5.0, 5.0}, {-1.0, infinity}, {no_number}, {5e-324, 1.7e308}};
    for (const std::vector<double>& values : sets) {
        const LogAxis axis(values, 500.0, 20.0);
        EXPECT_GE(axis.ticks().size(), 2U);
        EXPECT_LE(axis.ticks().size(), 12U);
        for (const double value : values) {
            EXPECT_GE(axis.at(value), 20.0) << value;
            EXPECT_LE(axis.at(value), 500.0) << value;
        }
    }
}

TEST(TradeReport, LabelsLieNeitherOnEachOtherNorOnPoints) {
    std::vector<PlotPlace> points;
    for (int i = 0; i < 12; ++i) points.push_back({200.0 + 7.0 * i, 150.0 + 3.0 * (i % 4)});
    const std::vector<double> widths_px(points.size(), 80.0);
    const auto labels = place_labels(points, widths_px, {0.0, 0.0, 600.0, 300.0}, {});
    for (std::size_t i = 0; i < labels.size(); ++i) {
        ASSERT_TRUE(labels[i]) << i;
        const PlotBox& a = labels[i]->box;
        for (const PlotPlace& point : points)
            EXPECT_FALSE(point.x > a.left && point.x < a.right && point.y > a.top && point.y < a.bottom) << i;
        for (std::size_t k = 0; k < i; ++k) {
            const PlotBox& b = labels[k]->box;
            EXPECT_FALSE(a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom);
        }
    }
}

TEST(TradeReport, EffectsSayTheWorstAndTheirRatios) {
    TradeReport report;
    report.effects = {{"a", "sphere", 100.0, 10.0, 50.0, 8.0, "one"},
                      {"b", "sphere", 40.0, 2.0, 10.0, 4.0, "two"},
                      {"a", "source", 16.0, 9.0, {}, {}, "nothing truer"},
                      {"b", "sphere", 0.0, 0.0, 0.0, 0.0, "one"}};
    const std::vector<EffectWorst> effects = worst_effects(report);
    ASSERT_EQ(effects.size(), 2U);
    EXPECT_EQ(effects[0].predicted_m, 100.0);
    EXPECT_EQ(effects[0].measured_m, 50.0);
    EXPECT_EQ(effects[0].measured_px, 8.0);
    EXPECT_EQ(effects[0].ratio_m->least, 2.0);
    EXPECT_EQ(effects[0].ratio_m->most, 4.0);
    EXPECT_EQ(effects[0].ratio_px->least, 0.5);
    EXPECT_EQ(effects[0].ratio_px->most, 1.25);
    EXPECT_EQ(effects[0].remark, "one; two");
    EXPECT_EQ(effects[0].broken_in, std::vector<std::string>{"b"});
    EXPECT_FALSE(effects[1].measured_m);
    EXPECT_FALSE(effects[1].ratio_px);
    const std::string text = trade_text(report);
    EXPECT_NE(text.find("MORE THAN PREDICTED in 1 of 3"), std::string::npos) << text;
}

TEST(TradeReport, TextFitsATerminal) {
    const std::string text = trade_text(test::sample_report());
    std::size_t from = 0;
    for (std::size_t to = text.find('\n'); to != std::string::npos; to = text.find('\n', from)) {
        EXPECT_LE(to - from, 120U) << text.substr(from, to - from);
        from = to + 1;
    }
    EXPECT_NE(text.find("\n* tau 2 "), std::string::npos);
    EXPECT_NE(text.find("\n  earth sphere "), std::string::npos);
}

TEST(TradeReport, ThePageHoldsEveryPoint) {
    const TradeReport report = test::sample_report();
    const std::string html = trade_html(report);
    EXPECT_EQ(first_unbalanced(html), "");
    EXPECT_EQ(html.find("http://"), std::string::npos);
    EXPECT_EQ(html.find("https://"), std::string::npos);
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_EQ(html.find("nan,"), std::string::npos);
    EXPECT_EQ(times(html, "<svg role=\"img\" aria-label=\""), 6U);
    EXPECT_EQ(times(html, "<g class=\"point"), 3U * 14 + 2U * 11 + 2U * 84);
    EXPECT_EQ(times(html, "src=\"data:image/png;base64,iVBORw0KGgo"), 3U);
    for (const TradeShot& one : report.shots)
        EXPECT_EQ(times(html, "data-view=\"" + one.view + "\" data-setting=\"" + one.setting + "\""), 2U);
    for (const TradeSetting& setting : report.settings)
        EXPECT_EQ(times(html, "\" data-setting=\"" + setting.name + "\" transform"), 3U + 2U * 6);
}

TEST(TradeReport, ThePageEscapesEverything) {
    TradeReport report = test::sample_report();
    const std::string evil = "<&\">'\x01";
    report.region = report.command = report.machine = report.gpu = report.driver = evil;
    report.pipeline = report.version = report.time = evil;
    for (TradeShot& one : report.shots) {
        one.view = evil + one.view;
        one.setting = evil + one.setting;
    }
    for (TradeSetting& setting : report.settings) {
        setting.name = evil + setting.name;
        setting.options = "--x " + evil;
    }
    for (TradeEffect& effect : report.effects) effect.view = effect.effect = effect.remark = evil;
    for (TradePicture& picture : report.pictures) picture.title = picture.caption = evil;
    sum_up(report);
    const std::string html = trade_html(report);
    EXPECT_EQ(html.find("<&"), std::string::npos);
    EXPECT_EQ(html.find("&\""), std::string::npos);
    EXPECT_EQ(html.find('\x01'), std::string::npos);
    EXPECT_NE(html.find("&lt;&amp;&quot;&gt;&#39;\xEF\xBF\xBD"
                        "far over the Alps"),
              std::string::npos);
    EXPECT_EQ(first_unbalanced(html), "");
}

TEST(TradeReport, ZerosAndWhatIsMissingAreOnThePage) {
    TradeReport report;
    report.shots = {shot("v", "exact", 0.0, 0.0), shot("v", "blank", 1.0, 0.0),
                    shot("v", "wild", 1.0, no_number), shot("v", "plain", 2.0, 1.0)};
    report.shots[1].interior_px = {};
    report.effects = {{"v", "none", 0.0, 0.0, 0.0, 0.0, ""}, {"v", "endless", 1e300, no_number, {}, {}, ""}};
    report.pictures = {{"no PNG", "", {1, 2, 3}}};
    sum_up(report);
    const std::string html = trade_html(report);
    EXPECT_EQ(times(html, "<g class=\"point"), 3U * 4 + 2U * 2 + 2U * 4);
    EXPECT_EQ(times(html, "data-points=\"4\""), 6U);
    EXPECT_EQ(html.find("translate(nan"), std::string::npos);
    EXPECT_EQ(html.find("translate(inf"), std::string::npos);
    EXPECT_NE(html.find(">0</text>"), std::string::npos);
    EXPECT_NE(html.find(">n/a</text>"), std::string::npos);
    EXPECT_EQ(first_unbalanced(html), "");
    EXPECT_NE(trade_text(report).find("n/a"), std::string::npos);
}

TEST(TradeReport, AnEmptyReportIsWrittenToo) {
    TradeReport report;
    sum_up(report);
    const std::string html = trade_html(report);
    EXPECT_EQ(first_unbalanced(html), "");
    EXPECT_EQ(times(html, "data-points=\"0\""), 6U);
    EXPECT_EQ(html.find("nan"), std::string::npos);
    EXPECT_EQ(times(trade_csv(report), "\r\n"), 1U);
    EXPECT_NE(trade_text(report).find("none"), std::string::npos);
}

}  // namespace
}  // namespace oro
