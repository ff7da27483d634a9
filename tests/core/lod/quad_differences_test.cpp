// Posts against a quad's planes several at a time, against one by one.
#include "core/lod/quad_differences.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/floor_within.h"

namespace oro {
namespace {

TEST(QuadDifferences, AreThoseOfEachPost) {
    std::mt19937_64 random(12);
    for (const int size : {1, 2, 3, 4, 5, 8, 16, 33, 64}) {
        const int stride = size + 1 + static_cast<int>(random() % 5);
        std::vector<std::int32_t> posts(static_cast<std::size_t>(stride * (size + 1)));
        for (std::int32_t& post : posts) post = static_cast<std::int32_t>(random() % 8'000'000) - 200'000;
        const auto at = [&](int row, int column) {
            return posts[static_cast<std::size_t>(row * stride + column)];
        };
        for (const Diagonal diagonal : {Diagonal::nw_se, Diagonal::sw_ne}) {
            const auto plane = [&](bool west) {
                return cell_plane(diagonal, west, at(0, 0), at(0, size), at(size, 0), at(size, size));
            };
            double largest = 0.0;
            for (int i = 0; i <= size; ++i) {
                for (int j = 0; j <= size; ++j) {
                    const CellPlane own = plane(j <= (diagonal == Diagonal::nw_se ? i : size - i));
                    const double share = 1.0 / size;
                    const double on =
                        own.at_corner + i * (share * own.change_down) + j * (share * own.change_right);
                    largest = std::max(largest, std::abs(at(i, j) - on));
                }
            }
            const QuadDifferences found =
                quad_differences(posts.data(), stride, size, diagonal, plane(true), plane(false));
            EXPECT_EQ(found.largest_steps, largest) << size;
            EXPECT_NE(found.lowest_steps, void_height_steps);
        }
        posts[random() % static_cast<std::size_t>(size + 1)] = void_height_steps;
        const CellPlane flat{0.0, 0.0, 0.0};
        EXPECT_EQ(quad_differences(posts.data(), stride, size, Diagonal::nw_se, flat, flat).lowest_steps,
                  void_height_steps);
    }
}

TEST(FloorWithin, IsTheFloorWithinTheLimits) {
    constexpr double limit = 1 << 30;
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> wide(-3.0e9, 3.0e9), narrow(-3.0, 3.0);
    for (int i = 0; i < 100'000; ++i) {
        for (const double number : {wide(random), narrow(random), std::floor(narrow(random))}) {
            const auto expected = static_cast<std::int32_t>(std::clamp(std::floor(number), -limit, limit));
            ASSERT_EQ(floor_within(number, limit), expected) << number;
        }
    }
}

}  // namespace
}  // namespace oro
