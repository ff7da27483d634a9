// Ground between posts: the posts stay, water stays level, and the ground is as rough as ground is.
#include "core/refined/refined_posts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/terrain/cell_diagonal.h"
#include "core/terrain/triangle_heights.h"
#include "tests/support/made_posts.h"
#include "tests/support/net_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {
namespace {

// Heights as a survey has them, in centimetres, of a seed.
HeightField random_field(unsigned seed, int rows, int columns) {
    HeightField field = rough_field(46.5, 8.25, rows, columns);
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> off_cm(-1500, 1500);
    for (float& H_m : field.H_m) H_m = std::round(100.0F * H_m + static_cast<float>(off_cm(random))) / 100.0F;
    return field;
}

RefinedPosts refined(const HeightField& field, const GridPart& part, int halvings) {
    const auto made = refined_posts(field, part, halvings, level_posts(field, part));
    EXPECT_TRUE(made.ok()) << made.error().line();
    return *made;
}

TEST(RefinedPosts, KeepHeightAndPlaceOfTheDataToTheBit) {
    const unsigned seed = std::random_device()();
    std::printf("seed %u\n", seed);
    HeightField field = random_field(seed, 50, 61);
    field.H_m[20 * 61 + 30] = void_height_m;
    for (int halvings = 1; halvings <= 4; ++halvings) {
        const GridPart part{3, 40, 7, 50};
        const RefinedPosts made = refined(field, part, halvings);
        ASSERT_EQ(made.field.grid.rows(), (39 << halvings) + 1);
        ASSERT_EQ(made.field.grid.columns(), (49 << halvings) + 1);
        for (int row = 0; row < part.rows; ++row)
            for (int column = 0; column < part.columns; ++column) {
                const int down = row << halvings, right = column << halvings;
                ASSERT_EQ(made.field.H_at_post_m(down, right),
                          field.H_at_post_m(part.first_row + row, part.first_column + column));
                ASSERT_EQ(made.field.grid.lat.at_deg(down), field.grid.lat.at_deg(part.first_row + row));
                ASSERT_EQ(made.field.grid.lon.at_deg(right),
                          field.grid.lon.at_deg(part.first_column + column));
            }
        EXPECT_GT(made.rms_m, 1.0);
        EXPECT_GT(made.largest_m, made.rms_m);
    }
}

TEST(RefinedPosts, OfANetKeepHeightAndPlaceToTheBit) {
    const HeightField field = net_field({40, 50, {46.5, 8.25}, 25.0, 17.0},
                                        [](double row, double column) { return patchy_H_m(row, column); });
    const GridPart part{5, 30, 8, 40};
    const RefinedPosts made = refined(field, part, 2);
    for (int row = 0; row < part.rows; ++row)
        for (int column = 0; column < part.columns; ++column) {
            ASSERT_EQ(made.field.H_at_post_m(4 * row, 4 * column), field.H_at_post_m(5 + row, 8 + column));
            ASSERT_EQ(made.field.grid.net->normal_at(4 * row, 4 * column),
                      field.grid.net->normal_at(5 + row, 8 + column));
        }
    // Half way between posts, to 10 um.
    const glm::dvec3 between = made.field.grid.net->normal_at(6.0, 10.0),
                     there = field.grid.net->normal_at(6.5, 10.5);
    EXPECT_LT(glm::length(between - there), 1.0e-5 / 6.4e6);
}

TEST(RefinedPosts, OfCorrectedNetsAreRefused) {
    HeightField field;
    const KinkedPlane kinked{{260, 260, {46.5, 8.25}, 25.0, 0.0}};
    field.grid = grid_on_net(kinked_net_of(kinked));
    field.H_m.assign(field.grid.post_count(), 5.0F);
    const auto made = refined_posts(field, {0, 20, 0, 20}, 1, {});
    ASSERT_FALSE(made.ok());
    EXPECT_NE(made.error().line().find("grid of shifts"), std::string::npos);
}

// A lake of 12 x 15 posts in rough ground: between its posts it has its level, to the bit.
TEST(RefinedPosts, WaterStaysLevel) {
    HeightField field = random_field(4, 50, 50);
    for (int row = 20; row < 32; ++row)
        for (int column = 15; column < 30; ++column)
            field.H_m[static_cast<std::size_t>(row * 50 + column)] = 431.0F;
    const RefinedPosts made = refined(field, {0, 50, 0, 50}, 3);
    for (int row = 20 * 8; row <= 31 * 8; ++row)
        for (int column = 15 * 8; column <= 29 * 8; ++column)
            ASSERT_EQ(made.field.H_at_post_m(row, column), 431.0F) << row << " " << column;
    EXPECT_NE(made.field.H_at_post_m(40 * 8 + 3, 20 * 8 + 4), 431.0F);
}

// On the rim there is no step to the ground beside: posts lie on the straight way between those of the data.
TEST(RefinedPosts, OnTheRimLieOnTheDatasSurface) {
    const HeightField field = random_field(5, 50, 50);
    const RefinedPosts made = refined(field, {10, 30, 10, 30}, 2);
    const int last = 29 * 4;
    for (int along = 0; along <= last; ++along) {
        const int post = std::min(along / 4, 28);
        const double share = along / 4.0 - post;
        const auto straight = [&](int row, int column, int down, int right) {
            return (1.0 - share) * double{field.H_at_post_m(row, column)} +
                   share * double{field.H_at_post_m(row + down, column + right)};
        };
        EXPECT_NEAR(made.field.H_at_post_m(0, along), straight(10, 10 + post, 0, 1), 2.0e-4);
        EXPECT_NEAR(made.field.H_at_post_m(last, along), straight(39, 10 + post, 0, 1), 2.0e-4);
        EXPECT_NEAR(made.field.H_at_post_m(along, 0), straight(10 + post, 10, 1, 0), 2.0e-4);
        EXPECT_NEAR(made.field.H_at_post_m(along, last), straight(10 + post, 39, 1, 0), 2.0e-4);
    }
}

// Across the rim the ground is as steep as the data are shaded: by the posts on both sides. A kink there is
// an edge in the light. The slope of the made ground is that of a parabola through its first three posts.
TEST(RefinedPosts, OnTheRimAreAsSteepAcrossAsTheDataAreShaded) {
    const HeightField field = random_field(9, 50, 50);
    const GridPart part{10, 30, 10, 30};
    constexpr int halvings = 5, along = 1 << halvings, last = 29 * along;
    const RefinedPosts made = refined(field, part, halvings);
    const auto made_m = [&](int row, int column) { return double{made.field.H_at_post_m(row, column)}; };
    const auto into = [&](auto&& post_m) {
        return along * (4.0 * post_m(1) - 3.0 * post_m(0) - post_m(2)) / 2.0;
    };
    double kinks_m = 0.0, most_m = 0.0;
    for (int post = 10; post < 40; ++post) {
        const int at = (post - 10) * along;
        const auto data_m = [&](int row, int column) { return double{field.H_at_post_m(row, column)}; };
        const double north_m = into([&](int i) { return made_m(i, at); }),
                     south_m = into([&](int i) { return made_m(last - i, at); }),
                     west_m = into([&](int i) { return made_m(at, i); }),
                     east_m = into([&](int i) { return made_m(at, last - i); });
        const bool near_corner = post < 13 || post > 36;
        for (const auto& [made_slope_m, before_m, after_m] :
             {std::array{north_m, data_m(9, post), data_m(11, post)},
              {south_m, data_m(40, post), data_m(38, post)},
              {west_m, data_m(post, 9), data_m(post, 11)},
              {east_m, data_m(post, 40), data_m(post, 38)}}) {
            if (near_corner) continue;  // the other rim is straight there
            most_m = std::max(most_m, std::abs(made_slope_m - 0.5 * (after_m - before_m)));
            kinks_m = std::max(kinks_m, std::abs(after_m - before_m) / 2.0);
        }
    }
    std::printf("up to %.3f m a post off, of slopes of up to %.1f m\n", most_m, kinks_m);
    EXPECT_GT(kinks_m, 10.0);
    EXPECT_LT(most_m, 0.4);  // metres a post
}

TEST(RefinedPosts, OfTwoPartsAreTheSameWhereBothAreFarFromTheirRims) {
    const HeightField field = random_field(6, 90, 120);
    const GridPart one{0, 90, 0, 90}, other{5, 80, 20, 100};
    const RefinedPosts a = refined(field, one, 2), b = refined(field, other, 2);
    int compared = 0;
    for (int row = 25 * 4; row <= 64 * 4; ++row)
        for (int column = 40 * 4; column <= 69 * 4; ++column, ++compared)
            ASSERT_EQ(a.field.H_at_post_m(row, column), b.field.H_at_post_m(row - 20, column - 80));
    EXPECT_GT(compared, 10000);
}

TEST(RefinedPosts, OfFewHalvingsAreAmongThoseOfMany) {
    const HeightField field = random_field(7, 40, 40);
    const RefinedPosts few = refined(field, {0, 40, 0, 40}, 1), many = refined(field, {0, 40, 0, 40}, 3);
    for (int row = 0; row < few.field.grid.rows(); ++row)
        for (int column = 0; column < few.field.grid.columns(); ++column)
            ASSERT_EQ(few.field.H_at_post_m(row, column), many.field.H_at_post_m(4 * row, 4 * column));
}

// Void posts stay so, and triangles have no posts where one of their corners is void.
TEST(RefinedPosts, HaveHolesWhereTheDataHave) {
    HeightField field = random_field(8, 30, 30);
    field.H_m[15 * 30 + 15] = void_height_m;
    const RefinedPosts made = refined(field, {0, 30, 0, 30}, 2);
    for (int row = 0; row <= 29 * 4; ++row)
        for (int column = 0; column <= 29 * 4; ++column) {
            const auto diagonal_at = [&](int r, int c) { return cell_diagonal(field, r, c); };
            const auto post_m = [&](int r, int c) -> std::optional<double> {
                const float H_m = field.H_at_post_m(r, c);
                return is_void(H_m) ? std::nullopt : std::optional(double{H_m});
            };
            const auto there = h_at_row_column_m(field.grid, post_m, diagonal_at, row / 4.0, column / 4.0);
            ASSERT_EQ(there.has_value(), !is_void(made.field.H_at_post_m(row, column)));
        }
}

// Made ground of 1 second, of which every second and every fourth post is the data: what lies half way
// between posts is as far from the straight way as the truth, in windows of 32 x 32 posts. The bar is 0.8
// to 1.25 in 80 % of windows.
TEST(RefinedPosts, AreAsRoughAsTheTruthOfMadeGround) {
    MadeTerrain terrain = made_example(MadeKind::fbm);
    constexpr int side = 600;
    terrain.east = terrain.west + side - 1;
    terrain.north = terrain.south + side - 1;
    terrain.octaves = 13;  // the last has cells of 5 m: rough between posts, too
    const std::vector<std::int32_t> steps = heights_of(terrain, made_rule(terrain));
    const auto truth_m = [&](int row, int column) {
        return steps[static_cast<std::size_t>(row) * side + static_cast<std::size_t>(column)] * made_step_m;
    };
    for (const int every : {2, 4}) {
        const int posts = side / every;
        const HeightField data =
            made_field(46.0 + (side - 1) / 3600.0, 8.0, 3600.0 / every, posts, posts, rough_H_m);
        HeightField field = data;
        for (int row = 0; row < posts; ++row)
            for (int column = 0; column < posts; ++column)
                field.H_m[static_cast<std::size_t>(row * posts + column)] =
                    static_cast<float>(truth_m(row * every, column * every));
        const RefinedPosts made = refined(field, {0, posts, 0, posts}, 1);
        int good = 0, windows = 0;
        for (const bool along_row : {false, true})
            for (int top = 8; top + 33 < posts - 8; top += 32)
                for (int left = 8; left + 33 < posts - 8; left += 32) {
                    double made_m2 = 0.0, true_m2 = 0.0;
                    for (int row = top; row < top + 32; ++row)
                        for (int column = left; column < left + 32; ++column) {
                            const int down = along_row ? 0 : 1, right = along_row ? 1 : 0;
                            const double straight =
                                0.5 * (double{field.H_at_post_m(row, column)} +
                                       double{field.H_at_post_m(row + down, column + right)});
                            made_m2 += std::pow(
                                made.field.H_at_post_m(2 * row + down, 2 * column + right) - straight, 2);
                            true_m2 += std::pow(
                                truth_m(every * row + down * every / 2, every * column + right * every / 2) -
                                    straight,
                                2);
                        }
                    const double ratio = std::sqrt(made_m2 / true_m2);
                    ++windows;
                    good += ratio >= 0.8 && ratio <= 1.25 ? 1 : 0;
                }
        std::printf("every %d: %d of %d windows within 0.8 to 1.25\n", every, good, windows);
        EXPECT_GE(good, 0.8 * windows) << every;
    }
}

}  // namespace
}  // namespace oro::test
