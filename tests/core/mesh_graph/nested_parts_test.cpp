// Graphs whose groups keep within parts of the mesh: any choice of parts is a cut, within its errors.
#include "core/mesh_graph/nested_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "core/mesh_graph/mesh_graph.h"
#include "tests/support/made_space_meshes.h"
#include "tests/support/mesh_cuts.h"

namespace oro {
namespace {

using namespace test;

constexpr int depth = 2;

std::vector<glm::dvec3> middles_of(const SpaceMesh& mesh) {
    std::vector<glm::dvec3> middles;
    for (const auto& [a, b, c] : mesh.triangles)
        middles.push_back((mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3.0);
    return middles;
}

TEST(NestedParts, AreAsLargeAsEachOther) {
    const SpaceMesh mesh = hilly_ball(30, 50.0);
    const NestedParts parts = nested_parts(middles_of(mesh), depth);
    std::vector<std::size_t> count(16);
    for (const std::uint32_t part : parts.part_of) ++count.at(part);
    // 3,480 triangles: 217.5 a part.
    for (const std::size_t triangles : count) EXPECT_TRUE(triangles == 217 || triangles == 218) << triangles;
    EXPECT_EQ((NestedPart{2, 13}.above(1)), (NestedPart{1, 3}));
    EXPECT_EQ(common_part({2, 13}, {2, 14}), (NestedPart{1, 3}));
    EXPECT_EQ(common_part({2, 13}, {1, 3}), (NestedPart{1, 3}));
    EXPECT_EQ(common_part({2, 13}, {2, 3}), NestedPart{});
    EXPECT_EQ(nested_parts(middles_of(mesh), 0).part_of, std::vector<std::uint32_t>(3480, 0));
}

// Two quads side by side, a part each: vertices 1 and 4 lie in both.
TEST(NestedParts, CountTheirBorders) {
    NestedParts parts{1, {0, 0, 1, 1}};
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 3}, {1, 4, 3}, {1, 2, 4}, {2, 5, 4}};
    EXPECT_EQ(coarse_triangles(parts, triangles, 1, 10), 4U * 10U + 3U * 4U);
    EXPECT_EQ(coarse_triangles(parts, triangles, 0, 10), 10U);
}

// The smallest part that has all that a group is made from.
std::vector<NestedPart> parts_of_groups(const MeshGraph& graph, const NestedParts& parts) {
    std::vector<NestedPart> found;
    for (const ClusterGroup& group : graph.clusters.groups) {
        NestedPart part{-1, 0};
        for (const std::uint32_t member : graph.clusters.members_of(group)) {
            const Cluster& cluster = graph.clusters.clusters[member];
            for (std::uint32_t i = 0; i < cluster.triangles; ++i) {
                const NestedPart one = cluster.made_by == no_group
                                           ? parts.smallest(graph.original_of[cluster.first_triangle + i])
                                           : found[cluster.made_by];
                part = part.depth < 0 ? one : common_part(part, one);
            }
        }
        found.push_back(part);
    }
    return found;
}

TEST(MeshGraphInParts, GroupsKeepWithinThem) {
    constexpr unsigned seed = 5231;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const SpaceMesh mesh = hilly_ball(40, 50.0);
    const NestedParts parts = nested_parts(middles_of(mesh), depth);
    MeshPlaceChains chains;
    chains.places = random_places(mesh, random);
    MeshGraphOptions options{2, 0.65, &chains};
    options.parts = &parts;
    options.part_triangles = 200;
    const MeshGraph graph = build_mesh_graph(mesh.vertices, mesh.triangles, {4.0e6, 6.0e5, 4.9e6}, options);
    const std::vector<NestedPart> of_groups = parts_of_groups(graph, parts);
    std::set<std::uint32_t> of_depth_1;
    int last = depth;
    for (std::size_t i = 0; i < of_groups.size(); ++i) {
        if (of_groups[i].depth >= 1) of_depth_1.insert(of_groups[i].above(1).number);
        EXPECT_TRUE(graph.clusters.groups[i].level > 1 || of_groups[i].depth >= 1);
        last = of_groups[i].depth;
    }
    EXPECT_EQ(of_depth_1.size(), 4U);
    EXPECT_EQ(last, 0);
    EXPECT_LE(graph.clusters.levels.back().triangles_out, 128U);
    // Of some parts of depth 1 all groups are selected, of others none.
    CutCheck check;
    for (unsigned choice = 0; choice < 16; ++choice) {
        std::vector<char> selected;
        for (const NestedPart& part : of_groups)
            selected.push_back(part.depth >= 1 && (choice >> part.above(1).number & 1U) != 0 ? 1 : 0);
        check_cut(mesh, graph, chains, selected, 300, random, check);
    }
    EXPECT_EQ(check.places, 4800U);
    EXPECT_EQ(check.places_over, 0U) << check.worst_m;
    EXPECT_EQ(check.drawn_over, 0U) << check.worst_m;
    EXPECT_EQ(check.no_link, 0U);
    EXPECT_EQ(check.open_edges, 0U);
    EXPECT_EQ(check.crowded, 0U);
}

}  // namespace
}  // namespace oro
