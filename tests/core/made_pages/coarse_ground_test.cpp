// Must hold: no post of made terrain lies beyond the heights that are told of its part of the ground; rows of
// posts are the posts; and so lines of sight meet the surface where they meet that of the same posts in
// memory.
#include "core/made_pages/coarse_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <random>
#include <vector>

#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"
#include "tests/core/made_pages/made_ground.h"

namespace oro {
namespace {

class CoarseGroundOf : public ::testing::TestWithParam<MadeKind> {};

TEST_P(CoarseGroundOf, NoPostIsBeyondTheRangeOfItsPage) {
    const HeightField field = made_ground(GetParam());
    const MadePostSource& posts = *made_posts_of(field);
    const MadeTerrain terrain = made_terrain_of_tests(GetParam());
    const MadeRegion region = made_region(terrain, grid_of(terrain), {});
    const CoarseGround coarse(region);
    std::mt19937 random(53);
    double nearest_m = 1.0e9;
    for (int i = 0; i < 40; ++i) {
        // The last ones end with the region.
        const int row = static_cast<int>(random() % 16), column = static_cast<int>(random() % 16);
        const auto range = posts.range_of_page(row, column);
        ASSERT_TRUE(range);
        std::array<double, 4> highest_m{-1.0e9, -1.0e9, -1.0e9, -1.0e9};
        std::vector<float> H_m(static_cast<std::size_t>(std::min(129, 2048 - 128 * column)));
        for (int r = 128 * row; r <= std::min(128 * row + 128, 2047); ++r) {
            posts.row_H_m(r, 128 * column, H_m);
            const auto [low, high] = std::ranges::minmax(H_m);
            ASSERT_GE(static_cast<double>(low), range->lowest_H_m);
            ASSERT_LE(static_cast<double>(high), range->highest_H_m);
            nearest_m = std::min(nearest_m, range->highest_H_m - static_cast<double>(high));
            for (std::size_t c = 0; c < H_m.size(); ++c)
                for (const int down : {0, 1})
                    for (const int right : {0, 1})
                        if ((down == 0 ? r <= 128 * row + 64 : r >= 128 * row + 64) &&
                            (right == 0 ? c <= 64 : c >= 64)) {
                            double& highest = highest_m[static_cast<std::size_t>(2 * down + right)];
                            highest = std::max(highest, static_cast<double>(H_m[c]));
                        }
        }
        for (int node = 0; node < 4; ++node)
            EXPECT_GE(static_cast<double>(coarse.highest_m(3, 2 * row + node / 2, 2 * column + node % 2)),
                      highest_m[static_cast<std::size_t>(node)]);
    }
    std::printf("a post comes as near to the highest H of its page as %.0f m\n", nearest_m);
    // A bound that is nowhere near would hold, and be of no use: amplitudes of what it leaves out are 240 m;
    // between posts crests rise by their slope.
    EXPECT_LT(nearest_m, GetParam() == MadeKind::fbm ? 300.0 : 900.0);
}
INSTANTIATE_TEST_SUITE_P(Made, CoarseGroundOf, ::testing::Values(MadeKind::fbm, MadeKind::ridged));

TEST(CoarseGround, RowsAreTheirPosts) {
    const HeightField field = made_ground();
    for (const int row : {0, 777, 2047})
        for (const int column : {0, 1, 126, 1900}) {
            std::vector<float> H_m(131);
            made_posts_of(field)->row_H_m(row, column, H_m);
            for (std::size_t i = 0; i < H_m.size(); ++i)
                ASSERT_EQ(H_m[i], field.posts->H_m(row, column + static_cast<int>(i)));
        }
}

TEST(CoarseGround, LinesOfSightMeetTheSurfaceOfTheSamePostsInMemory) {
    const HeightField made = made_ground();
    HeightField memory;
    memory.grid = made.grid;
    memory.H_m.resize(made.grid.post_count());
    for (int row = 0; row < made.grid.rows(); ++row)
        made.posts->row_H_m(row, 0,
                            std::span(memory.H_m).subspan(static_cast<std::size_t>(row) * 2048, 2048));
    const TrueSurface of_made(made, 1.0, 1), of_memory(memory, 1.0, 2);
    const TrueGround made_surface(of_made), memory_surface(of_memory);
    const Geodetic eye{46.8, 8.9, 4500.0};
    const Oracle found(made_surface, sight_from(eye)), expected(memory_surface, sight_from(eye));
    std::mt19937 random(53);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    int hits = 0;
    for (int line = 0; line < 2000; ++line) {
        Camera camera;
        camera.eye = eye;
        camera.attitude = {.heading_deg = 360.0 * share(random), .pitch_deg = -12.0 * share(random)};
        const glm::dvec3 direction = camera.ecef_direction_at({0.5, 0.5});
        const auto one = found.first_hit(direction, 1.0e6), other = expected.first_hit(direction, 1.0e6);
        ASSERT_EQ(one.has_value(), other.has_value());
        if (!one) continue;
        ++hits;
        ASSERT_EQ(one->row, other->row);
        ASSERT_EQ(one->column, other->column);
        ASSERT_NEAR(one->distance_m, other->distance_m, 1.0e-6);
    }
    EXPECT_GT(hits, 1500);
}

}  // namespace
}  // namespace oro
