// A part of a sheet as a window shows it.
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "apps/window/panorama_from_place.h"

namespace oro {
namespace {

using Rgba = std::array<int, 4>;
constexpr Rgba beside{24, 28, 32, 255};

// 4 x 2 pixels: red 10, 20, 30, 40 and 50, 60, 70, 80; green twice that, blue 0.
std::vector<std::uint8_t> sheet() {
    std::vector<std::uint8_t> rgb;
    for (int i = 1; i <= 8; ++i) {
        rgb.push_back(static_cast<std::uint8_t>(10 * i));
        rgb.push_back(static_cast<std::uint8_t>(20 * i));
        rgb.push_back(0);
    }
    return rgb;
}

std::vector<Rgba> shown(const SheetPart& part) {
    const std::vector<std::uint8_t> bytes = pixels_of(part, sheet(), 4, 2);
    std::vector<Rgba> pixels;
    for (std::size_t i = 0; i + 3 < bytes.size(); i += 4)
        pixels.push_back({bytes[i], bytes[i + 1], bytes[i + 2], bytes[i + 3]});
    return pixels;
}

Rgba red(int value) {
    return {value, 2 * value, 0, 255};
}

TEST(SheetParts, AreThePixelsAtTheirOwnSize) {
    EXPECT_EQ(shown({1.0, 0.0, 1.0, 2, 2}), (std::vector<Rgba>{red(20), red(30), red(60), red(70)}));
    EXPECT_EQ(shown({-1.0, -1.0, 1.0, 2, 2}), (std::vector<Rgba>{beside, beside, beside, red(10)}));
    EXPECT_EQ(shown({3.0, 1.0, 1.0, 2, 2}), (std::vector<Rgba>{red(80), beside, beside, beside}));
}

TEST(SheetParts, AreMeansWhereTheyAreSmaller) {
    // (10 + 20 + 50 + 60) / 4 = 35, (30 + 40 + 70 + 80) / 4 = 55.
    EXPECT_EQ(shown({0.0, 0.0, 0.5, 2, 1}), (std::vector<Rgba>{red(35), red(55)}));
}

TEST(SheetParts, RepeatPixelsWhereTheyAreLarger) {
    EXPECT_EQ(shown({1.0, 0.0, 2.0, 3, 1}), (std::vector<Rgba>{red(20), red(20), red(30)}));
}

}  // namespace
}  // namespace oro
