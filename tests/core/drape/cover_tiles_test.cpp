// Texels of land cover: four shares in fifteenths, and means that stay.
#include "core/drape/cover_tiles.h"

#include <gtest/gtest.h>

#include <random>

namespace oro {
namespace {

using TexelShares = CoverTexels::Shares;

TEST(CoverTexels, OneGroundIsAllFifteen) {
    CoverTexels texels(3);
    TexelShares rock{};
    rock[4] = 1.0F;
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(texels.pack(i % 3, rock), 0xF4U);
}

TEST(CoverTexels, SharesOfFourAreThose) {
    TexelShares shares{};
    shares[0] = 8.0F / 15.0F;
    shares[3] = 4.0F / 15.0F;
    shares[9] = 2.0F / 15.0F;
    shares[unknown_ground] = 1.0F / 15.0F;
    EXPECT_EQ(CoverTexels(1).pack(0, shares), 0x1F294380U);
}

// Random shares of nine grounds, with more of some: the mean of 40 x 40 texels is that of the shares within
// a hundredth, though each texel names four.
TEST(CoverTexels, MeansStayWhereATexelCannotHoldAll) {
    const unsigned seed = 20261127;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> any(0.0F, 1.0F);
    constexpr std::size_t side = 40;
    CoverTexels texels(side);
    std::array<double, unknown_ground + 1> truth{}, found{};
    for (std::size_t i = 0; i < side * side; ++i) {
        TexelShares shares{};
        float sum = 0.0F;
        for (std::size_t k = 0; k < 9; ++k) sum += shares[k] = any(random) / static_cast<float>(k + 1);
        for (float& share : shares) share /= sum;
        std::uint32_t texel = texels.pack(i % side, shares), units = 0;
        for (std::size_t k = 0; k < truth.size(); ++k) truth[k] += static_cast<double>(shares[k]);
        for (; texel != 0U; texel >>= 8U) {
            found[texel & 15U] += (texel >> 4U & 15U) / 15.0;
            units += texel >> 4U & 15U;
        }
        ASSERT_EQ(units, cover_units);
    }
    for (std::size_t k = 0; k < truth.size(); ++k)
        EXPECT_NEAR(found[k] / (side * side), truth[k] / (side * side), 0.01) << k << ", seed " << seed;
}

}  // namespace
}  // namespace oro
