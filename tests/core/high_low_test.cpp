#include "core/high_low.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace oro {
namespace {

// Found in a release build: every low part but one in three came out 0, and posts on page rims lay up to 0.4
// m off.
TEST(HighLow, SumIsTheValueToTwoToTheMinus48) {
    constexpr unsigned seed = 7;
    std::printf("seed %u\n", seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate_m(-7e6, 7e6);
    for (int i = 0; i < 100000; ++i) {
        const glm::dvec3 value(coordinate_m(random), coordinate_m(random), coordinate_m(random));
        gpu::vec3 high, low;
        split_high_low(value, high, low);
        for (int axis = 0; axis < 3; ++axis) {
            const double sum = static_cast<double>(high[axis]) + static_cast<double>(low[axis]);
            ASSERT_NEAR(sum, value[axis], std::ldexp(std::abs(value[axis]), -47)) << "axis " << axis;
        }
    }
}

TEST(HighLow, LiteralParts) {
    gpu::vec3 high, low;
    split_high_low({4355136.25 + 0.2342, -619827.6737, 0.0}, high, low);
    EXPECT_FLOAT_EQ(high.x, 4355136.0F);
    EXPECT_NEAR(static_cast<double>(low.x), 0.4842, 1e-7);
    EXPECT_FLOAT_EQ(high.y, -619827.625F);
    EXPECT_NEAR(static_cast<double>(low.y), -0.0487, 1e-7);
    EXPECT_EQ(high.z, 0.0F);
    EXPECT_EQ(low.z, 0.0F);
}

}  // namespace
}  // namespace oro
