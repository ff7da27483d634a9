// The rule of blades of grass: bounds that culling takes, thinning, and wind.
#include "core/growth/meadow_blades.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace oro {
namespace {

glm::dvec3 on_curve(const MeadowCurve& curve, double along) {
    const double rest = 1.0 - along;
    return curve.control[0] * (rest * rest) + curve.control[1] * (2.0 * along * rest) +
           curve.control[2] * (along * along);
}

// Brute force: 40 places on both sides of each of 100,000 blades, in more wind than ever blows.
TEST(MeadowBlades, StayWithinTheirClumpsReach) {
    constexpr unsigned seed = 20261128;
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    double widest = 0.0, tallest = 0.0;
    for (int i = 0; i < 100'000; ++i) {
        const MeadowStand stand{static_cast<std::uint32_t>(random()), static_cast<std::uint32_t>(random()),
                                number(0.5, meadow_size_most()), glm::dvec2(0.0),
                                glm::dvec2(number(-1.0, 1.0), number(-1.0, 1.0))};
        const auto blade = static_cast<std::uint32_t>(random() % 32);
        const MeadowCurve curve = meadow_curve(stand, blade, number(0.0, 1.0));
        double below_m = -1.0;
        for (int j = 0; j < 20; ++j) {
            const double along = j / 19.0;
            const glm::dvec3 at = on_curve(curve, along);
            const glm::dvec2 across = 0.5 * meadow_blade_width_m() * meadow_taper(along) * curve.side;
            for (const double side : {-1.0, 1.0}) {
                const double out = std::hypot(at.x + side * across.x, at.y + side * across.y);
                ASSERT_LE(out, meadow_reach_m(stand.size)) << "seed " << seed << ", blade " << i;
                widest = std::max(widest, out / meadow_reach_m(stand.size));
            }
            ASSERT_LE(at.z, meadow_height_m(stand.size) + 1e-6) << "seed " << seed << ", blade " << i;
            ASSERT_GE(at.z, below_m - 1e-7) << "seed " << seed << ", blade " << i << ": it goes down";
            below_m = at.z;
            tallest = std::max(tallest, at.z / meadow_height_m(stand.size));
        }
    }
    // The bounds are not much too wide either.
    EXPECT_GT(widest, 0.7);
    EXPECT_GT(tallest, 0.9);
}

// Where pixels are larger than blades are wide, as many fewer stand as they are wider: the ground covered
// stays.
TEST(MeadowBlades, CoverAsMuchWhereTheyThin) {
    const double seen_m = 0.82 * meadow_blade_width_m();  // at a slant, as the rule has it
    const auto mean_width_m = [&](double pixel_m) {
        double sum = 0.0;
        for (int i = 0; i < 10'000; ++i) sum += std::max(seen_m * meadow_taper((i + 0.5) / 10'000), pixel_m);
        return sum / 10'000;
    };
    const double all = 32.0 * mean_width_m(0.0);
    for (const double pixel_m : {0.0, 0.001, 0.003, 0.006, 0.02, 0.05, 0.2})
        EXPECT_NEAR(meadow_blades_kept(pixel_m) * mean_width_m(pixel_m) / all, 1.0, 0.002) << pixel_m;
}

// In the order of their numbers, without a jump: less than a tenth of a blade for one part in a hundred.
TEST(MeadowBlades, ThinInNestedOrder) {
    double jump = 0.0;
    for (std::uint32_t blade = 0; blade < 32; ++blade) {
        double before = meadow_grown(0.5, blade);
        for (double kept = 0.505; kept <= 32.0; kept *= 1.01) {
            const double grown = meadow_grown(kept, blade);
            ASSERT_GE(grown, before) << kept;
            if (static_cast<double>(blade) >= kept) {
                EXPECT_EQ(grown, 0.0) << kept;
            }
            jump = std::max(jump, grown - before);
            before = grown;
        }
        EXPECT_GT(meadow_grown(32.0, 0), 0.99);
    }
    EXPECT_LT(jump, 0.1);
    EXPECT_EQ(meadow_share_at(20.0), 1.0);
    EXPECT_EQ(meadow_share_at(60.0), 0.0);
}

TEST(MeadowBlades, MoveByTheClockAlone) {
    EXPECT_EQ(meadow_wind(41'000'000, 70'000'000, 0.0, 43'200.0), glm::dvec2(0.0));
    const glm::dvec2 one = meadow_wind(41'000'000, 70'000'000, 1.0, 43'200.0);
    EXPECT_EQ(one, meadow_wind(41'000'000, 70'000'000, 1.0, 43'200.0));
    EXPECT_NE(one, meadow_wind(41'000'000, 70'000'000, 1.0, 43'201.0));
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec2 wind = meadow_wind(41'000'000, 70'000'000, 1.0, i * 43.17);
        ASSERT_LE(std::hypot(wind.x, wind.y), 0.42) << i;
    }
}

}  // namespace
}  // namespace oro
