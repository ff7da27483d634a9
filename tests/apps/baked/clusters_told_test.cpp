// What info, plan and trade tell of a region's clusters.
#include <cstdint>

#include "tests/apps/baked/clusters_baking.h"

namespace {
namespace fs = std::filesystem;
using nlohmann::json;
using oro::test::joined;
using oro::test::object_said_by;
using oro::test::Outcome;
using oro::test::run_orograph;
using oro::test::Words;

class ClustersTold : public oro::test::ClustersDrawn {};

// Triangles by level, and what a view takes by either mesh: what is then drawn, but for what ground hides.
TEST_F(ClustersTold, FiguresOfTheGraph) {
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
    const Outcome told = run_orograph(joined({"plan", out_, "-q"}, eye()));
    EXPECT_NE(told.out.find("What is in view at --tau 1, by either mesh"), std::string::npos) << told.out;
    const fs::path plain = baked();
    EXPECT_TRUE(object_said_by(joined({"plan", plain, "-q", "--json"}, eye()))["meshes"].is_null());
}

// Each tau by blocks and by clusters, the others by blocks as where there are none.
TEST_F(ClustersTold, TradeHasARowForEachTau) {
    const auto words =
        joined({"trade", out_, "--repeats", "1", "--out", folder, "--style", "default"}, eye());
    const Outcome traded = run_orograph(words);
    ASSERT_EQ(traded.exit_code, 0) << traded.err;
    for (const char* tau : {"0.5", "1", "2", "4"}) {
        EXPECT_NE(traded.out.find("clusters, tau " + std::string(tau)), std::string::npos) << traded.out;
    }
    EXPECT_EQ(traded.out.find("MORE THAN"), std::string::npos) << traded.out;
    EXPECT_EQ(traded.out.find("OVER"), std::string::npos) << traded.out;
}

}  // namespace
