// Realisations: the same bits for a seed, as far from the truth as they say, and calibrated in what they see.
#include "core/realised/realised_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "core/base/parallel.h"
#include "tests/core/realised/calibration.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {
namespace {

constexpr double deviation_m = 9.7;      // 16 m with 90 %: SRTM's
constexpr double correlation_m = 180.0;  // two posts
constexpr GridPart whole{0, 161, 0, 161};

TEST(RealisedHeights, OfASeedAreTheSameFromAnyThread) {
    const ErrorWorld world = error_world(1, deviation_m, correlation_m);
    const auto realised = RealisedHeights::create(world.data, whole, {deviation_m, correlation_m});
    ASSERT_TRUE(realised.ok());
    std::vector<HeightField> one(6), many(6);
    in_parallel(6, 1, [&](int i) { one[i] = realised.value().realisation(static_cast<std::uint32_t>(i)); });
    in_parallel(6, 4, [&](int i) { many[i] = realised.value().realisation(static_cast<std::uint32_t>(i)); });
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].H_m, many[i].H_m) << i;
    EXPECT_NE(one[0].H_m, one[1].H_m);
}

// Realisations lie about the guess as the truth does: their scatter is the guess's error. Ratio 0.85 to 1.15.
TEST(RealisedHeights, ScatterAsMuchAsTheTruthDoes) {
    double scatter = 0.0, off = 0.0, data_off = 0.0;
    for (std::uint32_t seed = 20; seed < 26; ++seed) {
        const ErrorWorld world = error_world(seed, deviation_m, correlation_m);
        const auto realised = RealisedHeights::create(world.data, whole, {deviation_m, correlation_m});
        ASSERT_TRUE(realised.ok());
        constexpr int count = 30;
        std::vector<double> sums(world.data.H_m.size()), squares(sums.size());
        for (std::uint32_t i = 0; i < count; ++i) {
            const HeightField field = realised.value().realisation(i);
            for (std::size_t k = 0; k < sums.size(); ++k) {
                const double by = static_cast<double>(field.H_m[k]) - static_cast<double>(world.truth.H_m[k]);
                sums[k] += by;
                squares[k] += by * by;
            }
        }
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const double variance = (squares[k] - sums[k] * sums[k] / count) / (count - 1);
            scatter += variance;
            off += sums[k] * sums[k] / (count * count) - variance / count;
            data_off +=
                std::pow(static_cast<double>(world.data.H_m[k]) - static_cast<double>(world.truth.H_m[k]), 2);
        }
    }
    const double posts = 6.0 * 161.0 * 161.0;
    std::printf("scatter %.3f m, guess off by %.3f m, data by %.3f m\n", std::sqrt(scatter / posts),
                std::sqrt(off / posts), std::sqrt(data_off / posts));
    EXPECT_NEAR(std::sqrt(data_off / posts), deviation_m, 0.3);
    EXPECT_LT(off, data_off);
    EXPECT_NEAR(std::sqrt(scatter / off), 1.0, 0.15);
}

TEST(RealisedHeights, VoidPostsStayVoidAndHarmNoOthers) {
    ErrorWorld world = error_world(3, deviation_m, correlation_m);
    for (int row = 70; row < 80; ++row)
        for (int column = 40; column < 90; ++column)
            world.data.H_m[static_cast<std::size_t>(row * 161 + column)] = void_height_m;
    const auto realised = RealisedHeights::create(world.data, whole, {deviation_m, correlation_m});
    ASSERT_TRUE(realised.ok());
    const HeightField field = realised.value().realisation(4);
    for (std::size_t i = 0; i < field.H_m.size(); ++i) {
        ASSERT_EQ(is_void(field.H_m[i]), is_void(world.data.H_m[i])) << i;
        if (!is_void(field.H_m[i])) {
            ASSERT_LT(std::abs(field.H_m[i] - world.truth.H_m[i]), 70.0F) << i;
        }
    }
}

// A part's posts have the heights that they have in a larger one, where the ground is as rough.
TEST(RealisedHeights, OfAPartLieWhereThePartDoes) {
    const HeightField field = rough_field(46.6, 8.4, 121, 141);
    const auto realised = RealisedHeights::create(field, {30, 50, 20, 70}, {0.05, 180.0});
    ASSERT_TRUE(realised.ok());
    const HeightField part = realised.value().realisation(1);
    ASSERT_EQ(part.grid.rows(), 50);
    ASSERT_EQ(part.grid.columns(), 70);
    for (int row = 0; row < 50; ++row)
        for (int column = 0; column < 70; ++column) {
            ASSERT_NEAR(part.grid.lat.at_deg(row), field.grid.lat.at_deg(row + 30), 1e-12);
            ASSERT_NEAR(part.grid.lon.at_deg(column), field.grid.lon.at_deg(column + 20), 1e-12);
            ASSERT_NEAR(part.H_at_post_m(row, column), field.H_at_post_m(row + 30, column + 20), 0.5F);
        }
}

Calibration calibration_of(std::uint32_t worlds, int realisations) {
    std::vector<Calibration> each(worlds);
    in_parallel(static_cast<int>(worlds), thread_count(), [&](int i) {
        const auto seed = static_cast<std::uint32_t>(i);
        add_world(error_world(1000 + seed, deviation_m, correlation_m), seed, deviation_m, correlation_m,
                  realisations, each[seed]);
    });
    Calibration sum;
    for (const Calibration& one : each) sum.add(one);
    sum.print();
    return sum;
}

// Posts of one world share an observer, whose place may be off: a handful of worlds tells tenths to some
// 10 points.
TEST(SeenProbability, IsBetterThanYesOrNoAndThanNoiseAdded) {
    const Calibration found = calibration_of(5, 20);
    EXPECT_LT(found.posterior.brier(), 0.75 * found.data_and_noise.brier());
    EXPECT_LT(found.posterior.brier(), 0.75 * found.yes_no.brier());
    EXPECT_LT(found.posterior.mean_points(), 6.0);
    EXPECT_GT(found.data_and_noise.worst_points(0.005), 20.0);
}

TEST(SeenProbability, OfTwoHundredWorldsIsWhatIsSeen) {
    const Calibration found = calibration_of(200, 50);
    EXPECT_LE(found.posterior.worst_points(0.0), 3.0);
    EXPECT_LT(found.posterior.brier(), found.data_and_noise.brier());
    EXPECT_LT(found.posterior.brier(), found.yes_no.brier());
}

}  // namespace
}  // namespace oro::test
