// The colours of pictures that explain a frame.
#include "core/frame/frame_colours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace oro {
namespace {

// The finest level is blue; the ninth is the same, darker: 1 - 0.24 of it.
TEST(FrameColours, OfLevelsComeAgainDarker) {
    const std::array<float, 3> blue{0.16F, 0.38F, 0.78F}, dark{0.1216F, 0.2888F, 0.5928F};
    for (int c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(colour_of_level(0)[c], blue[static_cast<std::size_t>(c)]);
        EXPECT_FLOAT_EQ(colour_of_level(8)[c], dark[static_cast<std::size_t>(c)]);
    }
}

// No region has so many levels.
TEST(FrameColours, NoTwoOf32LevelsLookAlike) {
    for (gpu::uint one = 0; one < 32; ++one)
        for (gpu::uint other = 0; other < one; ++other) {
            float apart = 0.0F;
            for (int c = 0; c < 3; ++c)
                apart = std::max(apart, std::abs(colour_of_level(one)[c] - colour_of_level(other)[c]));
            EXPECT_GT(apart, 0.02F) << one << " and " << other;
        }
}

}  // namespace
}  // namespace oro
