// What info, plan and trade tell of a region's clusters.
#include <cstdint>
#include <string>

#include "tests/apps/baked/clusters_baking.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::expect_refusal;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

std::string with_commas(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t at = digits.size(); at > 3;) digits.insert(at -= 3, ",");
    return digits;
}

class ClustersReported : public oro::test::ClustersDrawn {};

// Triangles by level, and what a view takes by either mesh: what is then drawn, but for what ground hides.
TEST_F(ClustersReported, FiguresOfTheGraph) {
    const json info = object_said_by({"info", out_, "--json"})["file"]["clusters"];
    const json& levels = info["by_level"];
    ASSERT_EQ(levels.size(), info["levels"].get<std::size_t>() + 1);
    std::uint64_t above = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        EXPECT_EQ(levels[i]["level"], i);
        if (i == 0) continue;
        above += levels[i]["triangles"].get<std::uint64_t>();
        EXPECT_LE(levels[i]["triangles"], levels[i - 1]["triangles"]);
        EXPECT_GE(levels[i]["largest_error_m"], levels[i - 1]["largest_error_m"]);
    }
    EXPECT_EQ(above, info["triangles"]);
    EXPECT_NE(run_orograph({"info", out_}).out.find("error up to"), std::string::npos);
    const json meshes = object_said_by(joined({"plan", out_, "-q", "--json", "--tau", "2"}, eye()))["meshes"];
    EXPECT_LT(shot({"--tau", "2"})["triangles"]["drawn"], meshes["clusters"]["triangles"]) << "hidden ground";
    const Words down{"--at", "36.53,-84.35", "--above", "100000", "--pitch",
                     "-90",  "--size",       "240x160", "--tau",  "0.25"};
    const json planned = object_said_by(joined({"plan", out_, "-q", "--json"}, down))["meshes"]["clusters"];
    EXPECT_EQ(planned["triangles"],
              object_said_by(joined({"shot", out_, "--out", picture_, "-q", "--overwrite", "--json"},
                                    down))["triangles"]["drawn"])
        << "nothing is hidden where all is seen from above";
    EXPECT_LT(meshes["clusters"]["triangles"], meshes["blocks"]["triangles"]);
    for (const char* mesh : {"clusters", "blocks"}) {
        EXPECT_LE(meshes[mesh]["worst_px"], 2.0) << mesh;
        EXPECT_GT(meshes[mesh]["worst_px"], 0.5) << mesh;
        EXPECT_GT(meshes[mesh]["worst_m"], 0.0) << mesh;
    }
    const Outcome reported = run_orograph(joined({"plan", out_, "-q", "--all"}, eye()));
    EXPECT_NE(reported.out.find("What is in view at --tau 1, by either mesh"), std::string::npos)
        << reported.out;
    EXPECT_NE(reported.out.find("the sum, are of blocks"), std::string::npos) << reported.out;
    const Outcome by_blocks = run_orograph(joined({"plan", out_, "-q", "--all", "--mesh", "grid"}, eye()));
    EXPECT_EQ(by_blocks.out.find("the sum, are of blocks"), std::string::npos) << by_blocks.out;
    const Outcome checked = run_orograph({"info", out_, "--check"});
    std::uint64_t groups = 0;
    for (const json& level : levels) groups += level["groups"].get<std::uint64_t>();
    EXPECT_NE(checked.out.find("check: every page was read, and is as it was written; so " +
                               std::to_string(groups) + " groups of clusters\n"),
              std::string::npos)
        << groups << checked.out;
    const fs::path plain = baked();
    EXPECT_TRUE(object_said_by(joined({"plan", plain, "-q", "--json"}, eye()))["meshes"].is_null());
}

// Found: of a file of 5.66 MB, 1.78 MB were told, the grid's.
TEST_F(ClustersReported, TheSizeIsTheWholeFiles) {
    const json file = object_said_by({"info", out_, "--json"})["file"];
    EXPECT_EQ(file["bytes"], fs::file_size(out_));
    const std::uint64_t grid = file["grid_bytes"].get<std::uint64_t>(),
                        clusters = file["clusters"]["bytes"].get<std::uint64_t>();
    EXPECT_LT(grid, fs::file_size(out_) / 2);
    EXPECT_NEAR(static_cast<double>(grid + clusters), static_cast<double>(fs::file_size(out_)), 100.0)
        << "header";
    const Outcome reported = run_orograph({"info", out_});
    EXPECT_NE(reported.out.find("\n  size        " + with_commas(fs::file_size(out_)) +
                                " bytes: " + with_commas(grid) + " of the grid ("),
              std::string::npos)
        << reported.out;
}

// As shot refuses it, and in its words; and one level, of which nothing is promised.
TEST_F(ClustersReported, PlanRefusesWhatIsNotDrawn) {
    const auto plan = [&](const fs::path& region, const Words& more) {
        return run_orograph(joined(joined({"plan", region, "-q", "--json"}, eye()), more));
    };
    const fs::path plain = baked();
    const std::string none =
        "the region has no clusters: bake it with --mesh clusters, and draw the whole .oro file";
    const Words plain_shot = joined({"shot", plain, "-q", "--out", folder / "x.png"}, eye());
    for (const auto& [more, line] :
         {std::pair{Words{"--mesh", "clusters"},
                    "--mesh clusters: " + none + "; --mesh grid draws it by blocks"},
          {Words{"--mesh-level", "3"}, "--mesh-level: " + none},
          {Words{"--show", "groups"}, "--show groups: " + none}}) {
        const Outcome refused_plan = plan(plain, more);
        EXPECT_EQ(refused_plan.exit_code, 2);
        EXPECT_EQ(refused_plan.out, "");
        EXPECT_EQ(refused_plan.err, "orograph: " + line + "\n");
        EXPECT_EQ(run_orograph(joined(plain_shot, more)).err, refused_plan.err);
    }
    expect_refusal(plan(out_, {"--mesh", "grid", "--show", "groups"}), 2, {"--show groups", "--mesh grid"});
    expect_refusal(plan(out_, {"--mesh-level", "3"}), 2,
                   {"--mesh-level 3: ", "plan tells what --tau promises"});
    EXPECT_EQ(json::parse(plan(out_, {}).out)["view"]["mesh"], "clusters");
    EXPECT_FALSE(json::parse(plan(out_, {"--mesh", "grid"}).out)["view"].contains("mesh"));
    shot({"--mesh-level", "3"});
    expect_refusal(run_orograph({"plan", "--view", picture_, "-q"}), 2, {"--mesh-level 3: "});
    EXPECT_EQ(run_orograph({"plan", "--view", picture_, "--tau", "1", "-q"}).exit_code, 0);
}

// Each tau by blocks and by clusters, the others by blocks as where there are none.
TEST_F(ClustersReported, TradeHasARowForEachTau) {
    const auto words =
        joined({"trade", out_, "--repeats", "1", "--out", folder, "--style", "default"}, eye());
    const Outcome traded = run_orograph(words);
    ASSERT_EQ(traded.exit_code, 0) << traded.err;
    for (const char* tau : {"0.5", "1", "2", "4"}) {
        const std::string row = "clusters, tau " + std::string(tau);
        EXPECT_NE(traded.out.find(" " + row), std::string::npos) << traded.out;
        // Of what was predicted: nothing.
        const std::size_t at = traded.out.find("\n" + row + " ");
        ASSERT_NE(at, std::string::npos) << traded.out;
        const std::size_t column = traded.out.find_first_not_of(' ', at + 1 + row.size());
        EXPECT_EQ(traded.out.substr(column, 2), "- ") << traded.out;
    }
    EXPECT_EQ(traded.out.find("MORE THAN"), std::string::npos) << traded.out;
    EXPECT_EQ(traded.out.find("OVER"), std::string::npos) << traded.out;
}

}  // namespace
