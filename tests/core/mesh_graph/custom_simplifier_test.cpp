// Graphs whose groups another simplifier made coarser: the errors are bounds, whatever it does.
#include "core/mesh_graph/custom_simplifier.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/cluster_frame/cluster_cut.h"
#include "core/mesh_graph/mesh_graph.h"
#include "tests/support/made_space_meshes.h"
#include "tests/support/mesh_cuts.h"

namespace oro {
namespace {

using namespace test;

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

struct CustomGraph {
    MeshGraph graph;
    MeshPlaceChains chains;

    CustomGraph(const SpaceMesh& mesh, const CustomSimplifier& simplifier, std::mt19937_64& random) {
        chains.places = random_places(mesh, random);
        MeshGraphOptions options{2, 0.65, &chains};
        options.simplifier = &simplifier;
        graph = build_mesh_graph(mesh.vertices, mesh.triangles, {4.0e6, 6.0e5, 4.9e6}, options);
    }
    [[nodiscard]] CutCheck check(const SpaceMesh& mesh, std::mt19937_64& random) const {
        CutCheck found;
        for (int i = 0; i < 8; ++i)
            check_cut(mesh, graph, chains, random_standing(graph.clusters, random), 300, random, found);
        return found;
    }
};

Triangles all_of(const GroupToSimplify& group) {
    return {group.triangles.begin(), group.triangles.end()};
}

TEST(CustomSimplifier, ThatDoesNothingCostsNothing) {
    constexpr unsigned seed = 5211;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const SpaceMesh mesh = hilly_ball(20, 50.0);
    ASSERT_EQ(mesh.triangles.size(), 1520U);
    // Of one that gives no triangle, groups stay as they are.
    for (const CustomSimplifier& simplifier :
         {CustomSimplifier(all_of), CustomSimplifier([](const GroupToSimplify&) { return Triangles(); })}) {
        const CustomGraph made(mesh, simplifier, random);
        // Rounding adds 2 um a level.
        EXPECT_LE(made.graph.largest_error_m(),
                  2.1e-6 * static_cast<double>(made.graph.clusters.levels.size()));
        EXPECT_EQ(made.graph.clusters.levels.back().triangles_out, 1520U);
        const CutCheck check = made.check(mesh, random);
        EXPECT_EQ(check.places_over + check.drawn_over + check.no_link + check.open_edges, 0U);
    }
}

// Leaves out a tenth of what it is asked to, and makes holes with it.
Triangles with_holes(const GroupToSimplify& group) {
    Triangles left;
    const std::size_t most = (group.triangles.size() - group.aim) / 10;
    std::size_t gone = 0;
    for (const auto& corners : group.triangles) {
        const bool is_free = !group.stays(corners[0]) && !group.stays(corners[1]) && !group.stays(corners[2]);
        if (is_free && gone < most && left.size() % 7 == 3)
            ++gone;
        else
            left.push_back(corners);
    }
    return left;
}

TEST(CustomSimplifier, ThatMakesHolesIsWithinItsErrors) {
    constexpr unsigned seed = 5212;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const SpaceMesh mesh = hilly_ball(30, 50.0);
    CustomGraph made(mesh, with_holes, random);
    EXPECT_LT(made.graph.clusters.levels.back().triangles_out, mesh.triangles.size());
    // Sides are some 5 m long: the middle of a triangle that is not there is a metre or more from the next.
    EXPECT_GT(made.graph.largest_error_m(), 0.5);
    const CutCheck check = made.check(mesh, random);
    EXPECT_EQ(check.places, 2400U);
    EXPECT_EQ(check.places_over, 0U) << check.worst_m;
    EXPECT_EQ(check.drawn_over, 0U) << check.worst_m;
    EXPECT_EQ(check.no_link, 0U);
    EXPECT_GT(check.open_edges, 0U);
    for (ClusterGroup& group : made.graph.clusters.groups) group.error_m *= 0.5;
    EXPECT_GT(made.check(mesh, random).places_over, 0U);
}

// Each triangle that it made has the feature of one of the group's at its first corner.
TEST(CustomSimplifier, KeepsFeatures) {
    const SpaceMesh mesh = hilly_ball(10, 50.0);
    const auto turned = [](const GroupToSimplify& group) {
        Triangles made = all_of(group);
        for (auto& corners : made) corners = {corners[1], corners[2], corners[0]};
        made.pop_back();
        return made;
    };
    std::mt19937_64 random(5213);
    const CustomGraph made(mesh, turned, random);
    const MeshGraph& graph = made.graph;
    ASSERT_EQ(graph.original_of.size(), graph.clusters.triangles.size());
    for (std::size_t i = 0; i < graph.original_of.size(); ++i) {
        const auto& original = mesh.triangles[graph.original_of[i]];
        for (const std::uint32_t corner : graph.clusters.triangles[i])
            EXPECT_TRUE(corner == original[0] || corner == original[1] || corner == original[2]) << i;
    }
}

}  // namespace
}  // namespace oro
