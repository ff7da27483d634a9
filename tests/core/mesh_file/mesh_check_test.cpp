// Errors of stored meshes, measured again: sound ones pass, and files that lie are refused.
#include "core/mesh_file/mesh_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "core/mesh_file/mesh_bytes.h"
#include "tests/support/made_space_meshes.h"

namespace oro {
namespace {

using namespace test;

StoredMesh stored_of(const SpaceMesh& mesh, const MeshGround* ground = nullptr) {
    std::vector<LatticeSteps> places;
    for (const glm::dvec3& at : mesh.vertices)
        places.push_back(
            {std::llround(2048.0 * at.x), std::llround(2048.0 * at.y), std::llround(2048.0 * at.z)});
    MeshGraphOptions options{2};
    options.ground = ground;
    const MeshGraph graph = build_mesh_graph(mesh.vertices, mesh.triangles, {0.0, 0.0, 0.0}, options);
    const auto bytes = mesh_to_bytes({{}, places, {}, 0, graph});
    EXPECT_TRUE(bytes.ok());
    StoredMesh stored;
    EXPECT_FALSE(mesh_from_bytes(*bytes, stored));
    return stored;
}

TEST(MeshCheck, PassesWhatTheBuilderMade) {
    for (const SpaceMesh& mesh : {hilly_ball(24, 50.0), box_town(9), folded_sheet(30)}) {
        const auto wrong = understated_error(stored_of(mesh), 2);
        EXPECT_FALSE(wrong) << *wrong;
    }
}

TEST(MeshCheck, FindsALoweredError) {
    const StoredMesh mesh = stored_of(hilly_ball(24, 50.0));
    const std::size_t groups = mesh.graph.clusters.groups.size();
    int found = 0;
    for (std::size_t i = 0; i < groups; ++i) {
        StoredMesh lying = mesh;
        ClusterGroup& group = lying.graph.clusters.groups[i];
        group.error_m *= 0.7;
        const auto wrong = understated_error(lying, 1);
        found += wrong ? 1 : 0;
        if (wrong) {
            EXPECT_NE(wrong->find("states an error of"), std::string::npos) << *wrong;
        }
    }
    // An error may be that of a group below, and larger than its own.
    EXPECT_GE(found, static_cast<int>(groups) * 3 / 4) << "of " << groups;
}

TEST(MeshCheck, HoldsWhatWasDroppedAgainstTheGround) {
    MeshGround ground = hills_below_town(12);
    ground.off_m = 0.002;
    const StoredMesh mesh = stored_of(box_town(12), &ground);
    const auto wrong = understated_error(mesh, 2, &ground);
    EXPECT_FALSE(wrong) << *wrong;
    EXPECT_TRUE(understated_error(mesh, 2)) << "without ground";
    for (auto& triangle : ground.triangles)
        for (glm::dvec3& corner : triangle) corner.z -= 2.0;
    EXPECT_TRUE(understated_error(mesh, 2, &ground)) << "with ground that lies deeper";
}

// The check gives each place of the mesh to the group that the builder gave it to. By any other way the bound
// of some group may not hold: a way of its own refused one of each of these.
TEST(MeshCheck, GoesTheBuildersWayThroughTowns) {
    for (const unsigned seed : {5U, 7U}) {
        TownOnHills town = town_on_hills(1800, seed);
        const StoredMesh mesh = stored_of(town.houses, &town.ground);
        const auto wrong = understated_error(mesh, 2, &town.ground);
        EXPECT_FALSE(wrong) << "seed " << seed << ": " << *wrong;
        // Nor does the way depend on the order that triangles come in, nor on the corner each begins with.
        std::reverse(town.ground.triangles.begin(), town.ground.triangles.end());
        for (auto& [a, b, c] : town.ground.triangles) std::swap(a, b), std::swap(a, c);
        const auto again = understated_error(mesh, 2, &town.ground);
        EXPECT_FALSE(again) << "seed " << seed << ", ground in another order: " << *again;
    }
}

TEST(MeshCheck, FindsADropThatCostsNothing) {
    const MeshGround ground = hills_below_town(12);
    const StoredMesh mesh = stored_of(box_town(12), &ground);
    std::size_t tried = 0, found = 0;
    for (std::size_t i = 0; i < mesh.graph.clusters.groups.size(); ++i) {
        StoredMesh lying = mesh;
        ClusterGroup& group = lying.graph.clusters.groups[i];
        const double below_m = largest_member_error_m(lying.graph.clusters, group);
        if (group.error_m <= 1.01 * below_m + 0.01) continue;
        group.error_m = below_m;
        ++tried, found += understated_error(lying, 2, &ground) ? 1U : 0U;
    }
    EXPECT_GE(tried, 3U);
    EXPECT_EQ(found, tried);
}

TEST(MeshCheck, FindsAHole) {
    StoredMesh mesh = stored_of(hilly_ball(24, 50.0));
    ClusterGraph& graph = mesh.graph.clusters;
    // A triangle of what the first group made is a small one in its corner instead.
    const Cluster& cluster = graph.clusters[graph.groups.front().first_made];
    for (std::uint32_t i = 0; i < cluster.triangles / 2; ++i)
        graph.triangles[cluster.first_triangle + i] = graph.triangles[cluster.first_triangle];
    EXPECT_TRUE(understated_error(mesh, 2));
}

// The nearest of some triangles to a place, by points laid over them: never too near.
double distance_to(const StoredMesh& mesh, const glm::dvec3& at) {
    double least = HUGE_VAL;
    const ClusterGraph& graph = mesh.graph.clusters;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster)) {
            const glm::dvec3 a = mesh.from_origin_m(triangle[0]), b = mesh.from_origin_m(triangle[1]),
                             c = mesh.from_origin_m(triangle[2]);
            constexpr int parts = 12;
            for (int i = 0; i <= parts; ++i)
                for (int k = 0; i + k <= parts; ++k)
                    least = std::min(least, glm::distance(at, a + (b - a) * (double(i) / parts) +
                                                                  (c - a) * (double(k) / parts)));
        }
    }
    return least;
}

// What a mesh that passes says of the middles of what its groups made. within_m: what points laid over
// triangles may be too far.
void expect_true_errors(const StoredMesh& mesh, double within_m) {
    const ClusterGraph& graph = mesh.graph.clusters;
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by == no_group) continue;
        const VertexTriangle& triangle = graph.triangles[cluster.first_triangle];
        const glm::dvec3 middle = (mesh.from_origin_m(triangle[0]) + mesh.from_origin_m(triangle[1]) +
                                   mesh.from_origin_m(triangle[2])) /
                                  3.0;
        EXPECT_LE(distance_to(mesh, middle), graph.groups[cluster.made_by].error_m + within_m);
    }
}

// One random change to a mesh that is then written with right checksums, and to the bytes. Gives the bytes;
// none where no writer takes it.
std::vector<std::byte> changed(const StoredMesh& mesh, const std::vector<std::byte>& whole,
                               std::mt19937_64& random) {
    StoredMesh lying = mesh;
    ClusterGraph& graph = lying.graph.clusters;
    const auto any = [&](std::size_t count) { return static_cast<std::size_t>(random() % count); };
    std::vector<std::byte> bytes = whole;
    switch (random() % 7) {
        case 0:
            graph.groups[any(graph.groups.size())].error_m *= 0.05 * static_cast<double>(1 + any(19));
            break;
        case 1:
            graph.groups[any(graph.groups.size())].error_m = std::bit_cast<double>(random());
            break;
        case 2: {
            LatticeSteps& at = lying.places[any(lying.places.size())];
            at[any(3)] += static_cast<std::int64_t>(any(20000)) - 10000;
            break;
        }
        case 3: {  // another number in front
            constexpr std::size_t front = 76;
            bytes[any(front)] = static_cast<std::byte>(random());
            return bytes;
        }
        case 4:
            bytes.resize(any(bytes.size()));
            return bytes;
        case 5:
            bytes[any(bytes.size())] ^= static_cast<std::byte>(1U << any(8));
            return bytes;
        default: {  // bytes of one place at another
            const std::size_t count = 1 + any(12), from = any(bytes.size() - count),
                              to = any(bytes.size() - count);
            std::copy_n(whole.begin() + static_cast<std::ptrdiff_t>(from), count,
                        bytes.begin() + static_cast<std::ptrdiff_t>(to));
            return bytes;
        }
    }
    const auto written =
        mesh_to_bytes({lying.origin, lying.places, lying.labels, lying.label_count, lying.graph});
    return written.ok() ? *written : std::vector<std::byte>();
}

void expect_refused_or_true(int changes, std::uint64_t seed) {
    std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    std::mt19937_64 random(seed);
    const StoredMesh mesh = stored_of(hilly_ball(7, 20.0));
    const auto whole = mesh_to_bytes({mesh.origin, mesh.places, mesh.labels, mesh.label_count, mesh.graph});
    ASSERT_TRUE(whole.ok());
    int by_form = 0, by_measure = 0, same = 0, other = 0;
    for (int i = 0; i < changes; ++i) {
        const std::vector<std::byte> bytes = changed(mesh, *whole, random);
        StoredMesh read;
        const auto wrong = mesh_from_bytes(bytes, read);
        if (wrong) {
            ++by_form;
            EXPECT_EQ(wrong->find('\n'), std::string::npos);
            continue;
        }
        if (bytes == *whole) {
            ++same;
            continue;
        }
        if (understated_error(read, 1)) {
            ++by_measure;
            continue;
        }
        ++other;
        if (other % 10 == 0) expect_true_errors(read, 1.0);
    }
    std::printf("%d refused as they are, %d once measured, %d the same, %d others whose errors are true\n",
                by_form, by_measure, same, other);
    EXPECT_GT(by_form, changes / 3);
    EXPECT_GT(by_measure, changes / 20);
}

TEST(MeshCheck, ChangedMeshesAreRefusedOrTrue) {
    expect_refused_or_true(250, 31);
}

TEST(MeshCheckByGrammar, ChangedMeshesAreRefusedOrTrue) {
    expect_refused_or_true(5000, 32);
}

}  // namespace
}  // namespace oro
