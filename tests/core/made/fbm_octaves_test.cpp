// Must hold: octaves by eight or sixteen numbers at once have the bits of the rule that the shaders have,
// wherever on the Earth, and so have rows of posts.
#include "core/made/fbm_octaves.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <random>
#include <vector>

#include "core/made/made_heights.h"

namespace oro::gpu {
namespace {

std::int32_t made_high(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>((static_cast<std::int64_t>(a) * b) >> 32);
}
std::uint32_t made_high(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(a) * b) >> 32U);
}

#define ORO_FUNCTION [[maybe_unused]] inline
#define ORO_MADE_CONST inline constexpr
#define ORO_INOUT(type) type&
#define ORO_RULE const MadeRule &rule,
#define ORO_PASS rule,
#include "shaders/made/made_heights.glsl"
#undef ORO_PASS
#undef ORO_RULE
#undef ORO_INOUT
#undef ORO_MADE_CONST
#undef ORO_FUNCTION

}  // namespace
}  // namespace oro::gpu

namespace oro {
namespace {

constexpr std::uint32_t fbm_seed = 20261129;
constexpr std::size_t places_count = 4096;

struct Places {
    std::vector<std::int32_t> x, y, z;
};
// Posts a second apart: poles, both sides of 180 degrees, and random ones; then any whole numbers at all.
Places some_places() {
    std::mt19937 random(fbm_seed);
    std::uniform_int_distribution<std::int64_t> lat(-90 * 3600, 90 * 3600), lon(-180 * 3600, 180 * 3600);
    std::uniform_int_distribution<std::int32_t> any(std::numeric_limits<std::int32_t>::min());
    Places places;
    for (std::size_t i = 0; i < places_count; ++i) {
        const std::int64_t row = i < 64 ? (i % 2 == 0 ? 90 : -90) * 3600 : lat(random);
        const std::int64_t column =
            i % 64 < 8 ? (i % 2 == 0 ? -180 : 180) * 3600 + static_cast<int>(i % 3) - 1 : lon(random);
        const MadeRow placed = made_row(row, 3600);
        const MadeColumn turned = made_column(column, 3600);
        const bool is_post = i < places_count / 2;
        places.x.push_back(is_post ? gpu::made_place(placed.from_axis, turned.cosine) : any(random));
        places.y.push_back(is_post ? gpu::made_place(placed.from_axis, turned.sine) : any(random));
        places.z.push_back(is_post ? placed.north : any(random));
    }
    return places;
}

std::size_t unequal(AddOctave by_lanes) {
    const Places places = some_places();
    std::mt19937 random(fbm_seed + 1);
    std::size_t wrong = 0;
    for (std::uint32_t number = 0; number < 24; ++number) {
        gpu::MadeOctave octave = made_octave(static_cast<std::uint32_t>(random()), number, 28 - number);
        octave.amplitude = static_cast<std::int32_t>(random() >> 1U);
        std::vector<std::int32_t> sums(places_count), expected(places_count);
        for (std::size_t i = 0; i < places_count; ++i) {
            sums[i] = static_cast<std::int32_t>(random() >> 4U);
            expected[i] = sums[i] + gpu::made_fbm_octave(octave, places.x[i], places.y[i], places.z[i]);
        }
        by_lanes(octave, places.x.data(), places.y.data(), places.z.data(), sums.data(), places_count);
        for (std::size_t i = 0; i < places_count; ++i) wrong += sums[i] == expected[i] ? 0 : 1;
    }
    return wrong;
}

std::size_t unequal_ridged(AddRidgedOctave by_lanes) {
    const Places places = some_places();
    std::mt19937 random(fbm_seed + 2);
    std::size_t wrong = 0;
    std::vector<std::int32_t> weights(places_count, 1 << 28), expected_weights = weights;
    for (std::uint32_t number = 0; number < 24; ++number) {
        gpu::MadeOctave octave = made_octave(static_cast<std::uint32_t>(random()), number, 28 - number);
        octave.amplitude = static_cast<std::int32_t>(random() >> 3U);
        std::vector<std::int32_t> sums(places_count), expected(places_count);
        for (std::size_t i = 0; i < places_count; ++i) {
            sums[i] = static_cast<std::int32_t>(random() >> 4U);
            expected[i] = sums[i] + gpu::made_ridged_octave(octave, places.x[i], places.y[i], places.z[i],
                                                            expected_weights[i]);
        }
        by_lanes(octave, places.x.data(), places.y.data(), places.z.data(), sums.data(), weights.data(),
                 places_count);
        for (std::size_t i = 0; i < places_count; ++i)
            wrong += sums[i] == expected[i] && weights[i] == expected_weights[i] ? 0 : 1;
    }
    return wrong;
}

TEST(RidgedOctaves, ByLanesHaveTheBitsOfTheRule) {
    if (ridged_octaves_by_eight() == nullptr) GTEST_SKIP() << "this processor has no AVX2";
    EXPECT_EQ(unequal_ridged(ridged_octaves_by_eight()), 0U) << "seed " << fbm_seed;
    if (ridged_octaves_by_sixteen() == nullptr) GTEST_SKIP() << "this processor has no AVX-512";
    EXPECT_EQ(unequal_ridged(ridged_octaves_by_sixteen()), 0U) << "seed " << fbm_seed;
}

TEST(FbmOctaves, ByEightHaveTheBitsOfTheRule) {
    if (octaves_by_eight() == nullptr) GTEST_SKIP() << "this processor has no AVX2";
    EXPECT_EQ(unequal(octaves_by_eight()), 0U) << "seed " << fbm_seed;
}

TEST(FbmOctaves, BySixteenHaveTheBitsOfTheRule) {
    if (octaves_by_sixteen() == nullptr) GTEST_SKIP() << "this processor has no AVX-512";
    EXPECT_EQ(unequal(octaves_by_sixteen()), 0U) << "seed " << fbm_seed;
}

// Rows at both poles, at the equator and anywhere, over 180 degrees.
TEST(FbmOctaves, RowsOfPostsHaveTheBitsOfTheRule) {
    MadeTerrain terrain;
    terrain.seed = 7;
    terrain.octaves = 12;
    terrain.low = -200 * 2048;
    terrain.high = 4000 * 2048;
    terrain.west = 179 * 3600;
    terrain.east = 181 * 3600;
    terrain.south = -90 * 3600;
    terrain.north = 90 * 3600;
    const gpu::MadeRule rule = made_rule(terrain);
    const std::vector<MadeColumn> columns = made_columns(terrain, 0, terrain.columns());
    std::vector<std::int32_t> steps(columns.size()), coarse(columns.size());
    std::mt19937 random(fbm_seed);
    std::size_t wrong = 0;
    for (int i = 0; i < 12; ++i) {
        const int row =
            std::array{0, terrain.rows() - 1, terrain.rows() / 2}[static_cast<std::size_t>(i % 3)];
        const int asked = i < 3 ? row : static_cast<int>(random() % static_cast<unsigned>(terrain.rows()));
        made_row_heights(terrain, rule, asked, 0, columns, steps);
        made_row_coarse_heights(terrain, rule, asked, columns, 12, steps, coarse);
        const MadeRow placed = made_row(terrain.north - asked, terrain.posts_per_deg);
        for (std::size_t j = 0; j < columns.size(); ++j)
            wrong += steps[j] == gpu::made_height(rule, gpu::made_place(placed.from_axis, columns[j].cosine),
                                                  gpu::made_place(placed.from_axis, columns[j].sine),
                                                  placed.north, 0)
                         ? 0
                         : 1;
    }
    EXPECT_EQ(wrong, 0U) << "seed " << fbm_seed;
}

}  // namespace
}  // namespace oro
