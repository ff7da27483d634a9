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

// Of finer ones every third post is a post of the data: the same ground as of those that are not, but for
// what narrower noise adds, and as far from the truth; between them lies ground as rough as the truth's. Mean
// squares of second differences of three posts a third apart: ratio 0.7 to 1.4.
TEST(RealisedHeights, BetweenPostsAreAsRoughAsTheTruth) {
    const ErrorWorld world = error_world(31, deviation_m, correlation_m, 3);
    const auto realised = RealisedHeights::create(world.data, whole, {deviation_m, correlation_m}, 3);
    ASSERT_TRUE(realised.ok());
    const HeightField field = realised.value().realisation(1);
    ASSERT_EQ(field.grid.rows(), world.truth.grid.rows());
    ASSERT_EQ(field.grid.columns(), world.truth.grid.columns());
    EXPECT_NEAR(field.grid.lat.at_deg(7), world.truth.grid.lat.at_deg(7), 1e-12);
    EXPECT_NEAR(field.grid.lon.at_deg(7), world.truth.grid.lon.at_deg(7), 1e-12);
    const auto bends = [](const HeightField& of) {
        double sum = 0.0;
        for (int row = 1; row + 1 < of.grid.rows(); ++row)
            for (int column = 0; column < of.grid.columns(); ++column)
                sum += std::pow(static_cast<double>(of.H_at_post_m(row - 1, column)) -
                                    2.0 * static_cast<double>(of.H_at_post_m(row, column)) +
                                    static_cast<double>(of.H_at_post_m(row + 1, column)),
                                2);
        return sum;
    };
    double off = 0.0;
    for (std::size_t i = 0; i < field.H_m.size(); ++i)
        off += std::pow(static_cast<double>(field.H_m[i]) - static_cast<double>(world.truth.H_m[i]), 2);
    off = std::sqrt(off / static_cast<double>(field.H_m.size()));
    std::printf("bends %.2f of the truth's, off by %.2f m\n", bends(field) / bends(world.truth), off);
    EXPECT_NEAR(bends(field) / bends(world.truth), 1.05, 0.35);
    EXPECT_LT(off, 14.0);  // guess and scatter, 7.5 m each
}

TEST(RealisedHeights, VoidPostsLeaveTheCellsAroundThemVoidWhereTheyAreFiner) {
    ErrorWorld world = error_world(3, deviation_m, correlation_m);
    world.data.H_m[static_cast<std::size_t>(80 * 161 + 60)] = void_height_m;
    const auto realised = RealisedHeights::create(world.data, whole, {deviation_m, correlation_m}, 2);
    ASSERT_TRUE(realised.ok());
    const HeightField field = realised.value().realisation(4);
    int voids = 0;
    for (const float H_m : field.H_m) voids += is_void(H_m);
    EXPECT_EQ(voids, 9);
    EXPECT_TRUE(is_void(field.H_at_post_m(160, 120)));
    EXPECT_TRUE(is_void(field.H_at_post_m(159, 121)));
    EXPECT_FALSE(is_void(field.H_at_post_m(158, 120)));
}

Calibration calibration_of(std::uint32_t worlds, int realisations, int finer = 1) {
    std::vector<Calibration> each(worlds);
    in_parallel(static_cast<int>(worlds), thread_count(), [&](int i) {
        const auto seed = static_cast<std::uint32_t>(i);
        add_world(error_world(1000 + seed, deviation_m, correlation_m, finer), seed, deviation_m,
                  correlation_m, realisations, each[seed], finer);
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

// The truth has three posts in place of one of the data, and hides by what lies between them.
TEST(SeenProbability, OfFinerWorldsIsWhatIsSeen) {
    const Calibration found = calibration_of(60, 40, 3);
    EXPECT_LE(found.posterior.worst_points(0.0), 3.0);
    EXPECT_LT(found.posterior.brier(), found.yes_no.brier());
}

}  // namespace
}  // namespace oro::test
