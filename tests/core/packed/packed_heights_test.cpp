// Packed heights: any heights come back to the bit, and those of whole units take few bits.
#include "core/packed/packed_heights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include "core/terrain/page.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr std::size_t side = 131;
using Heights = std::array<std::int32_t, gpu::page_heights>;

Heights heights_of(const std::function<std::int32_t(int row, int column)>& height) {
    Heights heights{};
    for (std::size_t row = 0; row < side; ++row)
        for (std::size_t column = 0; column < side; ++column)
            heights[row * side + column] = height(static_cast<int>(row), static_cast<int>(column));
    return heights;
}

// Packs, expects every height back, and tells the bytes for each of a page's 128 x 128 posts.
double expect_back(const Heights& heights, double exaggeration = 1.0) {
    const std::vector<std::uint32_t> packed = packed_heights(heights, exaggeration);
    EXPECT_LE(packed.size(), packed_words_max);
    std::size_t different = 0;
    for (std::size_t row = 0; row < side; ++row)
        for (std::size_t column = 0; column < side; ++column)
            different += unpacked_height(packed, row, column) != heights[row * side + column] ? 1U : 0U;
    EXPECT_EQ(different, 0U);
    return 4.0 * static_cast<double>(packed.size()) / (128.0 * 128.0);
}

// Whole units over an undulation that slopes; 1 post in `voids` is void (0: none).
Heights whole_units(double unit_m, double relief_m, double exaggeration, unsigned voids, unsigned seed) {
    std::mt19937 random(seed);
    return heights_of([&](int row, int column) {
        if (voids != 0 && random() % voids == 0) return void_height_steps;
        const double H_m = 700.0 + relief_m * std::sin(0.11 * row) * std::cos(0.07 * column) +
                           0.02 * relief_m * static_cast<double>(random() % 1000) / 1000.0;
        const double N_m = 47.3 + 0.0013 * row - 0.0021 * column + 1e-6 * row * column;
        return height_steps(std::round(H_m / unit_m) * unit_m * exaggeration + N_m);
    });
}

TEST(PackedHeights, OfOneHeightAreBlocksAlone) {
    // The unit, four words for each of 17 x 17 blocks, and a word behind: 0.28 bytes a post.
    const Heights level = heights_of([](int, int) { return 123456; });
    EXPECT_EQ(packed_heights(level, 1.0).size(), 1U + 4U * 289U + 1U);
    expect_back(level);
    const Heights nothing = heights_of([](int, int) { return void_height_steps; });
    EXPECT_EQ(packed_heights(nothing, 1.0).size(), 1U + 4U * 289U + 1U);
    expect_back(nothing);
}

TEST(PackedHeights, AreWholeMetresOverAnUndulation) {
    // A metre is 2048 steps. 100 m of relief, 2 m of roughness: 5 bits of metres and 1 or 2 of steps.
    EXPECT_LT(expect_back(whole_units(1.0, 100.0, 1.0, 0, 1)), 1.1);
    EXPECT_LT(expect_back(whole_units(1.0, 0.0, 1.0, 0, 2)), 0.5);  // level: the undulation alone
    EXPECT_LT(expect_back(whole_units(1.0, 100.0, 1.0, 100, 3)), 1.2);
    EXPECT_LT(expect_back(whole_units(1.0, 100.0, 2.5, 0, 4), 2.5), 1.1);
    EXPECT_LT(expect_back(whole_units(1.0, 100.0, 0.37, 0, 5), 0.37), 1.2);
    EXPECT_LT(expect_back(whole_units(0.3048, 100.0, 1.0, 0, 6)), 1.4);           // feet
    EXPECT_LT(expect_back(whole_units(1200.0 / 3937.0, 100.0, 1.0, 0, 7)), 1.4);  // US survey feet
    EXPECT_LT(expect_back(whole_units(0.1, 100.0, 1.0, 0, 8)), 1.7);
    // Of no unit: some 15 bits.
    EXPECT_LT(expect_back(whole_units(1.0e-6, 100.0, 1.0, 0, 9)), 2.4);
    EXPECT_GT(expect_back(whole_units(1.0e-6, 100.0, 1.0, 0, 9)), 1.5);
}

TEST(PackedHeights, ComeBackWhateverTheyAre) {
    constexpr std::int32_t highest = highest_height_steps;
    std::mt19937_64 random(74);
    for (int i = 0; i < 200; ++i) {
        const std::int64_t range = std::int64_t{1} << random() % 32;
        const unsigned voids = random() % 3 == 0 ? 0 : 1 + static_cast<unsigned>(random() % 60);
        const std::int64_t from = static_cast<std::int64_t>(random() % (2U * highest)) - highest;
        const auto any = [&](int, int) {
            if (voids != 0 && random() % voids == 0) return void_height_steps;
            return static_cast<std::int32_t>(std::min<std::int64_t>(
                highest, from + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(range))));
        };
        expect_back(heights_of(any), i % 2 ? 1.0 : 0.01 + static_cast<double>(random() % 10000));
    }
    // All that heights may be, side by side, both ends in each block: 32 bits a post, and none is taken for a
    // void.
    const double bytes = expect_back(heights_of([&](int row, int column) {
        if (row % 8 == 0 && column % 8 < 3)
            return column % 8 == 0 ? -highest : column % 8 == 1 ? highest : void_height_steps;
        return static_cast<std::int32_t>(random() % (2U * highest)) - highest;
    }));
    EXPECT_GT(bytes, 4.1);
    EXPECT_LE(bytes, 4.0 * packed_words_max / (128.0 * 128.0));
    // Walls between them, and single posts: slopes as steep as there are none.
    expect_back(heights_of([&](int row, int column) {
        return (row + column) % 2 ? highest : row % 3 ? -highest : column % 5 ? 0 : void_height_steps;
    }));
    expect_back(heights_of([&](int row, int) { return row % 8 < 4 ? -highest : highest; }));
    expect_back(heights_of([&](int row, int column) { return row * column == 4900 ? highest : -highest; }));
    expect_back(heights_of([&](int row, int) { return -highest + row * (highest / 66); }));
    expect_back(heights_of([&](int row, int column) {
        return row % 8 == 3 && column % 8 == 5 ? static_cast<std::int32_t>(row * 100000) : void_height_steps;
    }));
}

TEST(PackedHeights, OfAllLevelsOfARegionComeBack) {
    HeightField field = test::rough_field(46.9, 8.1, 600, 500);
    for (float& H_m : field.H_m) H_m = std::round(H_m);
    for (std::size_t i = 0; i < field.H_m.size(); i += 977) field.H_m[i] = void_height_m;
    for (const double exaggeration : {1.0, 3.7}) {
        for (int level = 0; level < level_count(field.grid); ++level) {
            const PageLayout layout = level_grid(field.grid, level).pages();
            for (int row = 0; row < layout.rows; ++row)
                for (int column = 0; column < layout.columns; ++column) {
                    const PageIndex page{row, column, level};
                    expect_back(page_heights(field.grid, field.undulation, exaggeration,
                                             page_elevations(field, page), page)
                                    .steps,
                                exaggeration);
                }
        }
    }
}

}  // namespace
}  // namespace oro
