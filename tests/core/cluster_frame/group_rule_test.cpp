// The rule whether a group stands, without a graph: it is its bound, whatever is asked.
#include "core/cluster_frame/group_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

namespace oro {
namespace {

// A group in front of a camera, or around it, or behind it.
ClusterGroup group_near(const Camera& camera, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0), both(-1.0, 1.0);
    ClusterGroup group{};
    const double away_m = std::pow(10.0, 1.0 + 5.0 * unit(random));
    const glm::dvec3 ahead = -glm::dvec3(glm::transpose(camera.view_from_ecef())[2]);
    group.centre.m = camera.eye_ecef().m +
                     away_m * (ahead + unit(random) * glm::dvec3(both(random), both(random), both(random)));
    group.radius_m = away_m * std::pow(10.0, -3.0 * unit(random));
    group.error_m = group.radius_m * std::pow(10.0, -4.0 * unit(random));
    group.level = 1 + static_cast<std::uint32_t>(random() % 14);
    return group;
}

// Lengths are over the power of two that std::ilogb() and std::ldexp() find, to the bit.
TEST(GroupRules, ScaleByAPowerOfTwo) {
    constexpr unsigned seed = 5108;
    std::mt19937_64 random(seed);
    for (int i = 0; i < 20'000; ++i) {
        Camera camera;
        camera.eye = {46.0, 8.0, 3000.0};
        const ClusterGroup group = group_near(camera, random);
        const GroupRule rule(camera, 1.0);
        const GroupRule::SeenSphere seen = rule.seen(group.centre, group.radius_m);
        const double radius_m = seen.radius_m * (1.0 + 1.0e-6 * (group.level + 1.0));
        const double distance_m = glm::length(seen.centre_m);
        const int down = -std::ilogb(std::max({distance_m, radius_m, 1.0}));
        const gpu::AskedGroup asked = rule.measured(group);
        EXPECT_EQ(asked.distance, static_cast<float>(std::ldexp(distance_m, down)))
            << "seed " << seed << ", case " << i;
        EXPECT_EQ(asked.radius, static_cast<float>(std::ldexp(radius_m, down)));
        EXPECT_EQ(asked.error, static_cast<float>(std::ldexp(group.error_m, down)));
    }
}

// What stands is within tau, and what does not is beyond it, but for what the rule may round.
TEST(GroupRules, AreTheBound) {
    constexpr unsigned seed = 306;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::size_t standing = 0, other = 0;
    for (int i = 0; i < 200'000; ++i) {
        Camera camera;
        camera.eye = {170.0 * unit(random) - 85.0, 360.0 * unit(random) - 180.0, 1.0e4 * unit(random)};
        camera.attitude = {360.0 * unit(random), 120.0 * unit(random) - 90.0, 360.0 * unit(random)};
        camera.vertical_fov_deg = 10.0 + 80.0 * unit(random);
        const ClusterGroup group = group_near(camera, random);
        const Air air = i % 2 == 0 ? Air{} : Air{0.5, AirLaw::constant};
        const double px = GroupRule(camera, 1.0, air).error_px(group);
        if (!std::isfinite(px)) {
            ASSERT_FALSE(GroupRule(camera, 1.0e6, air).stands(group)) << "seed " << seed << ", case " << i;
            continue;
        }
        const double tau_px = px * (1.0 + (unit(random) - 0.5) * std::pow(10.0, -6.0 * unit(random)));
        if (GroupRule(camera, tau_px, air).stands(group)) {
            ++standing;
            ASSERT_LE(px, tau_px) << "seed " << seed << ", case " << i;
            continue;
        }
        // Near the sphere, and what its error adds, what it grows by counts most.
        const double away_m =
            glm::length(group.centre.m - camera.eye_ecef().m) - 1.05 * (group.radius_m + 3.0 * group.error_m);
        if (away_m < 0.0) continue;
        ++other;
        ASSERT_GE(px, tau_px * (1.0 - 2.0e-3)) << "seed " << seed << ", case " << i;
    }
    std::printf("seed %u: %zu groups stand, %zu do not\n", seed, standing, other);
    EXPECT_GT(standing, 40'000U);
    EXPECT_GT(other, 40'000U);
}

// Nor from a hand's breadth to another planet does a square grow too large, or too small.
TEST(GroupRules, HoldAtTheExtremes) {
    const auto asked = [](double scale_m, double distance, double error) {
        ClusterGroup group{};
        group.centre.m = glm::dvec3(6378137.0 + distance * scale_m, 0.0, 0.0);
        group.radius_m = scale_m;
        group.error_m = error * scale_m;
        group.level = 1;
        return group;
    };
    Camera camera;
    camera.eye = {0.0, 0.0, 0.0};
    for (const double scale_m : {1.0e-3, 1.0, 1.0e4, 1.0e8, 1.0e12}) {
        for (const double distance : {1.5, 3.0, 1000.0}) {
            for (const double error : {1.0e-9, 1.0e-5, 1.0e-2, 1.0}) {
                const ClusterGroup group = asked(scale_m, distance, error);
                const double px = GroupRule(camera, 1.0).error_px(group);
                if (!std::isfinite(px)) continue;
                EXPECT_TRUE(GroupRule(camera, px * 1.01).stands(group)) << scale_m << ' ' << distance;
                EXPECT_FALSE(GroupRule(camera, px * 0.99).stands(group)) << scale_m << ' ' << distance;
            }
        }
    }
    EXPECT_TRUE(GroupRule(camera, 1.0e30).stands(asked(1.0, 3.0, 0.1)));
    EXPECT_FALSE(GroupRule(camera, 0.0).stands(asked(1.0, 3.0, 1.0e-30)));
    EXPECT_TRUE(GroupRule(camera, 0.0).stands(asked(1.0, 3.0, 0.0)));
}

}  // namespace
}  // namespace oro
