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

// 2,880 triangles, 847 of which stayed where vertices between three sheets could not go.
TEST(MeshGraph, OfWallsOnHillsIsWithinItsErrorsAndCoarse) {
    const SpaceMesh mesh = walled_hills(30);
    ASSERT_EQ(mesh.triangles.size(), 2880U);
    expect_bound(mesh, 5207, 128);
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

struct Town {
    SpaceMesh mesh = box_town(14);
    MeshGround ground = hills_below_town(14);
    MeshGraph graph;
    MeshPlaceChains chains;

    explicit Town(std::mt19937_64& random) {
        chains.places = random_places(mesh, random);
        MeshGraphOptions options{2, 0.65, &chains};
        options.ground = &ground;
        graph = build_mesh_graph(mesh.vertices, mesh.triangles, origin_m, options);
    }
    [[nodiscard]] CutCheck check(const MeshGraph& of, const std::vector<char>& stands,
                                 std::mt19937_64& random) const {
        CutCheck found;
        check_cut(mesh, of, chains, stands, 300, random, found, &ground);
        return found;
    }
};

TEST(MeshGraph, OfATownOnTheGroundEndsAsOneCluster) {
    constexpr unsigned seed = 5205;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const Town town(random);
    expect_sound(town.mesh, town.graph);
    // 2,352 triangles of 196 houses, up to 16 m high and 1.5 m in the ground; without it 96 m.
    EXPECT_LE(town.graph.clusters.levels.back().triangles_out, 128U);
    EXPECT_LT(town.graph.largest_error_m(), 17.5);
    std::uint64_t on_ground = 0;
    for (int i = 0; i < 12; ++i) {
        const std::vector<char> stands = i == 0 ? std::vector<char>(town.graph.clusters.groups.size(), 1)
                                                : random_standing(town.graph.clusters, random);
        const CutCheck check = town.check(town.graph, stands, random);
        EXPECT_EQ(check.places_over, 0U) << check.worst_m;
        EXPECT_EQ(check.drawn_over, 0U) << check.worst_m;
        EXPECT_EQ(check.no_link, 0U);
        EXPECT_EQ(check.open_edges, 0U);
        on_ground += check.on_ground;
    }
    EXPECT_GT(on_ground, 200U);
}

TEST(MeshGraph, TestsByChainsCatchHousesThatAreDroppedForNothing) {
    constexpr unsigned seed = 5206;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    Town town(random);
    const std::vector<char> all(town.graph.clusters.groups.size(), 1);
    const std::vector<MeshGraph> mutants = dropped_for_nothing(town.graph, town.chains);
    std::size_t caught = 0;
    for (const MeshGraph& mutant : mutants) {
        std::uint64_t over = 0;
        for (int i = 0; i < 20; ++i) over += town.check(mutant, all, random).places_over;
        caught += over > 0 ? 1U : 0U;
    }
    // An error may also be that of what a group moved, or for the breadth of what it dropped.
    std::printf("%zu of %zu mutants caught\n", caught, mutants.size());
    EXPECT_GE(mutants.size(), 4U);
    EXPECT_GE(2 * caught, mutants.size());
    // Ground that lies 2 m deeper than the builder was given.
    for (auto& triangle : town.ground.triangles)
        for (glm::dvec3& corner : triangle) corner.z -= 2.0;
    EXPECT_GT(town.check(town.graph, all, random).places_over, 0U);
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
