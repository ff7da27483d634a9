// What `plan` tells of a view before it is drawn: every effect by name, with figures.
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/apps/program.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::no_data;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::says;
using oro::test::usage;
using oro::test::Words;

const std::set<std::string> all_effects{"no geoid",
                                        "no ellipsoid",
                                        "no curve of the Earth",
                                        "no refraction",
                                        "no double-precision posts",
                                        "no double-precision view",
                                        "no 32-bit heights",
                                        "heights in steps of 0.5 mm",
                                        "no full detail",
                                        "positions rounded to float32",
                                        "distances rounded to float32",
                                        "corners in steps of 1/256 px",
                                        "flat triangles between posts",
                                        "ground between the posts",
                                        "errors of the source"};
// As the table has them: parts of the model by what they are, errors by their names.
const Words parts{"geoid",
                  "ellipsoid",
                  "curve of the Earth",
                  "refraction",
                  "double-precision posts",
                  "double-precision view",
                  "32-bit heights",
                  "full detail"};
const Words table_errors{"heights in steps of 0.5 mm",   "positions rounded to float32",
                         "distances rounded to float32", "corners in steps of 1/256 px",
                         "flat triangles between posts", "ground between the posts"};

Outcome plan(const Words& more) {
    Words words{"plan",      "--all", bundled(), "--at", "36.6,-84.2", "--above", "300",
                "--heading", "200.5", "--pitch", "-5",   "--size",     "96x54"};
    words.insert(words.end(), more.begin(), more.end());
    return run_orograph(words);
}

// Every number in it is finite: JSON has no others, and writes null for them. `nullable` are the fields
// that say nothing where there is nothing to say.
void expect_numbers(const json& value, const std::string& name, const std::set<std::string>& nullable) {
    if (value.is_number()) {
        EXPECT_TRUE(std::isfinite(value.get<double>())) << name;
    }
    EXPECT_TRUE(!value.is_null() || nullable.contains(name)) << name << " is null";
    if (value.is_array())
        for (const json& one : value) expect_numbers(one, name, nullable);
    if (value.is_object()) {
        for (const auto& [key, one] : value.items()) expect_numbers(one, key, nullable);
    }
}

json planned(const Outcome& outcome) {
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const json said = json::parse(outcome.out, nullptr, false);
    EXPECT_TRUE(said.is_object()) << outcome.out;
    expect_numbers(
        said, "",
        {"size", "spread_px", "dominates", "dominates_kind", "modelled", "needed", "bbox", "sun", "meshes"});
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

// The words that follow a row's name: its columns.
Words columns_of(const std::string& text, const std::string& name) {
    std::istringstream rest(line_of(text, name).substr(name.size()));
    return {std::istream_iterator<std::string>(rest), {}};
}

// Three columns: in this picture, needed (or within the tolerance), and how large.
TEST(Plan, TableNamesEveryEffectWithFiguresAndWhatIsLargest) {
    const Outcome outcome = plan({"--accuracy", "draft"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    for (const Words* names : {&parts, &table_errors}) {
        for (const std::string& name : *names) {
            SCOPED_TRACE(name);
            const Words columns = columns_of(outcome.out, name);
            ASSERT_GE(columns.size(), 6U);
            for (std::size_t i = 0; i < 2; ++i)
                EXPECT_TRUE(columns[i] == "yes" || columns[i] == "no") << columns[i];
            for (std::size_t i = 2; i < 6; ++i)
                EXPECT_EQ(columns[i].find_first_not_of("<0123456789.e"), std::string::npos) << columns[i];
        }
    }
    EXPECT_TRUE(says(line_of(outcome.out, "errors of the source"), "not stated by the source"));
    EXPECT_TRUE(says(outcome.out, "96 x 54 px, 45 degrees; tolerance 1 px")) << outcome.out;
    const auto begins = [&](const std::string& name, const Words& expected) {
        const Words columns = columns_of(outcome.out, name);
        EXPECT_EQ(Words(columns.begin(), columns.begin() + 2), expected) << name;
    };
    // 4 px of detail are more than anything else that the draft leaves out.
    begins("full detail", {"no", "yes"});
    EXPECT_TRUE(
        says(outcome.out, line_of(outcome.out, "full detail") + "\n  ^ largest error of this picture\n"))
        << outcome.out;
    begins("32-bit heights", {"no", "no"});
    begins("geoid", {"yes", "no"});
    begins("refraction", {"no", "no"});
    begins("heights in steps of 0.5 mm", {"no", "yes"});
    begins("positions rounded to float32", {"yes", "yes"});
    EXPECT_EQ(columns_of(outcome.out, "this picture, but for its data").front(), "no");
    EXPECT_EQ(outcome.out.find("^ largest"), outcome.out.rfind("^ largest")) << "one of them only";
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120U) << line;
}

// Figures stand below each other by their decimal points.
TEST(Plan, FiguresAreAligned) {
    const std::string table = plan({}).out;
    std::set<std::size_t> points;
    for (const Words* names : {&parts, &table_errors}) {
        for (const std::string& name : *names) {
            const std::string line = line_of(table, name);
            const std::size_t point = line.find('.', 52);
            if (point < 62) points.insert(point);
        }
    }
    EXPECT_EQ(points.size(), 1U) << table;
}

// What this view is good to, what to use, what no setting can help.
TEST(Plan, EndsInASentence) {
    const auto end_of = [](const Words& more) {
        const std::string text = plan(more).out;
        return text.substr(text.find("\n\nGood to ") + 2);
    };
    const std::string draft = end_of({"--accuracy", "draft"});
    EXPECT_EQ(draft.rfind("Good to ", 0), 0U) << draft;
    EXPECT_TRUE(says(draft, " px where the data reach: more than the tolerance of 1 px.\n")) << draft;
    EXPECT_TRUE(says(draft, "`--accuracy balanced` makes it 0.5")) << draft;
    EXPECT_TRUE(says(draft, "px (--tau 0.5 --heights f32 --air standard)")) << draft;
    EXPECT_TRUE(says(draft, "The data themselves may be off by ")) << draft;
    EXPECT_TRUE(says(draft, " px, which no setting can help; and the source does not say")) << draft;
    const std::string balanced = end_of({"--accuracy", "balanced"});
    EXPECT_TRUE(says(balanced, ": within the tolerance of 1 px.")) << balanced;
    EXPECT_TRUE(says(balanced, "That is what `--accuracy balanced` draws, the cheapest within 1 px."))
        << balanced;
    const std::string survey = end_of({"--accuracy", "survey"});
    EXPECT_TRUE(says(survey, "The cheapest within 1 px is `--accuracy balanced`: 0.5")) << survey;
    const std::string tight = end_of({"--accuracy", "survey", "--tolerance", "0.001px"});
    EXPECT_TRUE(says(tight, "That is what `--accuracy survey` draws, and nothing else is closer.")) << tight;
    const std::string naive =
        end_of({"--accuracy", "draft", "--precision", "naive", "--tolerance", "0.02px"});
    EXPECT_TRUE(says(naive, "`--accuracy survey` makes it ")) << naive;
    EXPECT_TRUE(says(naive, ", more than the tolerance.")) << naive;
    EXPECT_TRUE(says(naive, "Leave `--precision naive` out: it alone costs ")) << naive;
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
    EXPECT_EQ(named, all_effects);
    EXPECT_EQ(said.at("in_view"), true);
    EXPECT_EQ(said.at("tolerance_px"), 1.0);
    // The eye is 300 m over the ground, and the picture's lower rim looks 5 + 22.5 degrees down.
    EXPECT_GT(said.at("nearest_m").get<double>(), 300.0);
    EXPECT_LT(said.at("nearest_m").get<double>(), 3000.0);
    EXPECT_GE(said.at("median_distance_m").get<double>(), said.at("nearest_m").get<double>());
    EXPECT_TRUE(all_effects.contains(said.at("dominates").get<std::string>()));
    EXPECT_EQ(said.at("cheapest").at("holds"), true);
    EXPECT_LE(said.at("cheapest").at("predicted_px").get<double>(), 1.0);
    EXPECT_EQ(said.at("view").at("size_px"), json({96, 54}));
    // tau bounds how far levels are off the surface; along it they move ground by little more.
    EXPECT_LE(effect_in(said, "no full detail")["size"]["worst_px"].get<double>(), 1.001);
    EXPECT_TRUE(effect_in(said, "errors of the source")["size"].is_null());
    EXPECT_EQ(effect_in(said, "ground between the posts")["limit_of_the_data"], true);
    EXPECT_EQ(effect_in(said, "no refraction")["in_picture"], true);
    EXPECT_EQ(effect_in(said, "no refraction")["modelled"], false);
    EXPECT_EQ(effect_in(said, "no geoid")["in_picture"], false);
    EXPECT_EQ(effect_in(said, "no geoid")["modelled"], true);
    EXPECT_EQ(effect_in(said, "no geoid")["needed"], false);
    // An estimate says how what it is made of spreads.
    const json sphere = effect_in(said, "no ellipsoid"), spread = sphere.at("spread_px");
    EXPECT_TRUE(spread.at("typical") <= spread.at("p99") && spread.at("p99") <= spread.at("largest"));
    EXPECT_NEAR(spread["largest"].get<double>() * 1.5, sphere["size"]["worst_px"].get<double>(), 1e-9);
    EXPECT_TRUE(effect_in(said, "no 32-bit heights").at("spread_px").is_null()) << "derived";
}

// Facts with names of their own, for programs: what is shown to people may be worded anew.
TEST(Plan, JsonHasTypedFacts) {
    const json said = planned(plan({"--json", "-q", "--earth", "flat", "--tolerance", "0.01px"}));
    std::set<std::string> kinds;
    int of_model = 0;
    for (const json& effect : said.at("effects")) {
        SCOPED_TRACE(effect.at("kind"));
        kinds.insert(effect.at("kind").get<std::string>());
        const std::string group = effect.at("group");
        EXPECT_TRUE(group == "model" || group == "drawing" || group == "data") << group;
        EXPECT_EQ(effect.at("limit_of_the_data"), group == "data");
        EXPECT_EQ(effect.at("modelled").is_boolean(), group == "model");
        EXPECT_EQ(effect.at("needed").is_boolean(), group == "model");
        EXPECT_TRUE(effect.at("meaning").get<std::string>().ends_with("."));
        EXPECT_TRUE(effect.at("measured_by").is_string());
        if (group == "model") {
            ++of_model;
            EXPECT_EQ(effect.at("needed"), !effect.at("below_tolerance").get<bool>());
        }
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"geoid", "sphere", "flat", "refraction", "float32_posts",
                                            "float32_view", "steps_i16", "detail", "steps_f32", "placement",
                                            "depth", "pixel_grid", "flat_cells", "interpolation", "source"}));
    EXPECT_EQ(of_model, 8);
    EXPECT_EQ(effect_in(said, said.at("dominates")).at("kind"), said.at("dominates_kind"));
    EXPECT_EQ(said.at("cheapest").at("left_out"), json({"flat"}));
    // A plane is no ellipsoid either, though only the plane's error counts.
    EXPECT_EQ(effect_in(said, "no ellipsoid").at("modelled"), false);
    EXPECT_EQ(effect_in(said, "no ellipsoid").at("in_picture"), false);
    EXPECT_EQ(effect_in(said, "no curve of the Earth").at("modelled"), false);
}

TEST(Plan, ItsPageExplainsEveryErrorAndColumn) {
    const std::string page =
        bytes_of(oro::test::bundled_data().parent_path() / "docs" / "commands" / "plan.md");
    for (const json& effect : planned(plan({"--json", "-q"})).at("effects")) {
        const std::string row = "| " + effect.at("effect").get<std::string>() + " (`" +
                                effect.at("kind").get<std::string>() + "`) | " +
                                effect.at("meaning").get<std::string>() + " |";
        EXPECT_TRUE(says(page, row)) << row;
    }
    for (const char* word : {"**in this picture**", "**needed for 1 px**", "**within**", "**worst**",
                             "**typical**", "**this picture, but for its data**"})
        EXPECT_TRUE(says(page, word)) << word;
}

TEST(Plan, ToleranceJudges) {
    const json wide = planned(plan({"--json", "--tolerance", "1000px"}));
    const json narrow = planned(plan({"--json", "--tolerance", "0.01px"}));
    EXPECT_EQ(narrow.at("tolerance_px"), 0.01);
    int changed = 0;
    for (const std::string& effect : all_effects) {
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
    EXPECT_EQ(columns_of(table.out, "double-precision view")[0], "yes") << table.out;
    EXPECT_EQ(columns_of(table.out, "double-precision view")[1], "yes") << table.out;
    EXPECT_EQ(columns_of(table.out, "full detail")[0], "no") << table.out;
    EXPECT_EQ(columns_of(table.out, "full detail")[1], "yes") << table.out;
    EXPECT_TRUE(says(table.out, "for 0.01 px")) << table.out;
}

TEST(Plan, NothingInViewIsSaid) {
    const Words sky{"plan", bundled(), "--at", "36.6,-84.2", "--above",
                    "300",  "--pitch", "90",   "--size",     "96x54"};
    const Outcome table = run_orograph(sky);
    EXPECT_EQ(table.exit_code, 0) << table.err;
    EXPECT_EQ(table.out,
              "Eye: 36.600000 -84.200000, H 688 m, 300 m above the ground, towards 0 degrees (N).\n"
              "nothing of the region is in view: there is nothing to predict\n");
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
    EXPECT_EQ(effect_in(survey, "no full detail").at("in_picture"), false);
    expect_refusal(run_orograph({"plan", "--view", folder / "v.json", "--at", "36.6,-84.2"}), usage,
                   {"--view", "--at"});
    EXPECT_EQ(names_in(folder), Words{"v.json"}) << "plan writes nothing";
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
        EXPECT_EQ(planned(run_orograph(words)).at("effects").size(), all_effects.size());
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
