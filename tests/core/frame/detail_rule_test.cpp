// What is told early about a page's detail is what the whole reckoning tells.
#include "core/frame/detail_rule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "core/lod/levels_gpu.h"

namespace oro {
namespace {

TEST(DetailRule, IsThatOfProjectedErrors) {
    constexpr unsigned seed = 5114;
    std::mt19937_64 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int good = 0, close = 0;
    constexpr int asked = 2'000'000;
    for (int i = 0; i < asked; ++i) {
        const LevelView view{static_cast<float>(between(50.0, 3000.0)), static_cast<float>(between(0.1, 3.0)),
                             i % 50 == 0 ? 0.0F : static_cast<float>(std::pow(10.0, between(-2.0, 1.5)))};
        const DetailRule rule(view, 30.0, 1.5);
        const double away_m = std::pow(10.0, between(0.0, 6.5));
        const glm::dvec3 centre_m =
            away_m * glm::normalize(glm::dvec3(between(-1.0, 1.0), between(-1.0, 1.0), between(-1.0, 0.3)));
        const double radius_m = away_m * std::pow(10.0, between(-4.0, 0.3));
        const double stretch = 1.0 + between(0.0, 0.1);
        PageQuarter quarter;
        quarter.lod_radius_m = radius_m;
        // Most errors are near those that just do.
        const double just_m =
            static_cast<double>(view.tau_px) * away_m / static_cast<double>(view.pixels_per_tangent);
        quarter.largest_error_m = static_cast<float>(
            i % 100 == 1 ? 0.0 : (i % 3 == 0 ? 1.0 : just_m + 1e-30) * std::pow(10.0, between(-1.5, 0.5)));
        const float error_m = quarter.largest_error_m * static_cast<float>(stretch);
        const float px = gpu::projected_error_px(gpu::vec3(centre_m), static_cast<float>(radius_m), error_m,
                                                 view.pixels_per_tangent, view.corner_tangent);
        const bool expected = px <= view.tau_px;
        ASSERT_EQ(rule.good_enough(quarter, {centre_m, radius_m}, glm::length(centre_m), stretch), expected)
            << "seed " << seed << ", " << i << ": " << px << " px of " << view.tau_px;
        good += expected ? 1 : 0;
        close += std::abs(px - view.tau_px) < 0.01F * view.tau_px ? 1 : 0;
    }
    std::printf("seed %u: %d good, %d within 1 %% of tau\n", seed, good, close);
    EXPECT_GT(good, asked / 20);
    EXPECT_LT(good, asked - asked / 20);
    EXPECT_GT(close, 1000);
}

TEST(DetailRule, WhatIsUnfitIsNeverGood) {
    PageQuarter quarter;
    quarter.lod_radius_m = 1.0;
    quarter.largest_error_m = gpu::unfit_error_m;
    const DetailRule rule({1000.0F, 1.0F, 1.0e30F}, 30.0, 1.5);
    EXPECT_FALSE(rule.good_enough(quarter, {{0.0, 0.0, -1.0e6}, 1.0}, 1.0e6, 1.0));
}

TEST(DetailRule, PostsAreFineEnoughByTheirSpacing) {
    // 30 m x 4 at 120 km less 20 km, 1000 pixels: 1.2 px.
    const ViewSphere seen{{0.0, 0.0, -1.2e5}, 2.0e4};
    EXPECT_TRUE(DetailRule({1000.0F, 1.0F, 1.0F}, 30.0, 1.2001).fine_enough_to_shade(2, seen, 1.2e5));
    EXPECT_FALSE(DetailRule({1000.0F, 1.0F, 1.0F}, 30.0, 1.1999).fine_enough_to_shade(2, seen, 1.2e5));
}

}  // namespace
}  // namespace oro
