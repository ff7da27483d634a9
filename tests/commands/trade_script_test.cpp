// The page that a trade writes, as its script draws it: every point, every figure, and nothing that is not
// escaped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <string>
#include <vector>

#include "apps/report/figures.h"
#include "apps/trade/trade_page.h"
#include "apps/trade/trade_parts.h"
#include "apps/trade/trade_report.h"
#include "tests/commands/page_stage.h"
#include "tests/commands/trade_page.h"

namespace oro {
namespace {

using test::drawn_page, test::evaluated;

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

std::size_t times(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size()))
        ++count;
    return count;
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

// Both are read by people: the page writes numbers as the terminal's table does.
TEST(TradeScript, FiguresAreThoseOfTheTable) {
    std::string expressions;
    std::vector<std::string> expected;
    for (const double value :
         {0.0, 0.01234, 1.26, 12.44, 316.2, -316.2, 9922.0, 0.0000423, 0.00009999, 36000000.0}) {
        expressions += (expressions.empty() ? "" : ",") + std::string("figure(") + all_digits(value) + ")";
        expected.push_back(figure(value));
    }
    EXPECT_EQ(evaluated("[" + expressions + "]"), nlohmann::json(expected));
    EXPECT_EQ(evaluated("[figure(null), figure('inf'), figure('-inf')]"),
              nlohmann::json({"n/a", "inf", "-inf"}));
    EXPECT_EQ(evaluated("[grouped(0), grouped(999), grouped(12345678)]"),
              nlohmann::json({"0", "999", "12,345,678"}));
}

TEST(TradeScript, AnAxisKeepsZerosAndWhatIsMissing) {
    const nlohmann::json axis = evaluated(
        "(function () { var a = logAxis([0.01, 0, 100, NaN], 100, 900);"
        " return {bands: a.bands, ticks: a.ticks, none: a.at(NaN), zero: a.at(0), low: a.at(0.01), one: "
        "a.at(1),"
        " high: a.at(100)}; })()");
    ASSERT_EQ(axis.at("bands").size(), 2U);
    EXPECT_EQ(axis["bands"][0].at("label"), "n/a");
    EXPECT_EQ(axis["bands"][1].at("label"), "0");
    EXPECT_EQ(axis.at("none"), 117.0);  // bands of 34 px
    EXPECT_EQ(axis.at("zero"), 151.0);
    EXPECT_GT(axis.at("low"), 168.0);
    EXPECT_NEAR(axis.at("one").get<double>(),
                (axis.at("low").get<double>() + axis.at("high").get<double>()) / 2.0, 1e-9);
    EXPECT_LT(axis.at("high"), 900.0);
    std::vector<std::string> labels;
    for (const nlohmann::json& tick : axis.at("ticks")) labels.push_back(tick.at("label"));
    EXPECT_EQ(labels, (std::vector<std::string>{"0.01", "0.1", "1", "10", "100"}));
}

// Of one value, of none, of numbers that a logarithm cannot hold, of the whole range of a double.
TEST(TradeScript, AnAxisOfAnythingHasFinitePlaces) {
    const nlohmann::json axes = evaluated(
        "[[], [0], [5], [5, 5], [-1, Infinity], [NaN], [5e-324, 1.7e308]].map(function (values) {"
        " var axis = logAxis(values, 500, 20);"
        " return {ticks: axis.ticks.length, places: values.map(axis.at)}; })");
    ASSERT_EQ(axes.size(), 7U);
    for (const nlohmann::json& axis : axes) {
        EXPECT_GE(axis.at("ticks"), 2) << axis;
        EXPECT_LE(axis.at("ticks"), 12) << axis;
        for (const nlohmann::json& place : axis.at("places")) {
            ASSERT_TRUE(place.is_number()) << axis;
            EXPECT_GE(place, 20.0) << axis;
            EXPECT_LE(place, 500.0) << axis;
        }
    }
}

TEST(TradeScript, LabelsLieNeitherOnEachOtherNorOnPoints) {
    struct Box {
        double left, top, right, bottom;
    };
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < 12; ++i) points.emplace_back(200.0 + 7.0 * i, 150.0 + 3.0 * (i % 4));
    const nlohmann::json labels = evaluated(
        "(function () { var points = [], widths = [];"
        " for (var i = 0; i < 12; ++i) { points.push({x: 200 + 7 * i, y: 150 + 3 * (i % 4)});"
        " widths.push(80); }"
        " return placeLabels(points, widths, {left: 0, top: 0, right: 600, bottom: 300}, []); })()");
    ASSERT_EQ(labels.size(), points.size());
    std::vector<Box> boxes;
    for (const nlohmann::json& label : labels) {
        ASSERT_TRUE(label.is_object()) << label;
        const nlohmann::json& box = label.at("box");
        boxes.push_back({box.at("left"), box.at("top"), box.at("right"), box.at("bottom")});
    }
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Box& a = boxes[i];
        for (const auto& [x, y] : points)
            EXPECT_FALSE(x > a.left && x < a.right && y > a.top && y < a.bottom) << i;
        for (std::size_t k = 0; k < i; ++k) {
            const Box& b = boxes[k];
            EXPECT_FALSE(a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom);
        }
    }
}

// The page as it is written: one script, which the policy knows by its hash, and nothing from anywhere.
TEST(TradeScript, ThePageAllowsItsOwnScriptAlone) {
    const std::string html = trade_html(test::sample_report());
    EXPECT_EQ(times(html, "<script"), 2U);
    EXPECT_EQ(times(html, "<script type=\"application/json\" id=\"report\">"), 1U);
    EXPECT_EQ(times(html, "<script>" + std::string(trade_page_script) + "</script>"), 1U);
    EXPECT_EQ(times(html, "script-src 'sha256-"), 1U);
    EXPECT_EQ(times(html, "default-src 'none'"), 1U);
    EXPECT_EQ(times(html, "'unsafe-inline'"), 1U) << "of styles";
    EXPECT_EQ(times(html,
                    "data-plots=\"6\" data-settings=\"14\" data-shots=\"84\" data-effects=\"11\" "
                    "data-pictures=\"3\""),
              1U);
    EXPECT_EQ(html.find("http://"), html.find("http://www.w3.org/2000/svg")) << "a name, and no address";
    EXPECT_EQ(times(html, "http://"), 1U);
    EXPECT_EQ(html.find("https://"), std::string::npos);
    for (const char* gap : {"STATED", "SCRIPT_HASH", "/* STYLE */", "/* SCRIPT */", ">REPORT<"})
        EXPECT_EQ(html.find(gap), std::string::npos) << gap;
    for (const char* word : {"interior", "promise", "Pareto"})
        EXPECT_EQ(html.find(word), std::string::npos) << word;
}

TEST(TradeScript, ThePageHoldsEveryPoint) {
    const TradeReport report = test::sample_report();
    const std::string html = drawn_page(report);
    EXPECT_EQ(first_unbalanced(html), "");
    EXPECT_EQ(html.find("NaN"), std::string::npos);
    EXPECT_EQ(html.find("undefined"), std::string::npos);
    EXPECT_EQ(times(html, "<svg role=\"img\" aria-label=\""), 6U);
    EXPECT_EQ(times(html, "<g class=\"point"), 3U * 14 + 2U * 11 + 2U * 84);
    EXPECT_EQ(times(html, "src=\"data:image/png;base64,iVBORw0KGgo"), 3U);
    for (const TradeShot& one : report.shots)
        EXPECT_EQ(times(html, "data-view=\"" + one.view + "\" data-setting=\"" + name_of(one.setting) + "\""),
                  2U);
    for (const TradeSetting& setting : report.settings)
        EXPECT_EQ(times(html, " data-setting=\"" + name_of(setting.key) + "\""), 3U + 2U * 6);
    // Every row of the tables: settings, effects, effects of views, shots, and their heads.
    EXPECT_EQ(times(html, "<tr"), 14U + 11U + 66U + 84U + 4U * 2);
    std::size_t below_1 = 0;
    for (const TradeEffect& effect : report.effects) {
        if (bound_ratio(effect.predicted_m, effect.measured_m).value_or(1.0) < 1.0) ++below_1;
        if (bound_ratio(effect.predicted_px, effect.measured_px).value_or(1.0) < 1.0) ++below_1;
    }
    for (const EffectWorst& effect : worst_effects(report)) {
        if (effect.ratio_m && effect.ratio_m->least < 1.0) ++below_1;
        if (effect.ratio_px && effect.ratio_px->least < 1.0) ++below_1;
    }
    EXPECT_GT(below_1, 0U);
    EXPECT_EQ(times(html, "<td class=\"alarm\">"), below_1);
}

TEST(TradeScript, ThePageEscapesEverything) {
    TradeReport report = test::sample_report();
    const std::string evil = "<&\">'\x01</script>REPORT STATED>";
    report.region = report.command = report.machine = report.gpu = report.driver = evil;
    report.pipeline = report.version = report.time = evil;
    for (TradeShot& one : report.shots) one.view = evil + one.view;
    for (TradeSetting& setting : report.settings) setting.options = "--x " + evil;
    for (TradeEffect& effect : report.effects) effect.view = evil;
    for (TradePicture& picture : report.pictures) picture.title = picture.caption = evil;
    sum_up(report);
    // As it is written: the data are JSON in which nothing looks like a tag.
    const std::string written = trade_html(report);
    EXPECT_EQ(times(written, "</script>"), 2U);
    EXPECT_EQ(written.find("<&"), std::string::npos);
    EXPECT_EQ(written.find('\x01'), std::string::npos);
    EXPECT_EQ(written.find("\\u0001"), std::string::npos);
    const std::size_t from = written.find("id=\"report\">") + 12;
    const nlohmann::json data =
        nlohmann::json::parse(written.substr(from, written.find("</script>") - from), nullptr, false);
    EXPECT_EQ(data, nlohmann::json(trade_page_json(report)));
    // As it is drawn.
    const std::string html = drawn_page(report);
    EXPECT_EQ(html.find("<&"), std::string::npos);
    EXPECT_EQ(html.find("&\""), std::string::npos);
    EXPECT_EQ(html.find('\x01'), std::string::npos);
    EXPECT_EQ(html.find("<script"), std::string::npos);
    EXPECT_NE(
        html.find("&lt;&amp;&quot;&gt;&#39;\xEF\xBF\xBD&lt;/script&gt;REPORT STATED&gt;far over the Alps"),
        std::string::npos);
    EXPECT_EQ(first_unbalanced(html), "");
}

TEST(TradeScript, ZerosAndWhatIsMissingAreOnThePage) {
    TradeReport report;
    report.shots = {shot("v", level(1), 0.0, 0.0), shot("v", level(2), 1.0, 0.0),
                    shot("v", level(3), 1.0, no_number), shot("v", level(4), 2.0, 1.0)};
    report.shots[1].displacement_px = {};
    report.effects = {{"v", level(1), 0.0, 0.0, 0.0, 0.0}, {"v", level(2), 1e300, no_number, {}, {}}};
    report.pictures = {{"no PNG", "", {1, 2, 3}}};
    sum_up(report);
    const std::string html = drawn_page(report);
    EXPECT_EQ(times(html, "<g class=\"point"), 3U * 4 + 2U * 2 + 2U * 4);
    EXPECT_EQ(times(html, "data-points=\"4\""), 6U);
    EXPECT_EQ(html.find("translate(NaN"), std::string::npos);
    EXPECT_EQ(html.find("translate(Infinity"), std::string::npos);
    EXPECT_NE(html.find(">0</text>"), std::string::npos);
    EXPECT_NE(html.find(">n/a</text>"), std::string::npos);
    EXPECT_NE(html.find("no picture"), std::string::npos);
    EXPECT_EQ(first_unbalanced(html), "");
    EXPECT_NE(trade_text(report).find("n/a"), std::string::npos);
}

TEST(TradeScript, AnEmptyReportIsDrawnToo) {
    TradeReport report;
    sum_up(report);
    const std::string html = drawn_page(report);
    EXPECT_EQ(first_unbalanced(html), "");
    EXPECT_EQ(times(html, "data-points=\"0\""), 6U);
    EXPECT_EQ(html.find("NaN"), std::string::npos);
    EXPECT_NE(html.find("Nothing was measured"), std::string::npos);
    EXPECT_EQ(times(trade_csv(report), "\r\n"), 1U);
    EXPECT_NE(trade_text(report).find("none"), std::string::npos);
}

// What the page finds is said of the numbers, one and many.
TEST(TradeScript, FindingsSayWhatIsOverItsLimit) {
    TradeReport report;
    report.shots = {shot("v", level(1), 1.0, 1.5), shot("w", level(1), 1.0, 0.5), shot("v", {}, 2.0, 9.0)};
    report.shots[0].limit_px = report.shots[1].limit_px = 1.05;
    report.effects = {{"v", level(1), 1.0, 1.0, 2.0, 0.5}, {"w", level(1), 1.0, 1.0, 0.5, 0.05}};
    sum_up(report);
    std::string html = drawn_page(report);
    EXPECT_NE(html.find("Of the 2 pictures of settings that have a limit, 1 is over it."), std::string::npos);
    EXPECT_NE(html.find("Unbeaten is 1 of 2 settings: "), std::string::npos);
    EXPECT_NE(
        html.find(
            "In 1 of 2 predictions that could be measured there was more than predicted; 1 is more than 10 "
            "times what was measured; 0 could not be measured."),
        std::string::npos);
    EXPECT_NE(html.find("More than predicted in 1 of 2 views."), std::string::npos);
    // Ground is within it now, and the skyline not yet.
    report.shots[0].displacement_px.largest = 1.0;
    sum_up(report);
    html = drawn_page(report);
    EXPECT_NE(html.find("Of the 2 pictures of settings that have a limit, 1 is over it."), std::string::npos);
    report.shots[0].skyline_px.largest = 1.0;
    report.effects[0].measured_m = 0.5;
    sum_up(report);
    html = drawn_page(report);
    EXPECT_NE(html.find("All 2 pictures of settings that have a limit keep it."), std::string::npos);
    EXPECT_NE(html.find("All 2 predictions that could be measured hold; "), std::string::npos);
}

}  // namespace
}  // namespace oro
