// The sample page in a browser: no error, every plot with all its data.
#include "tests/commands/trade_page.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/test_data.h"

namespace oro {
namespace test {
namespace {

// 16 x 9 px: a ridge under a sky.
constexpr std::array<std::uint8_t, 274> small_png{
    137, 80,  78,  71,  13,  10,  26,  10,  0,   0,   0,   13,  73,  72,  68,  82,  0,   0,   0,   16,
    0,   0,   0,   9,   8,   2,   0,   0,   0,   180, 72,  59,  101, 0,   0,   0,   217, 73,  68,  65,
    84,  120, 218, 149, 201, 177, 102, 4,   81,  20,  135, 241, 251, 96,  195, 50,  12,  203, 112, 185,
    12,  195, 176, 118, 152, 107, 56,  172, 83,  220, 211, 252, 171, 83,  196, 169, 142, 212, 169, 183,
    140, 84,  41,  82,  164, 76,  153, 50,  79,  113, 159, 35,  12,  25,  177, 91,  45,  191, 234, 251,
    2,   174, 245, 33,  225, 233, 181, 62,  36,  60,  191, 215, 27,  235, 20,  239, 227, 46,  188, 124,
    214, 27,  151, 115, 188, 156, 211, 125, 223, 22,  133, 146, 155, 235, 87,  221, 149, 220, 151, 28,
    75,  78,  37,  15,  37,  143, 255, 215, 118, 41,  128, 154, 183, 239, 186, 3,   245, 160, 8,   74,
    160, 1,   52,  254, 197, 25,  180, 128, 86,  16,  5,   229, 230, 227, 167, 42,  183, 202, 157, 242,
    81,  185, 87,  142, 202, 73,  121, 80,  30,  149, 167, 237, 206, 202, 139, 242, 170, 76,  193, 164,
    49,  57,  152, 180, 38,  157, 201, 209, 164, 55,  137, 38,  201, 100, 48,  25,  77,  38,  147, 147,
    201, 108, 178, 152, 172, 38,  20,  28,  141, 227, 224, 104, 29,  157, 227, 232, 232, 29,  209, 145,
    28,  131, 99,  116, 76,  142, 147, 99,  118, 44,  142, 213, 65,  191, 235, 48,  248, 233, 241, 55,
    117, 223, 0,   0,   0,   0,   73,  69,  78,  68,  174, 66,  96,  130};

struct MadeSetting {
    TradeKey key;
    const char* options;
    double limit_px;  // 0: nothing
    double ms;        // times the view's
    double triangles;
    double bytes;
    double px;  // times the view's roughness, but not above the limit
};
constexpr std::array<MadeSetting, 14> settings{
    {{{EffectKind::detail, 0.5, {}}, "--tau 0.5", 0.5, 1.9, 2.6, 2.2, 0.48},
     {{EffectKind::detail, 1.0, {}}, "--tau 1", 1.0, 1.25, 1.5, 1.5, 0.95},
     {{EffectKind::detail, 2.0, {}}, "--tau 2", 2.0, 0.9, 0.9, 1.05, 1.8},
     {{EffectKind::detail, 4.0, {}}, "--tau 4", 4.0, 0.7, 0.55, 0.75, 3.4},
     {{EffectKind::sphere, {}, {}}, "--earth sphere", 0.0, 1.24, 1.5, 1.5, 74.0},
     {{EffectKind::flat, {}, {}}, "--earth flat", 0.0, 1.19, 1.48, 1.5, 316.0},
     {{EffectKind::geoid, {}, {}}, "--geoid none", 0.0, 1.25, 1.5, 1.5, 0.96},
     {{EffectKind::refraction, {}, {}}, "--refraction 0", 0.0, 1.23, 1.5, 1.5, 9.3},
     {{EffectKind::float32_view, {}, {}}, "--precision naive", 0.0, 1.31, 1.5, 1.5, 21.0},
     {{EffectKind::steps_i16, {}, {}}, "--heights i16", 0.0, 1.2, 1.5, 0.8, 1.4},
     {{EffectKind::float32_posts, {}, {}},
      "--earth flat --geoid none --refraction 0 --heights i16",
      0.0,
      1.02,
      1.5,
      0.8,
      340.0},
     {{{}, {}, Bundle::draft}, "--accuracy draft", 4.0, 0.66, 0.55, 0.4, 3.9},
     {{{}, {}, Bundle::balanced}, "--accuracy balanced", 1.0, 1.21, 1.5, 0.8, 0.97},
     {{{}, {}, Bundle::survey}, "--accuracy survey", 0.5, 1.93, 2.6, 2.2, 0.47}}};
struct MadeView {
    const char* name;
    double ms;
    double triangles;
    double rough;
};
constexpr std::array<MadeView, 6> views{{{"far over the Alps", 1.31, 612345, 0.98},
                                         {"valley floor", 0.62, 214567, 0.61},
                                         {"summit, all round", 1.58, 803211, 1.0},
                                         {"straight down", 0.44, 150322, 0.32},
                                         {"plain at sunset", 0.37, 98211, 0.12},
                                         {"35,000 km", 0.21, 20110, 0.0}}};
struct MadeEffect {
    TradeKey key;
    double m, px;
    double ratio;  // predicted / measured; 0: not measured
    EffectMeasure measured_by{EffectMeasure::picture};
};
constexpr std::array<MadeEffect, 11> effects{
    {{{EffectKind::geoid, {}, {}}, 52.0, 0.0, 1.0},
     {{EffectKind::sphere, {}, {}}, 1430.0, 96.0, 1.3},
     {{EffectKind::flat, {}, {}}, 7850.0, 380.0, 1.2},
     {{EffectKind::refraction, {}, {}}, 1021.0, 12.4, 1.33},
     {{EffectKind::float32_posts, {}, {}}, 0.0009, 0.0021, 6.2},
     {{EffectKind::float32_view, {}, {}}, 0.00042, 0.00087, 13.0},
     {{EffectKind::steps_i16, {}, {}}, 0.5, 0.71, 1.6},
     {{EffectKind::detail, 1.0, {}}, 213.0, 1.0, 1.05},
     {{EffectKind::depth, {}, {}}, 0.031, 0.0004, 0.8},
     {{EffectKind::interpolation, {}, {}}, 11.2, 2.1, 1.5, EffectMeasure::thinned},
     {{EffectKind::source, {}, {}}, 16.0, 9.7, 0.0, EffectMeasure::stated}}};

ErrorSummary summary(double largest, std::uint64_t count) {
    return {largest, largest * 0.83, largest * 0.41, largest * 0.087, count};
}

TradeShot shot_of(const MadeView& view, const MadeSetting& setting) {
    TradeShot shot;
    shot.view = view.name;
    shot.setting = setting.key;
    shot.first = {view.ms * setting.ms, static_cast<std::uint64_t>(view.triangles * setting.triangles)};
    shot.settled = {0.8 * view.ms * setting.ms,
                    static_cast<std::uint64_t>(0.4 * view.triangles * setting.triangles)};
    shot.bytes = static_cast<std::uint64_t>(view.triangles * 41.0 * setting.bytes);
    const bool sky_only =
        std::string(view.name) == "plain at sunset" && setting.key.effect == EffectKind::flat;
    const double px = setting.px * view.rough;
    shot.displacement_px = sky_only ? ErrorSummary{} : summary(px, 180211);
    shot.displacement_m = sky_only ? ErrorSummary{} : summary(px * 31.4, 180211);
    if (std::string(view.name) != "straight down") shot.skyline_px = summary(px * 1.7, 640);
    shot.skyline_in_one_only = setting.px > 100.0 ? 41 : 0;
    return shot;
}

}  // namespace

TradeReport sample_report() {
    TradeReport report;
    report.region = "N46E007.hgt, N46E008.hgt";
    report.command = "orograph trade N46E007.hgt N46E008.hgt --size 640x360 --out trade";
    report.machine = "x86_64, 2 cores, 16 GB, Debian GNU/Linux 12";
    report.gpu = "Example GPU 1000 (made up)";
    report.driver = "example 1.2.3";
    report.pipeline = "mesh shaders";
    report.version = "Orograph 0.1.0";
    report.time = "2026-11-21T09:00:00Z";
    report.width_px = 640;
    report.height_px = 360;
    for (const MadeSetting& setting : settings) {
        TradeSetting asked;
        asked.key = setting.key;
        asked.options = setting.options;
        if (setting.limit_px > 0.0) asked.limit_px = setting.limit_px;
        report.settings.push_back(asked);
    }
    for (const MadeView& view : views) {
        for (const MadeSetting& setting : settings) report.shots.push_back(shot_of(view, setting));
        for (const MadeEffect& effect : effects) {
            TradeEffect one{view.name, effect.key, effect.m,          effect.px * view.rough,
                            {},        {},         effect.measured_by};
            if (effect.ratio > 0.0) {
                one.measured_m = one.predicted_m / effect.ratio / (1.0 + 0.4 * view.rough);
                one.measured_px = one.predicted_px / effect.ratio / (1.0 + 0.2 * (1.0 - view.rough));
            }
            report.effects.push_back(one);
        }
    }
    const std::vector<std::uint8_t> png(small_png.begin(), small_png.end());
    report.pictures = {
        {"far over the Alps, survey", "As drawn with every model on.", png},
        {"far over the Alps, no curve of the Earth: error", "White: 0 px; black: 316 px and more.", png},
        {"summit, all round, survey", "As drawn with every model on.", png}};
    sum_up(report);
    return report;
}

}  // namespace test

namespace {

int run(const std::string& command) {
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string quoted(const std::filesystem::path& path) {
    return "'" + path.string() + "'";
}

std::filesystem::path check_page() {
    return test::bundled_data().parent_path() / "scripts" / "check-page";
}

void write(const std::filesystem::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
}

constexpr int no_browser = 77;

TEST(TradePage, OpensInABrowserWithAllItsData) {
    const TradeReport report = test::sample_report();
    const std::filesystem::path folder = test::scratch_folder();
    write(folder / "trade.html", trade_html(report));
    write(folder / "trade.csv", trade_csv(report));
    const int outcome = run(quoted(check_page()) + " --csv " + quoted(folder / "trade.csv") + " " +
                            quoted(folder / "trade.html"));
    if (outcome == no_browser) GTEST_SKIP() << "needs chromium";
    EXPECT_EQ(outcome, 0);
}

// The page with its policy loosened, so that a changed script runs, and what it does is what is found.
std::string with_any_script(std::string html) {
    const std::size_t from = html.find("script-src 'sha256-") + 11, to = html.find('"', from);
    return html.replace(from, to - from, "'unsafe-inline'");
}

// What the check is for: it must fail where there is something to find.
TEST(TradePage, TheCheckFindsWhatIsWrong) {
    const std::string written = trade_html(test::sample_report());
    const std::string page = with_any_script(written);
    const std::filesystem::path folder = test::scratch_folder();
    const auto outcome_of = [&](std::string html, const std::string& from, const std::string& to) {
        const std::size_t at = html.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        write(folder / "wrong.html", html.replace(at, from.size(), to));
        return run(quoted(check_page()) + " " + quoted(folder / "wrong.html") + " >/dev/null 2>&1");
    };
    const int unchanged = outcome_of(page, "", "");
    if (unchanged == no_browser) GTEST_SKIP() << "needs chromium";
    EXPECT_EQ(unchanged, 0) << "nothing is found in a page that is only loosened";
    EXPECT_EQ(outcome_of(page, "'class': 'point ' +", "'class': 'lost ' +"), 1);
    EXPECT_EQ(outcome_of(page, "</main>", "<img alt=\"\" src=\"//localhost/a.png\"></main>"), 1);
    EXPECT_EQ(outcome_of(page, "</main>", "<script>throw 1</script></main>"), 1);
    EXPECT_EQ(outcome_of(page, "</main>", "<script>var quiet;</script></main>"), 1);
    EXPECT_EQ(outcome_of(page, "return 'translate(' +", "return 'translate(nan' +"), 1);
    EXPECT_EQ(outcome_of(page, "'data-plot': head.id", "'data-plot-lost': head.id"), 1);
    // A picture, a point and a plot that the data do not hold, and a script that stops.
    EXPECT_EQ(outcome_of(page, "report.pictures.map(pictureOf)", "[]"), 1);
    EXPECT_EQ(outcome_of(page, "report.shots.forEach(function (shot) {",
                         "report.shots.slice(1).forEach(function (shot) {"),
              1);
    EXPECT_EQ(outcome_of(page, "  viewsPlots(report);", "  return;"), 1);
    EXPECT_EQ(outcome_of(page, "fillPage();\n</script>", "fillPage(); missing();\n</script>"), 1);
    // The policy by itself: a script that is not the page's own does not run, and says so.
    EXPECT_EQ(outcome_of(written, "fillPage();\n</script>", "fillPage(); \n</script>"), 1);
}

}  // namespace
}  // namespace oro
