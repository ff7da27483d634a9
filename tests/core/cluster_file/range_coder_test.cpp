// Numbers, places and triangles through the coder and back.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "core/cluster_file/mesh_code.h"
#include "core/cluster_file/number_code.h"
#include "core/cluster_file/point_code.h"
#include "core/cluster_file/range_coder.h"

namespace oro {
namespace {

// What is written: bits of a likelihood, or numbers below a count.
struct Step {
    std::uint32_t count;  // 0: a bit
    std::uint32_t value;
};

std::vector<Step> random_steps(std::mt19937_64& random, int count) {
    std::vector<Step> steps;
    const std::uint64_t share = 1 + random() % 99;
    for (int i = 0; i < count; ++i) {
        if (random() % 3 != 0) {
            steps.push_back({0, random() % 100 < share ? 1U : 0U});
            continue;
        }
        const auto most = static_cast<std::uint32_t>(1 + (random() >> (33 + random() % 31)));
        steps.push_back({most, static_cast<std::uint32_t>(random() % most)});
    }
    return steps;
}

TEST(RangeCoder, GivesBackWhatWasWritten) {
    std::mt19937_64 random(1);
    for (int turn = 0; turn < 400; ++turn) {
        const auto steps = random_steps(random, 1 + static_cast<int>(random() % 600));
        RangeEncoder encoder;
        AdaptiveBit write;
        for (const Step& step : steps)
            step.count == 0 ? (void)encoder.bit(write, step.value != 0)
                            : (void)encoder.uniform(step.count, step.value);
        const auto bytes = encoder.finish();
        RangeDecoder decoder(bytes);
        AdaptiveBit read;
        for (const Step& step : steps) {
            const std::uint32_t found =
                step.count == 0 ? (decoder.bit(read) ? 1U : 0U) : decoder.uniform(step.count);
            ASSERT_EQ(found, step.value) << turn;
        }
        EXPECT_TRUE(decoder.at_end());
        EXPECT_FALSE(decoder.is_wrong());
    }
}

// A carry through many bytes: numbers that keep the coder at the end of its range.
TEST(RangeCoder, CarriesThroughManyBytes) {
    for (int ones = 0; ones < 60; ++ones) {
        RangeEncoder encoder;
        for (int i = 0; i < ones; ++i) encoder.uniform(256, 255);
        encoder.uniform(3, 2);
        for (int i = 0; i < 4; ++i) encoder.uniform(65535, 65534);
        const auto bytes = encoder.finish();
        RangeDecoder decoder(bytes);
        for (int i = 0; i < ones; ++i) ASSERT_EQ(decoder.uniform(256), 255U);
        ASSERT_EQ(decoder.uniform(3), 2U);
        for (int i = 0; i < 4; ++i) ASSERT_EQ(decoder.uniform(65535), 65534U);
        EXPECT_TRUE(decoder.at_end());
    }
}

// 10,000 bits of which 1 in 50 is set have 1,414 bits of entropy: 177 bytes.
TEST(RangeCoder, LikelyBitsTakeLittle) {
    std::mt19937_64 random(2);
    RangeEncoder encoder;
    AdaptiveBit likely;
    for (int i = 0; i < 10000; ++i) encoder.bit(likely, random() % 50 == 0);
    const std::size_t bytes = encoder.finish().size();
    EXPECT_GT(bytes, 150U);
    EXPECT_LT(bytes, 205U);
}

TEST(RangeCoder, TellsBytesThatEndTooSoon) {
    RangeEncoder encoder;
    for (std::uint32_t i = 0; i < 100; ++i) encoder.uniform(1000, 7 * i);
    auto bytes = encoder.finish();
    bytes.resize(bytes.size() - 3);
    RangeDecoder decoder(bytes);
    for (int i = 0; i < 100; ++i) EXPECT_LT(decoder.uniform(1000), 1000U);
    EXPECT_TRUE(decoder.is_wrong());
}

TEST(NumberCode, NumbersOfAllSizes) {
    std::vector<std::int32_t> numbers = {
        0, 1, -1, 2, -2, std::numeric_limits<std::int32_t>::max(), std::numeric_limits<std::int32_t>::min()};
    std::mt19937_64 random(3);
    for (int i = 0; i < 2000; ++i) numbers.push_back(static_cast<std::int32_t>(random()) >> (random() % 32));
    RangeEncoder encoder;
    NearZero near;
    SmallNumber small;
    for (const std::int32_t number : numbers) {
        near.code(encoder, number);
        small.code(encoder, static_cast<std::uint32_t>(number));
    }
    const auto bytes = encoder.finish();
    RangeDecoder decoder(bytes);
    NearZero near_read;
    SmallNumber small_read;
    for (const std::int32_t number : numbers) {
        ASSERT_EQ(near_read.code(decoder), number);
        ASSERT_EQ(small_read.code(decoder), static_cast<std::uint32_t>(number));
    }
    EXPECT_TRUE(decoder.at_end());
}

std::vector<GridPosition> random_points(std::mt19937_64& random, std::int32_t rows, std::int32_t columns,
                                        std::size_t count) {
    std::vector<GridPosition> points;
    while (points.size() < count) {
        const GridPosition point{static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(rows)),
                                 static_cast<std::int32_t>(random() % static_cast<std::uint64_t>(columns))};
        if (std::find(points.begin(), points.end(), point) == points.end()) points.push_back(point);
    }
    std::sort(points.begin(), points.end());
    return points;
}

// From a single post to the largest lattice, and from one place to all of them.
TEST(PointCode, PlacesOfAnyLattice) {
    std::mt19937_64 random(4);
    constexpr std::int32_t largest = std::numeric_limits<std::int32_t>::max();
    for (const auto& [rows, columns] : {std::pair{1, 1},
                                        {1, 128},
                                        {128, 1},
                                        {9, 9},
                                        {24, 13},
                                        {1201, 900},
                                        {largest, largest},
                                        {largest, 1}}) {
        const auto places = static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
        for (std::uint64_t count = 1; count <= std::min<std::uint64_t>(128, places); ++count) {
            auto points = random_points(random, rows, columns, count);
            RangeEncoder encoder;
            PointCode write, read;
            write.code(encoder, rows, columns, static_cast<std::uint32_t>(count), points);
            const auto bytes = encoder.finish();
            RangeDecoder decoder(bytes);
            std::vector<GridPosition> found;
            read.code(decoder, rows, columns, static_cast<std::uint32_t>(count), found);
            ASSERT_EQ(found, points) << rows << " x " << columns << ", " << count;
            ASSERT_TRUE(decoder.at_end() && !decoder.is_wrong());
        }
    }
}

}  // namespace
}  // namespace oro
