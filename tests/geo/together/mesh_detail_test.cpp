// Meshes at the detail that a view needs: what is drawn is where the mesh is, in pixels, by brute force.
#include "geo/together/mesh_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>

#include "geo/together/mesh_surface.h"
#include "tests/geo/together/made_placed_mesh.h"

namespace oro {
namespace {

using test::ball_of_two_features, test::region_with;

Camera eye_at(double distance_m, double heading_deg) {
    const double way = heading_deg * std::numbers::pi / 180.0;
    Camera camera;
    camera.eye = {47.0 - distance_m * std::cos(way) / 111200.0, 8.5 - distance_m * std::sin(way) / 76000.0,
                  830.0};
    camera.attitude = {heading_deg, -2.0, 0.0};
    camera.vertical_fov_deg = 20.0, camera.width_px = 800, camera.height_px = 600;
    return camera;
}

using Corners = std::array<glm::dvec3, 3>;
std::vector<Corners> triangles_of(const PlacedMesh& mesh) {
    const std::vector<glm::dvec3> at = drawn_places_m(mesh, {}, 1.0);
    std::vector<Corners> all;
    for (const SourceTriangle& triangle : mesh.triangles)
        all.push_back({at[triangle[0]], at[triangle[1]], at[triangle[2]]});
    return all;
}

glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& at) {
    const glm::dvec3 view = camera.view_from_ecef() * (at - camera.eye_ecef().m);
    const double per_tangent = 0.5 * camera.height_px / camera.half_fov_tangent().y;
    return {per_tangent * view.x / -view.z, -per_tangent * view.y / -view.z};
}

// The nearest place of some triangles, by points laid closely over the nearest of them.
glm::dvec3 nearest_place(const std::vector<Corners>& triangles, const glm::dvec3& to) {
    glm::dvec3 best(0.0);
    double least = HUGE_VAL;
    for (const Corners& at : triangles)
        for (const glm::dvec3& corner : at)
            if (glm::distance(corner, to) < least) least = glm::distance(corner, to), best = corner;
    for (const Corners& at : triangles) {
        const double reach =
            std::max({glm::distance(at[0], at[1]), glm::distance(at[1], at[2]), glm::distance(at[2], at[0])});
        if (glm::distance(at[0], to) - reach > least) continue;
        constexpr int parts = 40;
        for (int i = 0; i <= parts; ++i)
            for (int k = 0; i + k <= parts; ++k) {
                const glm::dvec3 place =
                    at[0] + (at[1] - at[0]) * (double(i) / parts) + (at[2] - at[0]) * (double(k) / parts);
                if (glm::distance(place, to) < least) least = glm::distance(place, to), best = place;
            }
    }
    return best;
}

double farthest_px(const Camera& camera, const std::vector<Corners>& some, const std::vector<Corners>& others,
                   int count, std::mt19937_64& random) {
    std::uniform_int_distribution<std::size_t> which(0, some.size() - 1);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    double most = 0.0;
    for (int i = 0; i < count; ++i) {
        const Corners& at = some[which(random)];
        const double x = share(random), y = (1.0 - x) * share(random);
        const glm::dvec3 place = at[0] + x * (at[1] - at[0]) + y * (at[2] - at[0]);
        most = std::max(
            most, glm::distance(pixel_of(camera, place), pixel_of(camera, nearest_place(others, place))));
    }
    return most;
}

TEST(MeshDetail, WhatIsDrawnIsWithinTauOfTheMeshBothWays) {
    constexpr unsigned seed = 5211;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    const Region region = region_with(ball_of_two_features());
    const MeshDetail detail = MeshDetail::of(region, 1.0, 2);
    const std::vector<Corners> all = triangles_of(region.meshes->front());
    std::uint64_t before = all.size() + 1;
    for (const double distance_m : {150.0, 600.0, 3000.0}) {
        const Camera camera = eye_at(distance_m, 70.0);
        const MeshCut cut = detail.cut(camera, 1.0, {}, {}).value();
        EXPECT_EQ(cut.of_triangles, 1520U);
        EXPECT_LE(cut.error_px, 1.0);
        EXPECT_LT(cut.triangles, before);
        before = cut.triangles;
        const std::vector<Corners> drawn = triangles_of(cut.meshes->front());
        ASSERT_EQ(drawn.size(), cut.triangles);
        // Points that are laid over a triangle of 5 m at most leave 0.1 m: 0.3 px at 600 m, less farther off.
        const double slack_px =
            0.05 + 0.1 * 0.5 * camera.height_px / camera.half_fov_tangent().y / distance_m;
        EXPECT_LE(farthest_px(camera, all, drawn, 25, random), 1.0 + slack_px) << distance_m;
        EXPECT_LE(farthest_px(camera, drawn, all, 25, random), 1.0 + slack_px) << distance_m;
    }
    EXPECT_LT(before, 200U);
}

TEST(MeshDetail, LevelZeroAreAllTrianglesAndEachKeepsItsFeature) {
    const Region region = region_with(ball_of_two_features());
    const MeshDetail detail = MeshDetail::of(region, 1.0, 1);
    const MeshCut whole = detail.cut(eye_at(600.0, 0.0), 1.0, {}, 0U).value();
    EXPECT_EQ(whole.triangles, 1520U);
    EXPECT_EQ(whole.error_m, 0.0);
    for (const std::uint32_t level : {0U, 1U, 2U}) {
        const MeshCut cut = detail.cut(eye_at(600.0, 0.0), 1.0, {}, level).value();
        const PlacedMesh& drawn = cut.meshes->front();
        ASSERT_EQ(drawn.feature_of.size(), drawn.triangles.size());
        for (std::size_t i = 0; i < drawn.triangles.size(); ++i) {
            double lat_deg = 0.0;
            for (const std::uint32_t corner : drawn.triangles[i])
                lat_deg += drawn.vertices[corner].lat_deg / 3.0;
            // A triangle that began on one side of the middle may reach 15 m over it.
            if (std::abs(lat_deg - 47.0) < 15.0 / 111200.0) continue;
            EXPECT_EQ(drawn.feature_of[i], lat_deg > 47.0 ? 0U : 1U);
        }
    }
}

// Each edge between two places of the lattice has two triangles.
TEST(MeshDetail, CutsOfAClosedMeshAreClosed) {
    const Region region = region_with(ball_of_two_features());
    const MeshDetail detail = MeshDetail::of(region, 1.5, 1);
    for (const std::uint32_t level : {0U, 1U, 2U, 3U, 5U}) {
        const MeshCut cut = detail.cut(eye_at(600.0, 0.0), 1.0, {}, level).value();
        const PlacedMesh& drawn = cut.meshes->front();
        const std::vector<glm::dvec3> at = drawn_places_m(drawn, {}, 1.5);
        using Place = std::array<double, 3>;
        std::map<std::pair<Place, Place>, int> edges;
        const auto place = [&](std::uint32_t i) { return Place{at[i].x, at[i].y, at[i].z}; };
        for (const SourceTriangle& triangle : drawn.triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                const Place a = place(triangle[i]), b = place(triangle[(i + 1) % 3]);
                ++edges[std::minmax(a, b)];
            }
        for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2) << level;
    }
}

}  // namespace
}  // namespace oro
