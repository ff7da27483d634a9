// Meshes in the true ground: sight lines meet the first triangle that brute force finds, or the terrain
// before it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "core/truth/oracle.h"
#include "geo/together/cut_regions.h"
#include "geo/together/mesh_surface.h"
#include "geo/together/region_ground.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

double drawn_between(std::mt19937& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// Triangles of 5 to 150 m that cross each other and the ground, in any order of corners.
PlacedMesh soup(std::mt19937& random, int triangles) {
    PlacedMesh mesh;
    mesh.path = "soup.obj";
    for (int i = 0; i < triangles; ++i) {
        const double lat_deg = drawn_between(random, 46.945, 46.985),
                     lon_deg = drawn_between(random, 8.015, 8.055),
                     H_m = drawn_between(random, 300.0, 1500.0);
        const double size_deg = std::exp(drawn_between(random, std::log(5.0), std::log(150.0))) / 111000.0;
        for (int corner = 0; corner < 3; ++corner)
            mesh.vertices.push_back({lat_deg + size_deg * drawn_between(random, -0.5, 0.5),
                                     lon_deg + size_deg * drawn_between(random, -0.7, 0.7),
                                     H_m + 1.0e5 * size_deg * drawn_between(random, -0.5, 0.5)});
        const auto first = static_cast<std::uint32_t>(3 * i);
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

using Long3 = std::array<long double, 3>;
Long3 cross_of(const Long3& a, const Long3& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long double dot_of(const Long3& a, const Long3& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Where a line from the origin crosses a triangle's plane, and whether that is inside: by the signs of three
// volumes. margin: the least of them by the sum; near 0 the line passes along a side.
struct Crossing {
    bool inside{};
    long double along_m{}, margin{};
};
Crossing crossing(const std::array<Long3, 3>& at, const Long3& direction) {
    std::array<long double, 3> volume{};
    for (std::size_t i = 0; i < 3; ++i) volume[i] = dot_of(direction, cross_of(at[i], at[(i + 1) % 3]));
    const long double sum = volume[0] + volume[1] + volume[2];
    Crossing found;
    if (sum == 0.0L) return found;
    found.margin = std::min({volume[0] / sum, volume[1] / sum, volume[2] / sum});
    found.inside = found.margin >= 0.0L;
    // The third corner's share is that of the side opposite to it.
    for (std::size_t i = 0; i < 3; ++i) found.along_m += volume[i] / sum * dot_of(at[(i + 2) % 3], direction);
    return found;
}

// The first of all triangles along a line before most_m. margin: the least of any side.
struct Nearest {
    bool is_there{};
    long double along_m{}, margin{1.0L};
};
Nearest nearest_of(const std::vector<std::array<glm::dvec3, 3>>& triangles, const glm::dvec3& eye_m,
                   const glm::dvec3& direction, double most_m) {
    Nearest nearest;
    nearest.along_m = most_m;
    for (const auto& triangle : triangles) {
        std::array<Long3, 3> at{};
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3 m = triangle[corner] - eye_m;
            at[corner] = {m.x, m.y, m.z};
        }
        const Crossing here = crossing(at, {direction.x, direction.y, direction.z});
        nearest.margin = std::min(nearest.margin, std::abs(here.margin));
        if (!here.inside || here.along_m < 0.0L || here.along_m >= nearest.along_m) continue;
        nearest.along_m = here.along_m;
        nearest.is_there = true;
    }
    return nearest;
}

TEST(MeshGround, SightLinesMeetWhatBruteForceFinds) {
    constexpr unsigned seed = 5203;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    Region region = test::three_grids(90);
    const auto bare = RegionGround::of(region, 1.0);
    ASSERT_TRUE(bare.ok()) << bare.error().line();
    region.meshes = std::make_shared<const std::vector<PlacedMesh>>(1, soup(random, 400));
    const auto grounds = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grounds.ok()) << grounds.error().line();
    std::vector<SurfaceTriangle> pieces;
    add_mesh(region.meshes->front(), region.grids.front().field.undulation, 1.0, 1, pieces);
    ASSERT_EQ(pieces.size(), 400U);
    std::vector<std::array<glm::dvec3, 3>> triangles;
    for (const SurfaceTriangle& piece : pieces)
        triangles.push_back({ecef_from_geodetic(piece.corners[0]).m, ecef_from_geodetic(piece.corners[1]).m,
                             ecef_from_geodetic(piece.corners[2]).m});
    int on_mesh = 0, on_terrain = 0, skipped = 0;
    constexpr int eyes = 20, lines = 100;
    for (int i = 0; i < eyes; ++i) {
        const Geodetic eye{drawn_between(random, 46.945, 46.985), drawn_between(random, 8.015, 8.055),
                           drawn_between(random, 1000.0, 2500.0)};
        const Sight sight = sight_from(eye, Air{});
        ASSERT_TRUE(sight.refraction.straight()) << "the test is of straight light";
        const Oracle of_terrain((*bare)->ground(), sight), of_all((*grounds)->ground(), sight);
        for (int k = 0; k < lines; ++k) {
            // Towards a triangle, and up to 8 m beside its middle.
            const auto& aim = triangles[random() % triangles.size()];
            const glm::dvec3 beside(drawn_between(random, -8.0, 8.0), drawn_between(random, -8.0, 8.0),
                                    drawn_between(random, -8.0, 8.0));
            const glm::dvec3 direction =
                glm::normalize((aim[0] + aim[1] + aim[2]) / 3.0 + beside - sight.eye.m);
            constexpr double reach_m = 8000.0;
            const auto terrain = of_terrain.first_hit(direction, reach_m),
                       found = of_all.first_hit(direction, reach_m);
            const Nearest mesh =
                nearest_of(triangles, sight.eye.m, direction, terrain ? terrain->distance_m : reach_m);
            if (mesh.margin < 1.0e-9L) {
                ++skipped;
                continue;
            }
            ASSERT_EQ(found && found->mesh == 1, mesh.is_there) << "eye " << i << ", line " << k;
            if (mesh.is_there) {
                ++on_mesh;
                EXPECT_NEAR(found->distance_m, static_cast<double>(mesh.along_m), 1.0e-6) << "m";
            } else if (terrain) {
                ++on_terrain;
                ASSERT_TRUE(found);
                EXPECT_EQ(found->distance_m, terrain->distance_m);
            }
        }
    }
    EXPECT_GT(on_mesh, 200);
    EXPECT_GT(on_terrain, 200);
    EXPECT_LT(skipped, 20);
}

// What is drawn: each triangle once, with normals upwards of length 1; a ridge of 90 degrees keeps its edge,
// a gentle one is smooth.
TEST(MeshGround, CreasesKeepTheirEdges) {
    PlacedMesh mesh;
    const double east_deg = 10.0 / 76000.0, north_deg = 10.0 / 111000.0;
    for (const double rise_m : {10.0, 1.0}) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), {{47.0, 8.0, 500.0 + rise_m},
                                                   {47.0 + north_deg, 8.0, 500.0 + rise_m},
                                                   {47.0, 8.0 - east_deg, 500.0},
                                                   {47.0, 8.0 + east_deg, 500.0}});
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.triangles.push_back({first, first + 1, first + 3});
    }
    Seam seam;
    add_mesh(mesh, {}, 1.0, seam);
    ASSERT_EQ(seam.pieces.size(), 4U);
    for (const SeamPiece& piece : seam.pieces) {
        EXPECT_TRUE(piece.two_sided);
        for (const SeamCorner& corner : piece.corners) {
            EXPECT_NEAR(glm::length(corner.normal), 1.0, 1.0e-12);
            EXPECT_GT(glm::dot(corner.normal, corner.at.m), 0.0);
        }
    }
    const auto cosine = [&](std::size_t one, std::size_t other) {
        return glm::dot(seam.pieces[one].corners[0].normal, seam.pieces[other].corners[0].normal);
    };
    // Two slopes of 45 degrees are at a right angle; of 5.7 degrees they share the normal of their ridge.
    EXPECT_NEAR(cosine(0, 1), 0.0, 0.01);
    EXPECT_NEAR(cosine(2, 3), 1.0, 1.0e-9);
}

}  // namespace
}  // namespace oro
