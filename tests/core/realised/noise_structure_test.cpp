// The covariances that simulated noise is said to have, against the noise itself.
#include "core/realised/noise_structure.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "core/realised/post_predictor.h"
#include "core/realised/realised_heights.h"

namespace oro {
namespace {

// Pairs of places anywhere near the Earth's surface, in any direction, so far apart.
struct Pairs {
    NoisePlaces from, to;
};
Pairs random_pairs(std::mt19937& random, double distance_m, int count) {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> radius(6.3e6, 6.4e6);
    Pairs pairs;
    for (int i = 0; i < count; ++i) {
        double at[3], way[3], at_length = 0.0, way_length = 0.0;
        for (int k = 0; k < 3; ++k) {
            at[k] = normal(random);
            way[k] = normal(random);
            at_length += at[k] * at[k];
            way_length += way[k] * way[k];
        }
        std::vector<std::int32_t>* const first[] = {&pairs.from.x, &pairs.from.y, &pairs.from.z};
        std::vector<std::int32_t>* const second[] = {&pairs.to.x, &pairs.to.y, &pairs.to.z};
        const double r = radius(random);
        for (int k = 0; k < 3; ++k) {
            const double place_m = at[k] / std::sqrt(at_length) * r;
            first[k]->push_back(static_cast<std::int32_t>(std::lround(place_m * 64.0)));
            second[k]->push_back(static_cast<std::int32_t>(
                std::lround((place_m + way[k] / std::sqrt(way_length) * distance_m) * 64.0)));
        }
    }
    return pairs;
}

TEST(NoiseStructure, OfSimulatedNoiseIsWhatItIsSaidToBe) {
    constexpr unsigned seed = 53;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const std::vector<NoiseBand> bands{{std::exp2(14) / 192.0, 4.0}, {std::exp2(15) / 192.0, 9.0}};
    constexpr int count = 200000;
    for (const double distance_m : {0.0, 10.0, 40.0, 80.0, 130.0, 200.0, 400.0}) {
        const Pairs pairs = random_pairs(random, distance_m, count);
        std::vector<float> from(count), to(count);
        add_noise(bands, 1.0, 7, pairs.from, from);
        add_noise(bands, 1.0, 7, pairs.to, to);
        double products = 0.0, differences = 0.0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            products += static_cast<double>(from[i]) * static_cast<double>(to[i]);
            differences += 0.5 * std::pow(static_cast<double>(from[i]) - static_cast<double>(to[i]), 2);
        }
        // Square metres of 13; 200,000 pairs scatter by some 0.04.
        EXPECT_NEAR(products / count, covariance_of(bands, distance_m), 0.16) << distance_m;
        EXPECT_NEAR(differences / count, semivariance_of(bands, distance_m), 0.16) << distance_m;
    }
}

TEST(NoiseStructure, SecondDifferencesFollowFromCovariances) {
    const std::vector<NoiseBand> bands{{85.3, 2.0}, {341.3, 5.0}};
    for (const double d : {5.0, 60.0, 170.0, 500.0})
        EXPECT_NEAR(second_difference_of(bands, d),
                    6.0 * covariance_of(bands, 0.0) - 8.0 * covariance_of(bands, d) +
                        2.0 * covariance_of(bands, 2.0 * d),
                    1e-9);
}

TEST(NoiseStructure, OfErrorsFallsTo1OfEAtTheLengthThatWasGiven) {
    for (const double length_m : {0.1, 30.0, 185.0, 5000.0, 100000.0}) {
        const ErrorNoise noise = error_noise({9.7, length_m});
        EXPECT_NEAR(covariance_of(noise.bands, 0.0), 9.7 * 9.7, 1e-9);
        EXPECT_NEAR(covariance_of(noise.bands, length_m) / (9.7 * 9.7), std::exp(-1.0), 1e-6) << length_m;
    }
}

// Mean square error of a weighted sum of heights with errors as a guess of the height in the middle: by
// definition, from semivariances and covariances. Weights sum to 1.
double mean_square(const std::vector<double>& weights, const std::vector<NoiseBand>& ground,
                   const std::vector<NoiseBand>& errors, double row_m, double column_m) {
    constexpr int side = predictor_side;
    const auto away_m = [&](int one, int other) {
        return std::hypot((one / side - other / side) * row_m, (one % side - other % side) * column_m);
    };
    double sum = 0.0;
    for (int i = 0; i < side * side; ++i) {
        const double w = weights[static_cast<std::size_t>(i)];
        sum += 2.0 * w * semivariance_of(ground, away_m(i, side * side / 2));
        for (int j = 0; j < side * side; ++j)
            sum += w * weights[static_cast<std::size_t>(j)] *
                   (covariance_of(errors, away_m(i, j)) - semivariance_of(ground, away_m(i, j)));
    }
    return sum;
}

TEST(PostPredictor, NoOtherWeightsLeaveASmallerError) {
    constexpr unsigned seed = 54;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const std::vector<NoiseBand> ground{{80.0, 4.0}, {160.0, 16.0}, {320.0, 64.0}, {2560.0, 4000.0}};
    for (const double correlation_m : {20.0, 180.0, 600.0}) {
        const ErrorNoise errors = error_noise({9.7, correlation_m});
        const std::vector<float> found = predictor_weights(ground, errors.bands, 92.6, 64.3, 1).front();
        ASSERT_EQ(found.size(), static_cast<std::size_t>(predictor_side * predictor_side));
        std::vector<double> weights(found.begin(), found.end());
        double sum = 0.0;
        for (const double weight : weights) sum += weight;
        EXPECT_NEAR(sum, 1.0, 1e-5);
        const double least = mean_square(weights, ground, errors.bands, 92.6, 64.3);
        EXPECT_GT(least, 0.0);
        EXPECT_LT(least, 9.7 * 9.7);  // the post's own error
        for (int i = 0; i < 30; ++i) {
            std::vector<double> other = weights;
            double added = 0.0;
            for (double& weight : other) {
                const double by = 0.01 * normal(random);
                weight += by;
                added += by;
            }
            for (double& weight : other) weight -= added / static_cast<double>(other.size());
            EXPECT_GT(mean_square(other, ground, errors.bands, 92.6, 64.3), least);
        }
        std::printf("errors of 9.7 m correlated over %.0f m: the guess is %.2f m off\n", correlation_m,
                    std::sqrt(least));
    }
}

// Waves in the data are damped, more where errors are the larger share of them, and never made larger or
// turned over: kernels of covariances that are off by 1e-5 did that to checkers of posts.
TEST(PostPredictor, DampsWavesOfAllLengths) {
    constexpr int side = predictor_side, reach = predictor_reach;
    for (const auto& [roughness_m, exponent, correlation_m] :
         {std::array{2.4, 1.4, 185.0}, {1.6, 0.9, 185.0}, {0.3, 1.2, 60.0}, {5.0, 0.5, 400.0}}) {
        std::vector<NoiseBand> ground{
            {42.7, std::exp2(-2.0 * exponent) / (1.0 - std::exp2(-2.0 * exponent))}};
        for (int i = 0; i < 6; ++i) ground.push_back({85.3 * std::exp2(i), std::exp2(2.0 * exponent * i)});
        for (NoiseBand& band : ground) band.variance *= roughness_m * roughness_m;
        const std::vector<float> weights =
            predictor_weights(ground, error_noise({9.7, correlation_m}).bands, 92.6, 63.7, 1).front();
        double least = 1.0, most = 0.0;
        for (int down = 0; down <= 10; ++down)
            for (int right = 0; right <= 10; ++right) {
                double response = 0.0;  // of a wave of so many twentieths of a turn a post
                for (int row = 0; row < side; ++row)
                    for (int column = 0; column < side; ++column)
                        response +=
                            static_cast<double>(weights[static_cast<std::size_t>(row * side + column)]) *
                            std::cos(std::numbers::pi / 10.0 *
                                     (down * (row - reach) + right * (column - reach)));
                least = std::min(least, response);
                most = std::max(most, response);
            }
        std::printf("roughness %.1f m, exponent %.1f, errors over %.0f m: %.3f to %.3f\n", roughness_m,
                    exponent, correlation_m, least, most);
        EXPECT_GT(least, -0.15);
        EXPECT_LT(most, 1.25);
    }
}

TEST(PostPredictor, OfExactDataIsTheDataAndOfFlatGroundTheMean) {
    const std::vector<NoiseBand> ground{{80.0, 4.0}, {2560.0, 4000.0}};
    const std::vector<float> exact =
        predictor_weights(ground, error_noise({0.001, 180.0}).bands, 92.6, 64.3, 1).front();
    EXPECT_NEAR(exact[predictor_side * predictor_side / 2], 1.0F, 1e-3F);
    const std::vector<NoiseBand> flat{{80.0, 1e-9}};
    const std::vector<float> mean =
        predictor_weights(flat, error_noise({9.7, 0.1}).bands, 92.6, 64.3, 1).front();
    for (const float weight : mean) EXPECT_NEAR(weight, 1.0F / (predictor_side * predictor_side), 1e-4F);
}

}  // namespace
}  // namespace oro
