// Lines of ridges: where there is one, and where ground only falls away.
#include "core/frame/ridge_lines.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/earth/camera.h"

namespace oro {
namespace {

float depth(double distance_m) {
    return static_cast<float>(near_plane_m / distance_m);
}

TEST(RidgeLines, StandOnTheNearerGroundAlone) {
    // Five rows: sky, sky, ground at 2 km, the same, the same.
    constexpr int width = 5, height = 5;
    std::vector<float> depths(width * height, depth(2000.0));
    std::fill_n(depths.begin(), 2 * width, 0.0F);
    std::vector<std::uint8_t> rgb(3 * depths.size(), 200);
    draw_ridges({depths, width, height}, rgb, 2);
    const auto code = [&](int x, int y) { return rgb[static_cast<std::size_t>(3 * (y * width + x))]; };
    EXPECT_EQ(code(2, 1), 200);
    EXPECT_EQ(code(2, 3), 200);
    // 0.75 at 1 km falls to 0.3 at 100 km by the logarithm: 0.68227 at 2 km; 200 - 0.68227 * (200 - 28)
    // = 82.6.
    EXPECT_EQ(code(2, 2), 83);
    EXPECT_EQ(code(0, 2), 200) << "the border has no neighbour";
}

// The same edge, of trees: none within 1 km, half of it at 3 km, whole from 5 km on.
TEST(RidgeLines, LeaveOutTreesNearTheEye) {
    constexpr int width = 3, height = 4;
    const auto code = [&](double distance_m, bool of_trees) {
        std::vector<float> depths(width * height, depth(distance_m) * (of_trees ? -1.0F : 1.0F));
        std::fill_n(depths.begin(), width, 0.0F);
        std::vector<std::uint8_t> rgb(3 * depths.size(), 200);
        draw_ridges({depths, width, height}, rgb, 1);
        return static_cast<int>(rgb[3 * (width + 1)]);
    };
    EXPECT_EQ(code(900.0, true), 200);
    EXPECT_LT(code(900.0, false), 100);
    const int whole = 200 - code(3000.0, false), half = 200 - code(3000.0, true);
    EXPECT_NEAR(half, 0.5 * whole, 1.0);
    EXPECT_EQ(code(6000.0, true), code(6000.0, false));
}

// A plain below an eye: its rows come ever closer to the horizon, and reversed depths change evenly. So does
// a slope.
TEST(RidgeLines, AreNotOnPlains) {
    for (int row = 1; row < 200; ++row) {
        const double own = 1e-8 * row, beyond = 1e-8 * (row - 1), before = 1e-8 * (row + 1);
        EXPECT_EQ(ridge_share(own, beyond, before, near_plane_m / own), 0.0) << row;
    }
    EXPECT_GT(ridge_share(2e-6, 1e-6, 2.001e-6, 5000.0), 0.3);
    // Farther ridges are fainter.
    EXPECT_GT(ridge_share(1.0, 0.0, 1.0, 1e3), ridge_share(1.0, 0.0, 1.0, 3e4));
    EXPECT_NEAR(ridge_share(1.0, 0.0, 1.0, 1e6), 0.3, 1e-12);
}

}  // namespace
}  // namespace oro
