// Must hold: scans of rows by vector code say what a look at post by post says, over random rows.
#include "geo/sources/row_scans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "core/terrain/post_grid.h"
#include "geo/sources/source.h"

namespace oro {
namespace {

std::int16_t number(unsigned char high, unsigned char low) {
    return static_cast<std::int16_t>(high << 8 | low);
}

// The old rule: one post after the other, in double precision.
struct PlainRow {
    double lowest{std::numeric_limits<double>::infinity()};
    double highest{-std::numeric_limits<double>::infinity()};
    std::int64_t voids{}, implausible{};
    double pairs{}, steps_m{}, swapped_steps_m{};
    std::vector<float> height_m;
};

PlainRow plain_row(const std::vector<unsigned char>& bytes) {
    PlainRow row;
    for (std::size_t i = 0; i < bytes.size(); i += 2) {
        const std::int16_t value = number(bytes[i], bytes[i + 1]);
        const bool empty = value == -32768;
        const bool implausible = !empty && (value < lowest_plausible_m || value > highest_plausible_m);
        if (!empty) {
            row.lowest = std::min(row.lowest, static_cast<double>(value));
            row.highest = std::max(row.highest, static_cast<double>(value));
        }
        row.voids += empty;
        row.implausible += implausible;
        row.height_m.push_back(empty || implausible ? void_height_m : static_cast<float>(value));
        if (i == 0) continue;
        const double a = number(bytes[i - 2], bytes[i - 1]), b = value,
                     c = number(bytes[i - 1], bytes[i - 2]), d = number(bytes[i + 1], bytes[i]);
        if (a == -32768.0 || b == -32768.0 || c == -32768.0 || d == -32768.0) continue;
        ++row.pairs;
        row.steps_m += std::abs(a - b);
        row.swapped_steps_m += std::abs(c - d);
    }
    return row;
}

TEST(RowScans, DecodeHgtAsPostByPost) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    constexpr std::array<int, 11> odd{-32768, 32767, -12000, -12001, 9000, 9001, 128, 0, -1, -32767, 127};
    for (const std::size_t posts : {1U, 2U, 255U, 256U, 257U, 513U, 1201U, 3601U, 7201U}) {
        for (int kind = 0; kind < 4; ++kind) {
            std::vector<unsigned char> bytes;
            for (std::size_t i = 0; i < posts; ++i) {
                // Terrain, with odd numbers in it; noise; nothing but voids.
                int value = static_cast<int>(random() % 900U) + 100;
                if (kind == 1 && random() % 20U == 0) value = odd[random() % odd.size()];
                if (kind == 2) value = static_cast<int>(random() % 65536U) - 32768;
                if (kind == 3) value = -32768;
                bytes.push_back(static_cast<unsigned char>(static_cast<unsigned>(value) >> 8U & 255U));
                bytes.push_back(static_cast<unsigned char>(static_cast<unsigned>(value) & 255U));
            }
            const PlainRow plain = plain_row(bytes);
            std::vector<float> height_m(posts, 1.0F);
            const HgtRow row = decode_hgt_row(bytes, height_m);
            EXPECT_EQ(height_m, plain.height_m);
            EXPECT_EQ(row.voids, plain.voids);
            EXPECT_EQ(row.implausible, plain.implausible);
            EXPECT_EQ(row.lowest > row.highest, plain.lowest > plain.highest);
            if (plain.lowest <= plain.highest) {
                EXPECT_EQ(row.lowest, plain.lowest);
                EXPECT_EQ(row.highest, plain.highest);
            }
            EXPECT_EQ(static_cast<double>(row.pairs), plain.pairs);
            EXPECT_EQ(static_cast<double>(row.steps_m), plain.steps_m);
            EXPECT_EQ(static_cast<double>(row.swapped_steps_m), plain.swapped_steps_m);
        }
    }
}

std::vector<float> random_heights(std::mt19937& random, std::size_t posts, unsigned one_void_in) {
    std::normal_distribution<float> heights(800.0F, 40.0F);
    std::vector<float> row(posts);
    for (float& height_m : row) height_m = random() % one_void_in == 0 ? void_height_m : heights(random);
    return row;
}

TEST(RowScans, FindStepsAndEndsAsPostByPost) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::size_t found = 0, missed = 0;
    for (int turn = 0; turn < 3000; ++turn) {
        const std::size_t posts = 1 + random() % 700U;
        const std::vector<float> here = random_heights(random, posts,
                                                       1 + static_cast<unsigned>(random() % 900U)),
                                 there = random_heights(random, posts,
                                                        1 + static_cast<unsigned>(random() % 900U));
        const float least_m = static_cast<float>(random() % 300U), low = 660.0F, high = 940.0F;
        bool step = false, beyond = false, some = false, all = true;
        std::vector<unsigned char> marks(posts, 2), plain(posts, 2);
        for (std::size_t i = 0; i < posts; ++i) {
            const bool is_step =
                !is_void(here[i]) && !is_void(there[i]) && std::abs(here[i] - there[i]) >= least_m;
            plain[i] = static_cast<unsigned char>(2 + is_step);
            step |= is_step;
            beyond |= !is_void(here[i]) && (here[i] < low || here[i] > high);
            some |= is_void(here[i]);
            all &= is_void(here[i]);
        }
        mark_steps(here, there, least_m, marks);
        ASSERT_EQ(marks, plain) << turn;
        ASSERT_EQ(any_step(here, there, least_m), step) << turn;
        ASSERT_EQ(any_beyond(here, low, high), beyond) << turn;
        ASSERT_EQ(any_void(here), some) << turn;
        ASSERT_EQ(all_void(here), all) << turn;
        ++(step ? found : missed);
    }
    EXPECT_GT(found, 100U);
    EXPECT_GT(missed, 100U);
}

}  // namespace
}  // namespace oro
