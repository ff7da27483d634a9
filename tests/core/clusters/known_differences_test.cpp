// Differences that are kept: what is not known well enough is measured again.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "core/clusters/known_differences.h"

namespace oro {
namespace {

// As OriginalSurface answers: the difference, or, above the limit, something between.
double answer(double difference, double limit) {
    return difference > limit ? 0.5 * (limit + difference) : difference;
}

TEST(KnownDifferences, AnswersAsTheSurfaceDoes) {
    constexpr unsigned seed = 52;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    KnownDifferences known;
    int group = 0, measured = 0;
    constexpr int asked = 200'000;
    for (int i = 0; i < asked; ++i) {
        if (i % 5'000 == 0) {
            known.forget();
            ++group;
        }
        // 1,600 edges and 8,192 places: some have one place in common.
        const int from = static_cast<int>(random() % 40), to = static_cast<int>(random() % 40);
        const double difference = (group * 7 + from * 31 + to * 17) % 100;
        const double limit = static_cast<double>(random() % 120);
        const double found = known.find({from, to}, limit, [&] {
            ++measured;
            return answer(difference, limit);
        });
        EXPECT_LE(found, difference);
        if (difference <= limit)
            EXPECT_EQ(found, difference);
        else
            EXPECT_GT(found, limit);
    }
    std::printf("%d of %d measured\n", measured, asked);
    EXPECT_LT(measured, asked * 3 / 4);
}

}  // namespace
}  // namespace oro
