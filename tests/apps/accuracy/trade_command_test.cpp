// `trade` as users run it: its files, and what it refuses before it draws anything.
#include <gtest/gtest.h>

#include <algorithm>
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
using oro::test::bundled;
using oro::test::bytes_of;
using oro::test::Circumstances;
using oro::test::expect_refusal;
using oro::test::failed;
using oro::test::names_in;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::usage;
using oro::test::Words;
using oro::test::write_bytes;

class TradeCommand : public testing::Test {
  protected:
    const fs::path folder = oro::test::scratch_folder();

    Outcome trade(const Words& more) const {
        Words words{"trade", bundled(), "--repeats", "1", "--out", folder.string()};
        words.insert(words.end(), more.begin(), more.end());
        return run_orograph(words);
    }
};

// Lines of a CSV file, each split at commas that stand outside of quotes.
std::vector<Words> table_of(const std::string& csv) {
    std::vector<Words> table(1, Words(1));
    bool quoted = false;
    for (const char c : csv) {
        if (c == '"') {
            quoted = !quoted;
        } else if (quoted || (c != ',' && c != '\r' && c != '\n')) {
            table.back().back() += c;
        } else if (c == ',') {
            table.back().emplace_back();
        } else if (c == '\n') {
            table.emplace_back(1);
        }
    }
    table.pop_back();
    return table;
}

// What a page holds for its script.
nlohmann::json data_of(const std::string& page) {
    const std::string begin = "<script type=\"application/json\" id=\"report\">";
    const std::size_t from = page.find(begin) + begin.size();
    nlohmann::json data =
        nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from), nullptr, false);
    EXPECT_TRUE(data.is_object());
    return data;
}

void expect_numbers(const Words& header, const Words& row) {
    ASSERT_EQ(row.size(), header.size());
    for (std::size_t i = 2; i < row.size(); ++i)
        EXPECT_EQ(row[i].find_first_not_of("0123456789.e+-"), std::string::npos)
            << header[i] << " " << row[i];
}

TEST_F(TradeCommand, WritesATableAndAPage) {
    const Outcome outcome = trade({"--views", "2", "--size", "96x54"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(names_in(folder), (Words{"trade.csv", "trade.html"}));
    EXPECT_NE(outcome.err.find("trade.html"), std::string::npos) << outcome.err;
    const std::vector<Words> table = table_of(bytes_of(folder / "trade.csv"));
    EXPECT_EQ(table[0][0], "view");
    EXPECT_EQ(table[0][1], "setting");
    EXPECT_EQ(Words(table[0].begin() + 2, table[0].begin() + 6),
              (Words{"first_gpu_ms", "first_triangles", "settled_gpu_ms", "settled_triangles"}));
    std::set<std::string> views, settings;
    for (std::size_t i = 1; i < table.size(); ++i) {
        expect_numbers(table[0], table[i]);
        views.insert(table[i][0]);
        settings.insert(table[i][1]);
    }
    EXPECT_EQ(views.size(), 2U);
    EXPECT_EQ(table.size() - 1, views.size() * settings.size());
    const std::string page = bytes_of(folder / "trade.html");
    for (const char* setting :
         {"full detail", "tau 0.5", "tau 1", "tau 2", "tau 4", "draft", "balanced", "survey"}) {
        EXPECT_TRUE(settings.contains(setting)) << setting;
        EXPECT_NE(outcome.out.find(setting), std::string::npos) << setting << " in\n" << outcome.out;
        EXPECT_NE(page.find(setting), std::string::npos) << setting;
    }
    for (const char* line : {"* unbeaten: ", "\nfirst picture: ", "\nsettled: "})
        EXPECT_NE(outcome.out.find(line), std::string::npos) << line << outcome.out;
    EXPECT_NE(outcome.out.find("96 x 54 px"), std::string::npos) << outcome.out;
    const nlohmann::json data = data_of(page);
    EXPECT_EQ(data.at("shots").size(), table.size() - 1);
    EXPECT_EQ(data.at("settings").size(), settings.size());
    for (const char* state : {"first", "settled"}) {
        EXPECT_GT(data.at("settings")[0].at(state).at("triangles"), 0) << state;
        EXPECT_GT(data.at("shots")[0].at(state).at("gpu_ms"), 0.0) << state;
    }
    EXPECT_EQ(data.dump().find("NaN"), std::string::npos);
    for (const char* elsewhere : {"src=\"http", "href=\"http", "url(http", "@import"})
        EXPECT_EQ(page.find(elsewhere), std::string::npos) << elsewhere;
    EXPECT_NE(page.find("--views 2 --size 96x54"), std::string::npos) << "the command that made it";
}

// Waves of 500 m up and down and 5,000 m long: between posts 92.63 m apart the ground's crest is 500 m (1 -
// cos(pi 92.63 / 5000)) = 0.846 m over the straight line, by calculus; of thousands of
// places the worst comes within some 5 % of that. Predicted is 1.5 times what the posts
// show.
TEST_F(TradeCommand, HoldsMadeGroundAgainstItsRule) {
    const Outcome outcome = run_orograph(
        {"trade", "made:sine?H=0:1000&length=5000&azimuth=0&spacing=3s&box=8,46,8.2,46.2", "--at", "46.1,8.1",
         "--above", "8000", "--pitch", "-90", "--size", "96x54", "--repeats", "1", "--out", folder.string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const nlohmann::json page = data_of(bytes_of(folder / "trade.html"));
    int found = 0;
    for (const nlohmann::json& effect : page.at("effects")) {
        if (effect.at("name") != "ground between the posts") continue;
        ++found;
        EXPECT_EQ(effect.at("remark"), "held against the rule of made terrain");
        EXPECT_NEAR(effect.at("measured_m").get<double>(), 0.82, 0.03);
        EXPECT_GT(effect.at("predicted_m").get<double>(), 0.846);
    }
    EXPECT_EQ(found, 1);
}

// One name for a part of the model: "geoid" in plan's table, "no geoid" wherever a picture is without it.
TEST_F(TradeCommand, CallsPartsOfTheModelAsPlanDoes) {
    const Words view{bundled(), "--at", "36.6,-84.2", "--above", "300", "--size", "64x36", "-q"};
    const auto with_view = [&](Words words) {
        words.insert(words.end(), view.begin(), view.end());
        return run_orograph(words);
    };
    const std::string plan = with_view({"plan", "--all"}).out;
    const nlohmann::json planned = nlohmann::json::parse(with_view({"plan", "--json"}).out, nullptr, false);
    const Outcome outcome = with_view({"trade", "--repeats", "1", "--out", folder.string()});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string csv = bytes_of(folder / "trade.csv");
    const nlohmann::json page = data_of(bytes_of(folder / "trade.html"));
    std::set<std::string> settings, effects;
    for (const nlohmann::json& one : page.at("settings")) settings.insert(one.at("name"));
    for (const nlohmann::json& one : page.at("effects")) effects.insert(one.at("name"));
    int of_model = 0;
    for (const nlohmann::json& effect : planned.at("effects")) {
        const std::string name = effect.at("effect");
        SCOPED_TRACE(name);
        if (effect.at("group") != "model") {
            EXPECT_NE(plan.find("\n" + name + "  "), std::string::npos) << plan;
            continue;
        }
        ++of_model;
        ASSERT_EQ(name.rfind("no ", 0), 0U);
        EXPECT_NE(plan.find("\n" + name.substr(3) + "  "), std::string::npos) << plan;
        const std::string setting = effect.at("kind") == "detail" ? "tau 1" : name;
        EXPECT_TRUE(settings.contains(setting));
        EXPECT_TRUE(effects.contains(setting));
        EXPECT_NE(csv.find(setting), std::string::npos) << csv;
        EXPECT_NE(outcome.out.find(" " + setting + "  "), std::string::npos) << outcome.out;
        EXPECT_NE(outcome.out.find("\n" + setting + "  "), std::string::npos) << outcome.out;
    }
    EXPECT_EQ(of_model, 8);
    // Every setting has a prediction under its own name.
    for (const std::string& setting : settings) EXPECT_TRUE(effects.contains(setting)) << setting;
}

TEST_F(TradeCommand, AViewOfTheSkyHasNoErrorsToTell) {
    const Outcome outcome =
        trade({"-q", "--at", "36.6,-84.2", "--above", "300", "--pitch", "90", "--size", "16x9"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("n/a"), std::string::npos) << outcome.out;
    const std::vector<Words> table = table_of(bytes_of(folder / "trade.csv"));
    ASSERT_GT(table.size(), 10U);
    for (std::size_t i = 1; i < table.size(); ++i) expect_numbers(table[0], table[i]);
    EXPECT_EQ(data_of(bytes_of(folder / "trade.html")).dump().find("nan"), std::string::npos);
}

TEST_F(TradeCommand, ReplacesOnlyWhenTold) {
    for (const char* name : {"trade.csv", "trade.html"}) {
        SCOPED_TRACE(name);
        write_bytes(folder / name, "mine");
        expect_refusal(trade({"--size", "16x9", "--views", "1"}), failed, {name, "--overwrite"});
        EXPECT_EQ(bytes_of(folder / name), "mine");
        EXPECT_EQ(names_in(folder), Words{name}) << "refused before anything was written";
        fs::remove(folder / name);
    }
    write_bytes(folder / "trade.csv", "mine");
    const Outcome outcome = trade({"--size", "16x9", "--views", "1", "--overwrite", "-q"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(bytes_of(folder / "trade.csv").rfind("view,setting,", 0), 0U);
    EXPECT_EQ(names_in(folder), (Words{"trade.csv", "trade.html"}));
}

TEST_F(TradeCommand, FoldersThatAreNone) {
    write_bytes(folder / "file", "mine");
    expect_refusal(run_orograph({"trade", bundled(), "--out", folder / "missing" / "deeper"}), failed,
                   {folder / "missing" / "deeper", "is no folder, nor can be made: No such file"});
    for (const fs::path& out : {folder / "file", fs::path("/dev/null")})
        expect_refusal(run_orograph({"trade", bundled(), "--out", out}), failed, {out, "is no folder"});
    expect_refusal(run_orograph({"trade", bundled(), "--out", ""}), usage, {"--out"});
    ASSERT_TRUE(oro::test::permissions_bind()) << "this process cannot be made to heed permissions";
    Circumstances bound;
    bound.bound_by_permissions = true;
    fs::create_directory(folder / "locked");
    fs::permissions(folder / "locked", fs::perms::owner_read | fs::perms::owner_exec);
    expect_refusal(run_orograph({"trade", bundled(), "--out", folder / "locked"}, bound), failed,
                   {"locked", "ermission"});
    EXPECT_EQ(bytes_of(folder / "file"), "mine");
}

TEST_F(TradeCommand, MakesItsFolder) {
    const fs::path made = folder / "new";
    // One that comes to nothing leaves none.
    expect_refusal(run_orograph({"trade", bundled() + ".none", "--out", made}), failed, {".none"});
    EXPECT_EQ(names_in(folder), Words{});
    const Outcome outcome = run_orograph(
        {"trade", bundled(), "--views", "1", "--repeats", "1", "--size", "64x36", "--out", made, "-q"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(names_in(made), (Words{"trade.csv", "trade.html"}));
    std::vector<std::string> limits;
    const std::size_t errors = outcome.out.find("\nHow close "),
                      predictions = outcome.out.find("\nWhat was predicted ");
    ASSERT_LT(errors, predictions) << outcome.out;
    std::istringstream lines(outcome.out.substr(errors, predictions - errors));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        Words row{std::istream_iterator<std::string>(words), {}};
        if (row.size() > 2 && row[0] == "*") row.erase(row.begin());
        for (const char* name : {"full", "tau", "balanced", "survey", "draft"}) {
            if (row.size() < 7 || row[0] != name) continue;
            limits.push_back(row.back());
        }
    }
    // The draft has none, as it leaves refraction out and rounds heights: its skyline stands there.
    ASSERT_EQ(limits.size(), 8U) << outcome.out;
    const std::string draft = limits[5];
    EXPECT_NE(draft, "4.05");
    limits.erase(limits.begin() + 5);
    EXPECT_EQ(limits, (Words{"0.05", "0.55", "1.05", "2.05", "4.05", "0.55", "0.05"})) << outcome.out;
}

TEST_F(TradeCommand, RefusesWhatItTriesItself) {
    const std::vector<Words> own{{"--tau", "1"},          {"--earth", "flat"},    {"--refraction", "0.1"},
                                 {"--geoid", "none"},     {"--heights", "i16"},   {"--precision", "naive"},
                                 {"--accuracy", "draft"}, {"--tolerance", "1px"}, {"--air", "standard"},
                                 {"--mesh", "grid"},      {"--mesh-level", "3"}};
    for (const Words& option : own) expect_refusal(trade(option), usage, {"trade", option[0]});
    for (const Words& bad :
         {Words{"--views", "0"}, Words{"--views", "-1"}, Words{"--views", "1001"}, Words{"--views", "nan"},
          Words{"--views", "1.5"}, Words{"--views", ""}, Words{"--size", "0x0"}})
        expect_refusal(trade(bad), usage, {bad[0]});
    expect_refusal(run_orograph({"trade", bundled(), "--repeats", "0"}), usage, {"--repeats"});
    expect_refusal(run_orograph({"trade", "--out", folder}), usage, {"PATH"});
    EXPECT_EQ(names_in(folder), Words{});
}

}  // namespace
