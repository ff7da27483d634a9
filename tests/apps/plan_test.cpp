// What `plan` tells of a view before it is drawn: every effect by name, with figures.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using Words = std::vector<std::string>;

constexpr int failed = 1, usage = 2, no_data = 3;

const std::set<std::string> effects{"geoid left out",
                                    "sphere for ellipsoid",
                                    "curvature left out",
                                    "refraction left out",
                                    "posts in float32 ECEF",
                                    "view transform in float32",
                                    "heights in 16 bits",
                                    "heights in steps of 0.5 mm",
                                    "level of detail",
                                    "float32 relative to the eye",
                                    "depth resolution",
                                    "triangles on 1/256 px",
                                    "flat triangles between posts",
                                    "interpolation between posts",
                                    "the source's own accuracy"};

std::string bundled() {
    return (oro::test::bundled_data() / "jacksboro.tif").string();
}

Outcome plan(const Words& more) {
    Words words{"plan",      bundled(), "--at",    "36.6,-84.2", "--above", "300",
                "--heading", "200.5",   "--pitch", "-5",         "--size",  "96x54"};
    words.insert(words.end(), more.begin(), more.end());
    return run_orograph(words);
}

// Every number in it is finite: JSON has no others, and writes null for them. `may_be_null` are the fields
// that say nothing where there is nothing to say.
void expect_numbers(const json& value, const std::string& name, const std::set<std::string>& may_be_null) {
    if (value.is_number()) {
        EXPECT_TRUE(std::isfinite(value.get<double>())) << name;
    }
    EXPECT_TRUE(!value.is_null() || may_be_null.contains(name)) << name << " is null";
    if (value.is_array()) {
        for (const json& one : value) expect_numbers(one, name, may_be_null);
    }
    if (value.is_object()) {
        for (const auto& [key, one] : value.items()) expect_numbers(one, key, may_be_null);
    }
}

json planned(const Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json said = json::parse(outcome.out, nullptr, false);
    EXPECT_TRUE(said.is_object()) << outcome.out;
    expect_numbers(said, "", {"size", "dominates", "bbox", "sun"});
    return said.is_object() ? said : json::object();
}

json effect_in(const json& said, const std::string& name) {
    for (const json& effect : said.at("effects")) {
        if (effect.at("effect") == name) return effect;
    }
    ADD_FAILURE() << name << " is not there";
    return json::object();
}

std::string line_of(const std::string& text, const std::string& begin) {
    const std::size_t at = text.find("\n" + begin);
    EXPECT_NE(at, std::string::npos) << begin << " is not in\n" << text;
    return at == std::string::npos ? "" : text.substr(at + 1, text.find('\n', at + 1) - at - 1);
}

bool says(const std::string& text, const std::string& words) {
    return text.find(words) != std::string::npos;
}

TEST(Plan, TableNamesEveryEffectWithFiguresAndWhatDominates) {
    const Outcome outcome = plan({"--accuracy", "draft"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const std::string& effect : effects) {
        const std::string line = line_of(outcome.out, effect);
        if (effect == "the source's own accuracy") {
            EXPECT_TRUE(says(line, "not stated by the source")) << line;
        } else {
            EXPECT_NE(line.find_first_of("0123456789", effect.size()), std::string::npos) << line;
        }
    }
    EXPECT_TRUE(says(outcome.out, "96 x 54 px, 45 degrees; tolerance 1 px")) << outcome.out;
    // 4 px of detail are more than anything else that the draft leaves out.
    const std::string detail = line_of(outcome.out, "level of detail");
    EXPECT_TRUE(says(detail, "in the picture, ABOVE the tolerance  <- dominates")) << detail;
    EXPECT_TRUE(says(line_of(outcome.out, "heights in 16 bits"), "in the picture, below the tolerance"));
    EXPECT_TRUE(says(line_of(outcome.out, "geoid left out"), "modelled, can be left out"));
    EXPECT_TRUE(says(line_of(outcome.out, "interpolation between posts"), "limit of the data"));
    EXPECT_TRUE(says(line_of(outcome.out, "this picture, all but the data"), "beyond the tolerance"));
    EXPECT_TRUE(says(line_of(outcome.out, "cheapest that holds 1 px"), "--accuracy balanced (--tau 0.5"));
    EXPECT_EQ(outcome.out.find("<- dominates"), outcome.out.rfind("<- dominates")) << "one of them only";
}

TEST(Plan, JsonHasEveryEffectWithNumbers) {
    const json said = planned(plan({"--json", "-q"}));
    std::set<std::string> named;
    for (const json& effect : said.at("effects")) {
        named.insert(effect.at("effect").get<std::string>());
        if (effect.at("size").is_null()) continue;
        for (const char* part : {"m", "px"}) {
            const auto worst = effect["size"].at("worst_" + std::string(part)).get<double>();
            const auto typical = effect["size"].at("typical_" + std::string(part)).get<double>();
            EXPECT_GE(typical, 0.0) << effect;
            EXPECT_GE(worst, typical) << effect;
        }
    }
    EXPECT_EQ(named, effects);
    EXPECT_EQ(said.at("in_view"), true);
    EXPECT_EQ(said.at("tolerance_px"), 1.0);
    // The eye is 300 m over the ground, and the picture's lower rim looks 5 + 22.5 degrees down.
    EXPECT_GT(said.at("nearest_m").get<double>(), 300.0);
    EXPECT_LT(said.at("nearest_m").get<double>(), 3000.0);
    EXPECT_GE(said.at("median_distance_m").get<double>(), said.at("nearest_m").get<double>());
    EXPECT_TRUE(effects.contains(said.at("dominates").get<std::string>()));
    EXPECT_EQ(said.at("cheapest").at("holds"), true);
    EXPECT_LE(said.at("cheapest").at("predicted_px").get<double>(), 1.0);
    EXPECT_EQ(said.at("view").at("size_px"), json({96, 54}));
    // tau bounds what levels may do; the sphere is off by kilometres at the eye, and metres from it.
    EXPECT_LE(effect_in(said, "level of detail")["size"]["worst_px"].get<double>(), 1.0);
    EXPECT_TRUE(effect_in(said, "the source's own accuracy")["size"].is_null());
    EXPECT_EQ(effect_in(said, "interpolation between posts")["limit_of_the_data"], true);
    EXPECT_EQ(effect_in(said, "refraction left out")["in_picture"], true);
    EXPECT_EQ(effect_in(said, "geoid left out")["in_picture"], false);
}

TEST(Plan, ToleranceJudges) {
    const json wide = planned(plan({"--json", "--tolerance", "1000px"}));
    const json narrow = planned(plan({"--json", "--tolerance", "0.01px"}));
    EXPECT_EQ(narrow.at("tolerance_px"), 0.01);
    int changed = 0;
    for (const std::string& effect : effects) {
        const json a = effect_in(wide, effect), b = effect_in(narrow, effect);
        EXPECT_EQ(a.at("size"), b.at("size")) << effect << ": a tolerance changes no prediction";
        EXPECT_EQ(a.at("below_tolerance"), true) << effect;
        const bool below = b["size"].is_null() || b["size"]["worst_px"].get<double>() <= 0.01;
        EXPECT_EQ(b.at("below_tolerance"), below) << effect;
        if (!below) ++changed;
    }
    EXPECT_GE(changed, 4);
    EXPECT_EQ(wide.at("cheapest").at("accuracy"), "draft");
    EXPECT_EQ(narrow.at("cheapest").at("accuracy"), "survey");
    const Outcome table = plan({"--tolerance", "0.01 px"});
    EXPECT_TRUE(says(line_of(table.out, "view transform in float32"), "modelled, needed")) << table.out;
    EXPECT_TRUE(says(line_of(table.out, "level of detail"), "ABOVE the tolerance")) << table.out;
}

TEST(Plan, NothingInViewIsSaid) {
    const Words sky{"plan", bundled(), "--at", "36.6,-84.2", "--above",
                    "300",  "--pitch", "90",   "--size",     "96x54"};
    const Outcome table = run_orograph(sky);
    EXPECT_EQ(table.exit_code, 0) << table.err;
    EXPECT_EQ(table.out, "nothing of the region is in view: there is nothing to predict\n");
    Words words = sky;
    words.push_back("--json");
    const json said = planned(run_orograph(words));
    EXPECT_EQ(said.at("in_view"), false);
    EXPECT_TRUE(said.at("dominates").is_null());
    EXPECT_EQ(said.at("total").at("worst_px"), 0.0);
}

TEST(Plan, TakesAViewAndItsOwnOptionsOverIt) {
    const fs::path folder = oro::test::scratch_folder();
    json said = planned(plan({"--json", "--accuracy", "draft"}));
    json view = said.at("view");
    oro::test::write_bytes(folder / "v.json", view.dump());
    const Outcome again = run_orograph({"plan", "--view", folder / "v.json", "--json", "-q"});
    EXPECT_EQ(again.err, "");
    EXPECT_EQ(planned(again), said) << "another plan from the view it tells";
    const json survey =
        planned(run_orograph({"plan", "--view", folder / "v.json", "--json", "--accuracy", "survey"}));
    EXPECT_EQ(survey.at("view").at("tau_px"), 0.0);
    EXPECT_EQ(effect_in(survey, "level of detail").at("in_picture"), false);
    expect_refusal(run_orograph({"plan", "--view", folder / "v.json", "--at", "36.6,-84.2"}), usage,
                   {"--view", "--at"});
    EXPECT_EQ(names_in(folder), Words{"v.json"}) << "plan writes nothing";
}

TEST(Plan, QuietLeavesTheTableAlone) {
    const Outcome outcome = plan({"-q"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    EXPECT_TRUE(says(outcome.out, "level of detail")) << outcome.out;
    EXPECT_EQ(plan({}).out, outcome.out);
}

// Small, thin, far, inside: figures, or nothing in view, but never a NaN.
TEST(Plan, OddViewsHaveFiguresOrNothingInView) {
    const std::vector<Words> views{{"--size", "1x1"},
                                   {"--size", "1x2000"},
                                   {"--size", "65500x1"},
                                   {"--size", "32x18", "--fov", "0.05"},
                                   {"--size", "32x18", "--exaggeration", "50"},
                                   {"--size", "32x18", "--refraction", "0.9"},
                                   {"--size", "32x18", "--refraction", "-1"},
                                   {"--size", "32x18", "--earth", "flat", "--precision", "naive"}};
    for (const Words& view : views) {
        SCOPED_TRACE(view[0] + " " + view[1]);
        Words words{"plan", bundled(), "--at", "36.6,-84.2", "--above", "300", "--pitch", "-20", "--json"};
        words.insert(words.end(), view.begin(), view.end());
        EXPECT_EQ(planned(run_orograph(words)).at("effects").size(), effects.size());
    }
    for (const char* above : {"0", "-50", "1e9"}) {
        SCOPED_TRACE(above);
        planned(run_orograph({"plan", bundled(), "--at", "36.6,-84.2", "--above", above, "--pitch", "-90",
                              "--size", "32x18", "--json"}));
    }
    // One row of cells, and no row at all.
    planned(run_orograph(
        {"plan", bundled(), "--bbox", "-84.3,36.6,-84.2,36.6000001", "--size", "32x18", "--json"}));
    expect_refusal(run_orograph({"plan", bundled(), "--bbox", "-84.3,36.6,-84.2999999,36.7", "--json"}),
                   no_data, {"no elevation data"});
}

TEST(Plan, ABakedRegionIsPlannedAsItsTiles) {
    const fs::path file = oro::test::scratch_folder() / "r.oro";
    ASSERT_EQ(run_orograph({"bake", bundled(), "--out", file, "-q"}).exit_code, 0);
    const auto of_file = [&] {
        return run_orograph({"plan", file, "--at", "36.6,-84.2", "--above", "300", "--heading", "200.5",
                             "--pitch", "-5", "--size", "96x54", "--json", "-q"});
    };
    json from_file = planned(of_file()), from_tiles = planned(plan({"--json", "-q"}));
    from_file.erase("view");
    from_tiles.erase("view");
    EXPECT_EQ(from_file, from_tiles);
    // Found: where the page under the eye was damaged, there was said to be no data.
    std::string bytes = bytes_of(file);
    bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 0x55);
    oro::test::write_bytes(file, bytes);
    expect_refusal(of_file(), failed, {"r.oro", "damaged at byte"});
}

TEST(Plan, BadValuesAreRefused) {
    for (const char* tolerance : {"0", "-1", "1 px px", "1e-9", "nan", "inf", "1e999", "", "px", "1m"})
        expect_refusal(plan({"--tolerance", tolerance}), usage, {"--tolerance"});
    // Here a tolerance judges what is asked for: a bundle may be.
    EXPECT_EQ(plan({"--tolerance", "1px", "--accuracy", "draft"}).exit_code, 0);
    expect_refusal(plan({"--accuracy", "fine"}), usage, {"--accuracy", "fine"});
    expect_refusal(run_orograph({"plan"}), usage, {"PATH"});
    expect_refusal(run_orograph({"plan", bundled() + ".none"}), failed, {"jacksboro.tif.none"});
}

// Found: an empty value was taken for none, and `--tau ""` planned (and drew) with the default.
TEST(Plan, EmptyValuesAreRefused) {
    for (const char* option : {"--tau", "--refraction", "--fov", "--above", "--exaggeration", "--samples",
                               "--accuracy", "--view", "--bbox", "--style"})
        expect_refusal(run_orograph({"plan", bundled(), option, ""}), usage, {option});
    expect_refusal(run_orograph({"plan", ""}), usage, {"PATH"});
}

}  // namespace
