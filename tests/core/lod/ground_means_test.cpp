// Means of the ground over squares of posts, against sums over all of their posts.
#include "core/lod/ground_means.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/packing.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <random>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/level_grid.h"
#include "tests/core/lod/old_ground_means.h"
#include "tests/support/made_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

struct Square {
    glm::dvec3 normal;
    double h_m;
    double spread_m;
    glm::dvec3 second;  // products of the normals' east and north, mean: xx, xy, yy
};

std::optional<Square> square_of(const gpu::PageMeans& means, int row, int column) {
    const auto at = static_cast<std::size_t>((row + static_cast<int>(gpu::means_apron)) *
                                                 static_cast<int>(gpu::means_stride) +
                                             column + static_cast<int>(gpu::means_apron));
    const std::uint32_t word = means.squares[at].normal;
    if (word == 0) return std::nullopt;
    const auto part = [&](unsigned shift) { return static_cast<std::int32_t>(word << (21U - shift)) >> 21; };
    const glm::vec2 height = glm::unpackHalf2x16(means.squares[at].height);
    const glm::dvec3 normal = glm::dvec3(part(0), part(11), static_cast<int>(word >> 22U)) / 1023.0;
    const std::uint32_t spread = means.squares[at].spread;
    const double x = (spread & 2047U) / 2047.0, y = (spread >> 11U & 2047U) / 2047.0;
    const double correlation = (static_cast<std::int32_t>(spread) >> 22) / 511.0;
    const glm::dvec3 second{normal.x * normal.x + x * x, normal.x * normal.y + x * y * correlation,
                            normal.y * normal.y + y * y};
    return Square{normal, static_cast<double>(height.x), static_cast<double>(height.y), second};
}

// Rises of 0.3 to the east and 0.2 to the north are that on each level, and heights are those of the middles.
TEST(GroundMeans, OfAPlaneIsThePlane) {
    constexpr double per_deg = 3600.0, lat_deg = 46.05;
    const double north_m = 6367449.0 * std::numbers::pi / 180.0 / per_deg;  // mean radius of the meridian
    const double east_m =
        6388837.0 * std::cos(lat_deg * std::numbers::pi / 180.0) * std::numbers::pi / 180.0 / per_deg;
    const HeightField field = test::made_field(46.1, 8.0, per_deg, 301, 301, [&](double lat, double lon) {
        return static_cast<float>(1000.0 + 0.3 * (lon - 8.0) * per_deg * east_m +
                                  0.2 * (lat - 46.1) * per_deg * north_m);
    });
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    const GroundMeans means(field.grid, heights, 1.0, 2);
    const double length = std::sqrt(1.0 + 0.3 * 0.3 + 0.2 * 0.2);
    const auto page = std::make_unique<gpu::PageMeans>();
    for (int level = 0; level < 2; ++level) {
        means.page({0, 0, level}, *page);
        for (const int at : {-1, 40, 100}) {
            const auto square = square_of(*page, at, 60);
            ASSERT_EQ(square.has_value(), at >= 0);
            if (!square) continue;
            EXPECT_NEAR(square->normal.x, -0.3 / length,
                        0.003);  // the radii are for one latitude; steps of 0.001
            EXPECT_NEAR(square->normal.y, -0.2 / length, 0.003);
            EXPECT_NEAR(square->normal.z, 1.0 / length, 0.002);
            EXPECT_LE(glm::length(square->second - glm::dvec3(0.09, 0.06, 0.04) / (length * length)), 0.004);
            const double middle = std::ldexp(at + 0.5, level) - 0.5;
            const double H_m = static_cast<double>(field.H_at_post_m(0, 0)) +
                               0.3 * (std::ldexp(60.5, level) - 0.5) * east_m - 0.2 * middle * north_m;
            EXPECT_NEAR(square->h_m, H_m, 0.002 * std::abs(H_m) + 0.5);  // a half has 11 digits
        }
    }
}

// On rough ground with holes: each square is the mean of the four below it, by the posts that these have.
// Normals of single posts are sharper than those that squares are made of; heights are not.
TEST(GroundMeans, AreThoseOfAllPosts) {
    HeightField field = test::rough_field(46.9, 8.1, 300, 420);
    for (std::size_t i = 0; i < field.H_m.size(); i += 37) field.H_m[i] = void_height_m;
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    const GroundMeans means(field.grid, heights, 1.0, 2);
    const auto posts_in = [&](int row, int column, int level) {
        double posts = 0.0;
        for (int i = 0; i < 1 << (2 * level); ++i)
            posts +=
                field.H_m[static_cast<std::size_t>(((row << level) + (i >> level)) * 420 + (column << level) +
                                                   (i & ((1 << level) - 1)))] != void_height_m;
        return posts;
    };
    const auto finer = std::make_unique<gpu::PageMeans>(), page = std::make_unique<gpu::PageMeans>();
    for (const int level : {1, 2}) {
        means.page({0, 0, level - 1}, *finer);
        means.page({0, 0, level}, *page);
        for (int row = 0; row < 30; row += 7) {
            for (int column = 0; column < 30; column += 3) {
                Square sum{};
                double posts = 0.0;
                for (int i = 0; i < 4; ++i) {
                    const int at_row = 2 * row + i / 2, at_column = 2 * column + i % 2;
                    const auto part = square_of(*finer, at_row, at_column);
                    const double share = posts_in(at_row, at_column, level - 1);
                    ASSERT_EQ(part.has_value(), share > 0.0);
                    if (!part) continue;
                    sum.normal += share * part->normal;
                    sum.second += share * part->second;
                    sum.h_m += share * part->h_m;
                    posts += share;
                }
                const auto square = square_of(*page, row, column);
                ASSERT_EQ(square.has_value(), posts > 0.0);
                if (!square) continue;
                EXPECT_NEAR(square->h_m, sum.h_m / posts, 0.001 * std::abs(sum.h_m / posts) + 0.01);
                EXPECT_LE(glm::length(square->normal), 1.001);
                if (level == 1) continue;
                EXPECT_LE(glm::length(square->normal - sum.normal / posts), 0.002);  // steps of 0.001
                EXPECT_LE(glm::length(square->second - sum.second / posts), 0.004);
            }
        }
    }
}

// Rows by vector code, in bands of 128, against one post after the other: the same bits on every level. Sizes
// that end within a band and within squares, holes from single posts to half of all, and cliffs.
TEST(GroundMeans, AreBitByBitThoseOfPostsOneByOne) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const auto page = std::make_unique<gpu::PageMeans>();
    std::size_t compared = 0, empty = 0;
    for (const auto& [rows, columns, one_void_in] : {std::array{257, 131, 1000000}, std::array{301, 420, 40},
                                                     std::array{300, 290, 2}, std::array{400, 130, 7}}) {
        HeightField field = test::rough_field(46.9, 8.1, rows, columns);
        for (float& H_m : field.H_m) {
            if (random() % static_cast<unsigned>(one_void_in) == 0)
                H_m = void_height_m;
            else if (random() % 50U == 0)
                H_m += static_cast<float>(random() % 3000U);
            // Heights and spreads that halves have few digits for.
            if (one_void_in == 7 && H_m != void_height_m) H_m = 1.0e-5F * (H_m - 1500.0F);
        }
        const double exaggeration = one_void_in == 40 ? 1.7 : one_void_in == 7 ? 300.0 : 1.0;
        const DrawnHeights heights = drawn_heights(field, exaggeration, 1);
        const GroundMeans means(field.grid, heights, exaggeration, 3);
        const test::OldGroundMeans old(field.grid, heights, static_cast<float>(exaggeration));
        ASSERT_GT(level_count(field.grid), 1);
        for (int level = 0; level < level_count(field.grid); ++level) {
            means.page({0, 0, level}, *page);
            const int end_row = std::min(128, ((rows - 1) >> level) + 1),
                      end_column = std::min(128, ((columns - 1) >> level) + 1);
            for (int i = 0; i < end_row * end_column; ++i) {
                const int row = i / end_column, column = i % end_column;
                // Single posts are sharper.
                const gpu::MeansSquare expected = test::OldGroundMeans::packed(
                    level == 0 ? old.post(row, column, 0.0F) : old.sums(level, row, column));
                const gpu::MeansSquare& square = page->squares[static_cast<std::size_t>(
                    (row + static_cast<int>(gpu::means_apron)) * static_cast<int>(gpu::means_stride) +
                    column + static_cast<int>(gpu::means_apron))];
                ASSERT_EQ(square.normal, expected.normal) << level << ": " << row << ", " << column;
                ASSERT_EQ(square.height, expected.height) << level << ": " << row << ", " << column;
                ASSERT_EQ(square.spread, expected.spread) << level << ": " << row << ", " << column;
                ++compared;
                empty += expected.normal == 0;
            }
        }
    }
    EXPECT_GT(compared, 50000U);
    EXPECT_GT(empty, 10U);
}

// Squares of single posts and of 2 x 2 are made page by page: what is kept are those of 4 x 4 and larger.
TEST(GroundMeans, KeepNoSquaresOfFewPosts) {
    const HeightField field = test::rough_field(46.9, 8.1, 300, 420);
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    const GroundMeans means(field.grid, heights, 1.0, 2);
    std::size_t expected = 0;
    int rows = 75, columns = 105;  // of level 2
    for (int level = 2; level < level_count(field.grid); ++level) {
        expected += static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
        rows = (rows + 1) / 2;
        columns = (columns + 1) / 2;
    }
    ASSERT_GT(level_count(field.grid), 2);
    EXPECT_EQ(means.kept_squares(), expected);
    EXPECT_LT(means.kept_squares(), field.grid.post_count() / 11);
}

// Squares beyond a page's rim are those of the page beside it.
TEST(GroundMeans, PagesAgreeBesideEachOther) {
    const HeightField field = test::rough_field(46.9, 8.1, 300, 420);
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    const GroundMeans means(field.grid, heights, 1.0, 1);
    const auto west = std::make_unique<gpu::PageMeans>(), east = std::make_unique<gpu::PageMeans>();
    means.page({0, 0, 0}, *west);
    means.page({0, 1, 0}, *east);
    constexpr int stride = static_cast<int>(gpu::means_stride), quads = static_cast<int>(gpu::page_quads);
    for (int row = 0; row < stride; ++row) {
        for (int column = 0; column < stride - quads; ++column) {
            EXPECT_EQ(west->squares[row * stride + column + quads].normal,
                      east->squares[row * stride + column].normal);
            EXPECT_EQ(west->squares[row * stride + column + quads].height,
                      east->squares[row * stride + column].height);
            EXPECT_EQ(west->squares[row * stride + column + quads].spread,
                      east->squares[row * stride + column].spread);
        }
    }
}

}  // namespace
}  // namespace oro
