// Collapses in one group.
#include <gtest/gtest.h>

#include "core/clusters/simplify_group.h"
#include "tests/core/clusters/cluster_terrain.h"

namespace oro {
namespace {

using namespace test;

const auto none_locked = [](VertexNumber) { return false; };

struct Group {
    ClusterTerrain terrain;
    GroupMesh mesh;

    template <class IsLocked>
    Group(HeightField field, const IsLocked& is_locked) : terrain(std::move(field)) {
        mesh.start(terrain.surface, original_triangles(terrain.surface), is_locked);
    }
    void simplify(const GroupSimplifier::Aim& aim) { GroupSimplifier(terrain.surface).simplify(mesh, aim); }
    [[nodiscard]] std::vector<VertexTriangle> triangles() const {
        std::vector<VertexTriangle> left;
        mesh.copy_to(left);
        return left;
    }
    [[nodiscard]] bool has(VertexNumber vertex) const {
        const auto left = triangles();
        return std::any_of(left.begin(), left.end(), [&](const VertexTriangle& triangle) {
            return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
        });
    }
};

TEST(SimplifyGroup, FlatGroundBecomesTwoTriangles) {
    Group group(flat_field(9, 9), none_locked);
    group.simplify({});
    EXPECT_EQ(group.mesh.triangles(), 2);
    EXPECT_EQ(group.mesh.difference(group.terrain.surface), 0.0);
    for (const VertexNumber corner : {0U, 8U, 72U, 80U}) EXPECT_TRUE(group.has(corner));
}

// A locked border of 32 vertices takes at least 30 triangles, and these it becomes.
TEST(SimplifyGroup, ALockedBorderStays) {
    const auto on_rim = [](VertexNumber number) {
        const VertexNumber row = number / 9, column = number % 9;
        return row == 0 || row == 8 || column == 0 || column == 8;
    };
    Group group(flat_field(9, 9), on_rim);
    EXPECT_EQ(group.mesh.locked_vertices(), 32);
    group.simplify({});
    EXPECT_EQ(group.mesh.triangles(), 30);
    for (VertexNumber number = 0; number < 81; ++number)
        EXPECT_EQ(group.has(number), on_rim(number)) << number;
}

// The spike costs most, so it goes last; the limit keeps it.
TEST(SimplifyGroup, TheCheapestGoesFirst) {
    HeightField field = flat_field(11, 11);
    post_of(field, 5, 5) = 400.0F;
    post_of(field, 2, 2) = 301.0F;
    Group group(std::move(field), none_locked);
    const VertexNumber spike = 5 * 11 + 5, bump = 2 * 11 + 2;
    group.simplify({.limit = 0.0});
    EXPECT_TRUE(group.has(spike));
    EXPECT_TRUE(group.has(bump));
    EXPECT_EQ(group.mesh.difference(group.terrain.surface), 0.0);
    group.simplify({.limit = 2.0 / height_step_m});
    EXPECT_TRUE(group.has(spike));
    EXPECT_FALSE(group.has(bump));
    group.simplify({});
    EXPECT_EQ(group.mesh.triangles(), 2);
    EXPECT_NEAR(group.mesh.difference(group.terrain.surface) * height_step_m, 100.0, 1.0e-9);
}

TEST(SimplifyGroup, StopsAtItsAimAndTakesWhatIsFree) {
    Group rough(rough_field(47.0, 8.0, 25, 25), none_locked);
    rough.simplify({.triangles = 700});
    // It goes on with what costs no more than what went; that is little.
    EXPECT_LE(rough.mesh.triangles(), 700);
    EXPECT_GT(rough.mesh.triangles(), 600);
    Group few(rough_field(47.0, 8.0, 25, 25), none_locked);
    few.simplify({.triangles = 0, .most_share = 0.1});
    EXPECT_GE(few.mesh.triangles(), 1152 - 2 * 63 - 30);
    Group flat(flat_field(25, 25), none_locked);
    flat.simplify({.triangles = 700});
    EXPECT_EQ(flat.mesh.triangles(), 2);
}

// What is told of the largest difference is what the cheapest order promises: never above a limit.
TEST(SimplifyGroup, KeepsToALimitAtEveryPlace) {
    for (const double limit_m : {0.5, 5.0, 50.0}) {
        Group group(rough_field(47.0, 8.0, 40, 40), none_locked);
        group.simplify({.limit = limit_m / height_step_m});
        const double found_m = group.mesh.difference(group.terrain.surface) * height_step_m;
        EXPECT_LE(found_m, limit_m);
        EXPECT_GT(found_m, 0.8 * limit_m);
    }
}

// One move at a time, with all costs asked anew each time, does the same.
TEST(SimplifyGroup, TheOrderIsThatOfCostsAskedAnew) {
    for (const double limit_m : {20.0, 100.0}) {
        const GroupSimplifier::Aim all{.limit = limit_m / height_step_m};
        Group at_once(rough_field(47.0, 8.0, 22, 20), none_locked);
        at_once.simplify(all);
        Group one_by_one(rough_field(47.0, 8.0, 22, 20), none_locked);
        for (int before = 0; before != one_by_one.mesh.triangles();) {
            before = one_by_one.mesh.triangles();
            one_by_one.simplify({.triangles = before - 1, .limit = all.limit});
        }
        EXPECT_LT(at_once.mesh.triangles(), 500);
        EXPECT_EQ(at_once.triangles(), one_by_one.triangles());
    }
}

// A half plane, and a triangle that touches its straight rim with a corner alone: that vertex is on the rim
// of both, and stays, or the triangle would move, too.
TEST(SimplifyGroup, WhereTrianglesMeetAtAPointItStays) {
    const ClusterTerrain terrain(flat_field(9, 9));
    std::vector<VertexTriangle> triangles{{3 * 9 + 3, 3 * 9 + 4, 4 * 9 + 4}};
    for (const VertexTriangle& triangle : original_triangles(terrain.surface)) {
        if (triangle[0] >= 4 * 9) triangles.push_back(triangle);
    }
    GroupMesh mesh;
    mesh.start(terrain.surface, triangles, none_locked);
    GroupSimplifier(terrain.surface).simplify(mesh, {});
    std::vector<VertexTriangle> left;
    mesh.copy_to(left);
    EXPECT_EQ(left[0], triangles[0]);
    // The half plane keeps its corners and the vertex that is touched.
    EXPECT_EQ(left.size(), 4U);
    std::int64_t area = 0;
    for (const VertexTriangle& triangle : left)
        area += twice_area(terrain.surface.vertex(triangle[0]), terrain.surface.vertex(triangle[1]),
                           terrain.surface.vertex(triangle[2]));
    EXPECT_EQ(area, static_cast<std::int64_t>(triangles.size()));
}

}  // namespace
}  // namespace oro
