// The tree of a mesh's triangles: lines of sight meet what brute force finds, through air that bends light,
// too.
#include "core/truth/true_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

namespace oro {
namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
}

// A rough sheet of count x count quads, 2.5 km wide, with a soup of loose triangles over it.
MeshTriangles rough_sheet(std::uint32_t count, Random& random) {
    MeshTriangles mesh;
    for (std::uint32_t i = 0; i <= count; ++i)
        for (std::uint32_t k = 0; k <= count; ++k)
            mesh.vertices_m.push_back(ecef_from_geodetic({47.0 + 0.0225 * i / count, 8.0 + 0.033 * k / count,
                                                          600.0 + between(random, -15.0, 15.0)})
                                          .m);
    for (std::uint32_t i = 0; i < count; ++i)
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint32_t a = i * (count + 1) + k, b = a + count + 1;
            mesh.triangles.push_back({a, a + 1, b + 1});
            mesh.triangles.push_back({b, a, b + 1});
        }
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::dvec3 at = ecef_from_geodetic({between(random, 47.0, 47.0225), between(random, 8.0, 8.033),
                                                  between(random, 650.0, 900.0)})
                                  .m;
        const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
        for (int corner = 0; corner < 3; ++corner)
            mesh.vertices_m.push_back(at + glm::dvec3(between(random, -30.0, 30.0),
                                                      between(random, -30.0, 30.0),
                                                      between(random, -30.0, 30.0)));
        mesh.triangles.push_back({first, first + 1, first + 2});
    }
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.features.push_back(i % 7);
    return mesh;
}

struct Nearest {
    long double along_m{};
    std::uint32_t triangle{};
    bool is_there{};
    long double margin{1.0L};  // the least share of any corner: near 0 the line passes along a side
};

// By the signs of three volumes, in long double: no code of the tree.
Nearest nearest_of(const std::vector<std::array<glm::dvec3, 3>>& seen, const glm::dvec3& direction,
                   double reach_m) {
    using Long3 = std::array<long double, 3>;
    const auto cross = [](const Long3& a, const Long3& b) {
        return Long3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    const auto dot = [](const Long3& a, const Long3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
    const Long3 way{direction.x, direction.y, direction.z};
    Nearest nearest;
    nearest.along_m = reach_m;
    for (std::uint32_t number = 0; number < seen.size(); ++number) {
        std::array<Long3, 3> at{};
        for (std::size_t i = 0; i < 3; ++i) at[i] = {seen[number][i].x, seen[number][i].y, seen[number][i].z};
        std::array<long double, 3> share{};
        for (std::size_t i = 0; i < 3; ++i) share[i] = dot(way, cross(at[(i + 1) % 3], at[(i + 2) % 3]));
        const long double sum = share[0] + share[1] + share[2];
        if (sum == 0.0L) continue;
        long double along = 0.0L;
        for (std::size_t i = 0; i < 3; ++i) {
            share[i] /= sum;
            along += share[i] * dot(at[i], way);
        }
        const long double least = std::min({share[0], share[1], share[2]});
        if (along < 0.0L || along >= nearest.along_m) continue;
        nearest.margin = std::min(nearest.margin, std::abs(least));
        if (least < 0.0L) continue;
        nearest.along_m = along, nearest.triangle = number, nearest.is_there = true;
    }
    return nearest;
}

TEST(TrueMesh, LinesMeetWhatBruteForceFindsInAnyAir) {
    constexpr unsigned seed = 5230;
    std::printf("seed %u\n", seed);
    Random random(seed);
    const MeshTriangles mesh = rough_sheet(16, random);
    const TrueMesh tree(mesh, 3, 2);
    EXPECT_EQ(tree.number(), 3U);
    ASSERT_EQ(tree.size(), mesh.triangles.size());
    int met = 0, missed = 0, skipped = 0;
    for (int i = 0; i < 48; ++i) {
        // Within the sheet, over it, and up to 60 km away, where light of k = 0.13 lifts it by 37 m.
        const double far_deg = i % 3 == 0 ? 0.01 : i % 3 == 1 ? 0.05 : 0.55;
        const Geodetic eye{47.01 + between(random, -far_deg, far_deg),
                           8.015 + between(random, -far_deg, far_deg),
                           between(random, 500.0, i % 3 == 0 ? 900.0 : 3000.0)};
        Air air;
        air.k = i % 4 == 0 ? 0.0 : i % 4 == 1 ? 0.13 : i % 4 == 2 ? -1.0 : 0.9;
        const Refraction refraction(eye, air);
        const Ecef from = ecef_from_geodetic(eye);
        std::vector<std::array<glm::dvec3, 3>> seen(tree.size());
        for (std::size_t k = 0; k < tree.size(); ++k) {
            seen[k] = tree.corners_m(k);
            for (glm::dvec3& corner : seen[k]) corner = refraction.apparent_m(corner - from.m);
        }
        for (int k = 0; k < 40; ++k) {
            const auto& aim = seen[random() % seen.size()];
            const glm::dvec3 beside(between(random, -40.0, 40.0), between(random, -40.0, 40.0),
                                    between(random, -40.0, 40.0));
            const glm::dvec3 direction = glm::normalize((aim[0] + aim[1] + aim[2]) / 3.0 + beside);
            constexpr double reach_m = 90000.0;
            const Nearest expected = nearest_of(seen, direction, reach_m);
            if (expected.margin < 1.0e-7L) {
                ++skipped;
                continue;
            }
            const auto found = tree.first_hit(from, refraction, glm::dvec3(0.0), direction, reach_m);
            ASSERT_EQ(found.has_value(), expected.is_there) << "eye " << i << ", line " << k;
            if (!found) {
                ++missed;
                continue;
            }
            ++met;
            EXPECT_EQ(found->triangle, expected.triangle);
            EXPECT_NEAR(found->along_m, static_cast<double>(expected.along_m), 1.0e-5) << "m";
            EXPECT_EQ(tree.feature(found->triangle), expected.triangle % 7);
            // Nothing is met nearer than it is.
            EXPECT_FALSE(
                tree.first_hit(from, refraction, glm::dvec3(0.0), direction, 0.999 * found->along_m));
        }
    }
    EXPECT_GT(met, 700);
    EXPECT_GT(missed, 50);
    EXPECT_LT(skipped, 50);
}

TEST(TrueMesh, IsTheSameByAnyNumberOfThreads) {
    constexpr unsigned seed = 5231;
    Random random(seed);
    const MeshTriangles mesh = rough_sheet(120, random);  // 28,920 triangles: several parts
    const TrueMesh one(mesh, 1, 1), many(mesh, 1, 5);
    const Geodetic eye{47.01, 8.015, 1500.0};
    const Ecef from = ecef_from_geodetic(eye);
    const Refraction refraction(eye, Air{});
    int met = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 aim = mesh.vertices_m[random() % mesh.vertices_m.size()];
        const glm::dvec3 direction = glm::normalize(aim + glm::dvec3(between(random, -9.0, 9.0)) - from.m);
        const auto a = one.first_hit(from, refraction, glm::dvec3(0.0), direction, 1.0e5),
                   b = many.first_hit(from, refraction, glm::dvec3(0.0), direction, 1.0e5);
        ASSERT_EQ(a.has_value(), b.has_value());
        if (!a) continue;
        ++met;
        EXPECT_EQ(a->along_m, b->along_m);
        EXPECT_EQ(a->triangle, b->triangle);
    }
    EXPECT_GT(met, 300);
}

// How far a point is from a triangle by the seven regions around it: no code of the tree.
// Source: C. Ericson, Real-Time Collision Detection, 2005, 5.1.5.
double away_m(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& at) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 ab = b - a, ac = c - a;
    const double d1 = glm::dot(ab, at - a), d2 = glm::dot(ac, at - a), d3 = glm::dot(ab, at - b),
                 d4 = glm::dot(ac, at - b), d5 = glm::dot(ab, at - c), d6 = glm::dot(ac, at - c);
    if (d1 <= 0.0 && d2 <= 0.0) return glm::distance(a, at);
    if (d3 >= 0.0 && d4 <= d3) return glm::distance(b, at);
    if (d6 >= 0.0 && d5 <= d6) return glm::distance(c, at);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return glm::distance(a + d1 / (d1 - d3) * ab, at);
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return glm::distance(a + d2 / (d2 - d6) * ac, at);
    if (va <= 0.0 && d4 >= d3 && d5 >= d6)
        return glm::distance(b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b), at);
    return glm::distance(a + vb / (va + vb + vc) * ab + vc / (va + vb + vc) * ac, at);
}

TEST(TrueMesh, NearestPlacesAreThoseOfBruteForce) {
    constexpr unsigned seed = 5232;
    std::printf("seed %u\n", seed);
    Random random(seed);
    const MeshTriangles mesh = rough_sheet(16, random);
    const TrueMesh tree(mesh, 1, 2);
    double farthest_m = 0.0;
    for (int i = 0; i < 2000; ++i) {
        // On the mesh, near it and far from it.
        const double off_m = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 20.0 : 3000.0;
        const auto corners = tree.corners_m(random() % tree.size());
        const glm::dvec3 at = (corners[0] + corners[1] + corners[2]) / 3.0 +
                              glm::dvec3(between(random, -off_m, off_m), between(random, -off_m, off_m),
                                         between(random, -off_m, off_m));
        double expected_m = 1.0e9;
        for (std::size_t k = 0; k < tree.size(); ++k)
            expected_m = std::min(expected_m, away_m(tree.corners_m(k), at));
        const auto found = tree.nearest_m(at, 1.0e9);
        ASSERT_TRUE(found);
        ASSERT_NEAR(glm::distance(*found, at), expected_m, 1.0e-8) << "m, of point " << i;
        farthest_m = std::max(farthest_m, expected_m);
        if (expected_m > 1.0e-3) {
            EXPECT_FALSE(tree.nearest_m(at, 0.999 * expected_m));
        }
    }
    EXPECT_GT(farthest_m, 1000.0);
    // Triangles without an area are lines, or points.
    const TrueMesh line({{{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {2.0, 0.0, 0.0}}, {{0, 1, 2}, {2, 2, 2}}, {}}, 1,
                        1);
    EXPECT_EQ(line.nearest_m({3.0, 2.0, 0.0}, 9.0), glm::dvec3(3.0, 0.0, 0.0));
    EXPECT_EQ(line.nearest_m({7.0, 4.0, 0.0}, 9.0), glm::dvec3(4.0, 0.0, 0.0));
}

TEST(TrueMesh, OfNothingMeetsNothing) {
    const TrueMesh none({}, 1, 4);
    EXPECT_EQ(none.size(), 0U);
    EXPECT_FALSE(none.first_hit({{7.0e6, 0.0, 0.0}}, {}, glm::dvec3(0.0), {-1.0, 0.0, 0.0}, 1.0e9));
    EXPECT_FALSE(none.nearest_m({7.0e6, 0.0, 0.0}, 1.0e9));
}

}  // namespace
}  // namespace oro
