// shaders/choose/levels.glsl: the bound on the screen, and where stitched posts go.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

TEST(ProjectedError, IsNotExceededByAnyPointOfTheSphere) {
    const unsigned seed = 4;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::normal_distribution<double> normal;
    const auto direction = [&] {
        return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    };
    double closest = 0.0;
    int seen = 0, bounded = 0;
    for (int run = 0; run < 40000; ++run) {
        const double corner = std::pow(10.0, 0.7 * unit(random) - 0.3);
        const double f = 540.0;
        const double radius = std::pow(10.0, 2.0 + 2.0 * unit(random));
        const double distance = radius * (0.5 + std::pow(10.0, 1.5 * unit(random)));
        // Mostly near the picture's edges and corners, where the bound is worst.
        const double tangent = corner * (1.0 + 0.3 * unit(random));
        const double turn = std::numbers::pi * unit(random);
        const glm::dvec3 axis =
            glm::normalize(glm::dvec3(tangent * std::cos(turn), tangent * std::sin(turn), -1.0));
        const glm::vec3 centre(run % 4 == 0 ? distance * direction() : distance * axis);
        const double e = radius * std::pow(10.0, -1.5 + 1.5 * unit(random));
        const double bound_px =
            gpu::projected_error_px(centre, static_cast<float>(radius), static_cast<float>(e),
                                    static_cast<float>(f), static_cast<float>(corner));
        bounded += bound_px < 1.0e30 ? 1 : 0;
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 at =
                glm::dvec3(centre) + radius * direction() * (i % 2 == 0 ? 1.0 : std::abs(unit(random)));
            if (!(at.z < 0.0) || std::hypot(at.x, at.y) > -at.z * corner) continue;  // not in the picture
            // Across the ray, along the axis, towards the eye, and anyhow.
            const glm::dvec3 ray = glm::normalize(at);
            const glm::dvec3 any = direction();
            const glm::dvec3 across = glm::normalize(any - glm::dot(any, ray) * ray);
            const glm::dvec3 in_plane =
                glm::normalize(glm::cross(glm::cross(ray, glm::dvec3(0.0, 0.0, 1.0)), ray));
            const glm::dvec3 pulls[] = {across, in_plane, -in_plane, any,
                                        glm::normalize(in_plane - 0.3 * ray)};
            const glm::dvec3 moved = at + e * pulls[random() % 5];
            if (!(moved.z < 0.0)) {
                ASSERT_GE(bound_px, 1.0e30);
                continue;
            }
            ++seen;
            const glm::dvec2 shift(f * (moved.x / moved.z - at.x / at.z),
                                   f * (moved.y / moved.z - at.y / at.z));
            ASSERT_LE(glm::length(shift), bound_px);
            if (bound_px < 1.0e30) closest = std::max(closest, glm::length(shift) / bound_px);
        }
    }
    std::printf("seed %u: %d spheres with a bound, %d points, at most %.3f of it\n", seed, bounded, seen,
                closest);
    EXPECT_GT(seen, 100000);
    EXPECT_GT(closest, 0.95);
}

TEST(ProjectedError, GrowsWithErrorAndSphere) {
    std::mt19937_64 random(6);
    std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
    for (int run = 0; run < 200000; ++run) {
        const float scale = std::pow(10.0F, 3.0F * unit(random));
        const gpu::vec3 centre = 1000.0F * gpu::vec3(unit(random), unit(random), unit(random));
        const gpu::vec3 step = scale * gpu::vec3(unit(random), unit(random), unit(random));
        const float radius = scale * std::abs(unit(random));
        const float error_m = 10.0F * std::abs(unit(random));
        const float corner = 0.1F + std::abs(unit(random));
        const float small = gpu::projected_error_px(centre, radius, error_m, 1000.0F, corner);
        const float large =
            gpu::projected_error_px(centre + step, (radius + glm::length(step)) * 1.0001F + 0.01F,
                                    error_m * 1.00001F, 1000.0F, corner);
        ASSERT_LE(small, large);
    }
    EXPECT_EQ(gpu::projected_error_px({0.0F, 0.0F, 5.0F}, 10.0F, 0.0F, 1000.0F, 1.0F), 0.0F);
    EXPECT_EQ(gpu::projected_error_px({0.0F, 0.0F, -5.0F}, 10.0F, 1.0F, 1000.0F, 1.0F), 1.0e30F);
    // 1 m at 1 km on the axis, sphere of 10 m: 1 px and a little.
    EXPECT_NEAR(gpu::projected_error_px({0.0F, 0.0F, -1000.0F}, 10.0F, 1.0F, 1000.0F, 1.0F), 1.0112F, 0.001F);
}

TEST(StitchedPost, GoesToTheOneBeforeByNumber) {
    const gpu::uvec2 quads(8, 8);
    EXPECT_EQ(gpu::stitched_post({0, 3}, quads, gpu::edge_north), gpu::uvec2(0, 2));
    EXPECT_EQ(gpu::stitched_post({0, 3}, quads, gpu::edge_south), gpu::uvec2(0, 3));
    EXPECT_EQ(gpu::stitched_post({8, 7}, quads, gpu::edge_south), gpu::uvec2(8, 6));
    EXPECT_EQ(gpu::stitched_post({5, 8}, quads, gpu::edge_east), gpu::uvec2(4, 8));
    EXPECT_EQ(gpu::stitched_post({1, 0}, quads, gpu::edge_west), gpu::uvec2(0, 0));
    EXPECT_EQ(gpu::stitched_post({8, 8}, quads, 15U), gpu::uvec2(8, 8));
    EXPECT_EQ(gpu::stitched_post({3, 3}, quads, 15U), gpu::uvec2(3, 3));
    // The region's last post is on every level.
    EXPECT_EQ(gpu::stitched_post({0, 5}, {8, 5}, gpu::edge_north), gpu::uvec2(0, 5));
    EXPECT_EQ(gpu::stitched_post({3, 5}, {8, 5}, gpu::edge_east), gpu::uvec2(2, 5));
}

}  // namespace
}  // namespace oro
