// The colours of pictures that explain a frame.
#include "core/frame/frame_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace oro {
namespace {

// The finest level is blue, the ninth between blue and teal; the 17th is the first, paler: 0.6 of it and 0.4
// of 0.92.
TEST(FrameColours, OfLevelsComeAgainPaler) {
    const std::array<float, 3> blue{0.16F, 0.38F, 0.78F}, between{0.10F, 0.55F, 0.80F},
        pale{0.464F, 0.596F, 0.836F};
    for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        EXPECT_FLOAT_EQ(colour_of_level(0)[c], blue[i]);
        EXPECT_FLOAT_EQ(colour_of_level(8)[c], between[i]);
        EXPECT_FLOAT_EQ(colour_of_level(16)[c], pale[i]);
    }
}

// How far apart two colours are at least, of 1, where the second one has from 0.7 to 1 / 0.7 of the light.
float apart_in_any_light(const gpu::vec3& one, const gpu::vec3& other) {
    float least = 1.0F;
    for (float light = 0.7F; light < 1.43F; light *= 1.005F) {
        float apart = 0.0F;
        for (int c = 0; c < 3; ++c) apart = std::max(apart, std::abs(one[c] - light * other[c]));
        least = std::min(least, apart);
    }
    return least;
}

// No region has so many levels. A slope in the shade is darker than one in the sun: that makes no level of
// another. 0.035 are 9 of 255.
TEST(FrameColours, NoTwoOf32LevelsLookAlikeInAnyLight) {
    for (gpu::uint one = 0; one < 32; ++one)
        for (gpu::uint other = 0; other < one; ++other) {
            const float apart = apart_in_any_light(colour_of_level(one), colour_of_level(other));
            EXPECT_GT(apart, 0.035F) << one << " and " << other;
            if (one < 24) {
                EXPECT_GT(apart, 0.065F) << one << " and " << other;
            }
        }
}

}  // namespace
}  // namespace oro
