// What orograph-bench-mesh-graph compares: meshoptimizer in groups keeps what has to stay, and collapses
// without groups are within their errors.
#include <gtest/gtest.h>

#include <set>

#include "apps/bench/cover_bound.h"
#include "apps/bench/meshopt_groups.h"
#include "apps/bench/whole_collapses.h"
#include "tests/support/made_space_meshes.h"

namespace oro {
namespace {

// The ball's half beyond x = 0, its rim, and one vertex in the middle of it have to stay.
struct HalfBall {
    test::SpaceMesh mesh = test::hilly_ball(20, 50.0);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::set<std::uint32_t> staying;
    GroupToSimplify group;

    HalfBall() {
        std::set<std::uint32_t> inside, outside;
        for (const auto& corners : mesh.triangles) {
            const bool is_in = mesh.vertices[corners[0]].x > 0.0;
            if (is_in) triangles.push_back(corners);
            (is_in ? inside : outside).insert(corners.begin(), corners.end());
        }
        for (const std::uint32_t vertex : inside)
            if (outside.contains(vertex)) staying.insert(vertex);
        std::uint32_t middle = *inside.begin();
        for (const std::uint32_t vertex : inside)
            if (mesh.vertices[vertex].x > mesh.vertices[middle].x) middle = vertex;
        staying.insert(middle);
        const auto stays = [this](std::uint32_t vertex) { return staying.contains(vertex); };
        group = {mesh.vertices, triangles, stays, triangles.size() / 2, 1.0};
    }
};

TEST(BenchMeshGraph, MeshoptKeepsWhatHasToStay) {
    const HalfBall half;
    ASSERT_GT(half.staying.size(), 30U);
    for (const MeshoptRims rims : {MeshoptRims::stay, MeshoptRims::move}) {
        const auto made = simplifier_by_meshopt(rims, MeshoptLimit::none)(half.group);
        // Half as many were asked for; triangles that hold vertices are not among them.
        EXPECT_LE(made.size(), half.group.aim + 8);
        EXPECT_GE(made.size(), half.group.aim * 9 / 10);
        std::set<std::uint32_t> left;
        for (const auto& corners : made) left.insert(corners.begin(), corners.end());
        for (const std::uint32_t vertex : half.staying) EXPECT_TRUE(left.contains(vertex)) << vertex;
    }
}

TEST(BenchMeshGraph, MeshoptIsHeldToADistance) {
    HalfBall half;
    const NearestTriangles before(corners_of(half.mesh.vertices, half.triangles));
    std::size_t last = half.triangles.size();
    for (const double most_m : {2.0, 4.0, 8.0}) {
        half.group.aim = 10, half.group.most_m = most_m;
        const auto made = simplifier_by_meshopt(MeshoptRims::move, MeshoptLimit::measured)(half.group);
        ASSERT_FALSE(made.empty());
        EXPECT_LE(cover_bound_m(corners_of(half.mesh.vertices, made), before, 0.0, 1.0e9), 1.02 * most_m);
        EXPECT_LT(made.size(), last);
        last = made.size();
    }
}

TEST(BenchMeshGraph, CollapsesWithoutGroupsAreWithinTheirErrors) {
    const test::SpaceMesh mesh = test::hilly_ball(24, 50.0);
    const std::array<double, 2> errors_m{0.3, 1.0};
    const std::vector<WholeMesh> found = whole_collapses(mesh.vertices, mesh.triangles, errors_m);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_LT(found[0].triangles, mesh.triangles.size());
    EXPECT_LT(found[1].triangles, found[0].triangles);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_LE(found[i].believed, found[i].triangles);
        // Samples miss some; the bound is to 2 %.
        EXPECT_GT(found[i].true_m, 0.5 * errors_m[i]);
        EXPECT_LT(found[i].true_m, 3.0 * errors_m[i]);
    }
}

}  // namespace
}  // namespace oro
