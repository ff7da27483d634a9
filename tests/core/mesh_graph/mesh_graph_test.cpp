// Graphs of made meshes: what they promise, place by place, against brute force.
#include "core/mesh_graph/mesh_graph.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>

#include "tests/support/made_space_meshes.h"
#include "tests/support/mesh_cuts.h"

namespace oro {
namespace {

using namespace test;

const glm::dvec3 origin_m{4.0e6, 6.0e5, 4.9e6};

struct Built {
    MeshGraph graph;
    MeshPlaceChains chains;
};
Built built(const SpaceMesh& mesh, std::mt19937_64& random) {
    Built all;
    all.chains.places = random_places(mesh, random);
    all.graph = build_mesh_graph(mesh.vertices, mesh.triangles, origin_m, {2, 0.65, &all.chains});
    return all;
}

void expect_sound(const SpaceMesh& mesh, const MeshGraph& graph) {
    const ClusterGraph& clusters = graph.clusters;
    ASSERT_EQ(clusters.triangles.size(), graph.original_of.size());
    std::vector<int> leaves(mesh.triangles.size(), 0);
    for (const Cluster& cluster : clusters.clusters) {
        EXPECT_GE(cluster.triangles, 1U);
        EXPECT_LE(cluster.triangles, most_cluster_triangles);
        EXPECT_LE(cluster.vertices, most_cluster_vertices);
        if (cluster.made_by != no_group) continue;
        for (std::uint32_t i = 0; i < cluster.triangles; ++i)
            ++leaves[graph.original_of[cluster.first_triangle + i]];
    }
    for (const int count : leaves) ASSERT_EQ(count, 1);
    for (const ClusterGroup& group : clusters.groups) {
        EXPECT_GE(group.error_m, largest_member_error_m(clusters, group));
        for (const std::uint32_t member : clusters.members_of(group)) {
            const Cluster& cluster = clusters.clusters[member];
            if (cluster.made_by != no_group) {
                const ClusterGroup& below = clusters.groups[cluster.made_by];
                EXPECT_LT(below.level, group.level);
                EXPECT_LE(glm::distance(below.centre.m, group.centre.m) + below.radius_m,
                          group.radius_m + 1.0e-8);
            }
            for (const VertexTriangle& triangle : clusters.triangles_of(cluster))
                for (const std::uint32_t corner : triangle)
                    EXPECT_LE(glm::distance(origin_m + mesh.vertices[corner], group.centre.m),
                              group.radius_m + 1.0e-8);
        }
    }
}

CutCheck check_cuts(const SpaceMesh& mesh, const MeshGraph& graph, const MeshPlaceChains& chains, int cuts,
                    std::mt19937_64& random) {
    CutCheck check;
    for (int i = 0; i < cuts; ++i)
        check_cut(mesh, graph, chains, random_standing(graph.clusters, random), 300, random, check);
    return check;
}

void expect_bound(const SpaceMesh& mesh, unsigned seed, std::size_t most_coarsest) {
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const Built one = built(mesh, random);
    expect_sound(mesh, one.graph);
    EXPECT_LE(one.graph.clusters.levels.back().triangles_out, most_coarsest);
    const CutCheck check = check_cuts(mesh, one.graph, one.chains, 8, random);
    EXPECT_EQ(check.places, 2400U);
    EXPECT_EQ(check.places_over, 0U) << check.worst_m;
    EXPECT_EQ(check.drawn_over, 0U) << check.worst_m;
    EXPECT_EQ(check.no_link, 0U);
    EXPECT_EQ(check.open_edges, 0U);
    EXPECT_EQ(check.crowded, 0U);
}

TEST(MeshGraph, OfAHillyBallIsWithinItsErrorsAndClosed) {
    expect_bound(hilly_ball(30, 50.0), 5201, 128);
}

TEST(MeshGraph, OfATownDropsHousesWithinItsErrors) {
    expect_bound(box_town(14), 5202, 300);
}

TEST(MeshGraph, OfAFoldedSheetIsWithinItsErrors) {
    expect_bound(folded_sheet(38), 5203, 128);
}

TEST(MeshGraph, TestsByChainsCatchMutants) {
    constexpr unsigned seed = 5204;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const SpaceMesh mesh = hilly_ball(30, 50.0);
    const Built one = built(mesh, random);
    const MeshPlaceChains wrong = wrong_users(one.graph, one.chains, random);
    EXPECT_GT(check_cuts(mesh, one.graph, wrong, 8, random).places_over, 0U);
    MeshGraph less = one.graph;
    for (ClusterGroup& group : less.clusters.groups) group.error_m *= 0.5;
    const CutCheck check = check_cuts(mesh, less, one.chains, 8, random);
    EXPECT_GT(check.places_over, 0U);
    EXPECT_GT(check.drawn_over, 0U);
    MeshGraph hole = one.graph;
    hole.clusters.clusters.back().used_by = 0;
    for (Cluster& cluster : hole.clusters.clusters)
        if (cluster.made_by == no_group) {
            --cluster.triangles;
            break;
        }
    CutCheck holed;
    check_cut(mesh, hole, one.chains, std::vector<char>(hole.clusters.groups.size(), 0), 1, random, holed);
    EXPECT_GT(holed.open_edges, 0U);
}

TEST(MeshGraph, IsTheSameByAnyNumberOfThreads) {
    const SpaceMesh mesh = folded_sheet(38);
    const MeshGraph one = build_mesh_graph(mesh.vertices, mesh.triangles, origin_m, {1});
    const MeshGraph other = build_mesh_graph(mesh.vertices, mesh.triangles, origin_m, {3});
    ASSERT_EQ(one.clusters.triangles, other.clusters.triangles);
    ASSERT_EQ(one.original_of, other.original_of);
    ASSERT_EQ(one.clusters.members, other.clusters.members);
    ASSERT_EQ(one.clusters.groups.size(), other.clusters.groups.size());
    for (std::size_t i = 0; i < one.clusters.groups.size(); ++i) {
        EXPECT_EQ(one.clusters.groups[i].error_m, other.clusters.groups[i].error_m);
        EXPECT_EQ(one.clusters.groups[i].radius_m, other.clusters.groups[i].radius_m);
        EXPECT_EQ(one.clusters.groups[i].centre.m, other.clusters.groups[i].centre.m);
    }
}

TEST(MeshGraph, OfOneTriangleIsThatTriangle) {
    const std::vector<glm::dvec3> vertices{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}};
    const MeshGraph graph = build_mesh_graph(vertices, triangles, origin_m);
    ASSERT_GE(graph.clusters.groups.size(), 1U);
    EXPECT_LE(graph.largest_error_m(), 1.0e-5);
    EXPECT_EQ(graph.clusters.triangles.back(), (VertexTriangle{0, 1, 2}));
}

}  // namespace
}  // namespace oro
