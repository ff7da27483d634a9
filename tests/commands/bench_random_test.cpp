// Random eyes of the benchmark: the same from one seed, over ground, from 2 m to 400 km above it; and what is
// told of their times.
#include "apps/bench/times/bench_random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/terrain/ground.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

TEST(RandomEyes, AreOverGroundAtAllHeightsAndHeadings) {
    HeightField field = test::rough_field(47.0, 8.0, 300, 400);
    for (std::size_t i = 0; i < field.H_m.size() / 2; ++i) field.H_m[i] = void_height_m;
    const auto pages = pages_in_memory(field, 1.0, 2);
    constexpr int count = 400;
    const auto eyes = random_eyes(*pages, count, 5, 640, 360);
    ASSERT_TRUE(eyes.ok()) << eyes.error().line();
    ASSERT_EQ(eyes->size(), static_cast<std::size_t>(count));
    int low = 0, high = 0, east = 0;
    for (const BenchEye& eye : *eyes) {
        const auto ground_m = ground_h_m(field, eye.camera.eye.lat_deg, eye.camera.eye.lon_deg);
        ASSERT_TRUE(ground_m) << eye.name;
        const double above_m = eye.camera.eye.h_m - *ground_m;
        EXPECT_GT(above_m, 1.99) << eye.name;
        EXPECT_LT(above_m, 400'001.0) << eye.name;
        low += above_m < 900.0 ? 1 : 0;  // half of all, on a scale of logarithms
        high += above_m > 100'000.0 ? 1 : 0;
        east += eye.camera.attitude.heading_deg < 180.0 ? 1 : 0;
        EXPECT_LE(eye.camera.attitude.pitch_deg, 0.0);
        EXPECT_EQ(eye.camera.width_px, 640);
    }
    EXPECT_NEAR(low, count / 2, 45);
    EXPECT_NEAR(high, count * std::log(4.0) / std::log(200'000.0), 30);
    EXPECT_NEAR(east, count / 2, 45);
    const auto again = random_eyes(*pages, 10, 5, 640, 360), other = random_eyes(*pages, 10, 6, 640, 360);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ((*again)[i].name, (*eyes)[i].name) << "fewer eyes are the first of more";
        EXPECT_NE((*other)[i].name, (*eyes)[i].name);
    }
}

TEST(RandomEyes, NoPostsNoEyes) {
    HeightField field = test::rough_field(47.0, 8.0, 20, 20);
    field.H_m.assign(field.H_m.size(), void_height_m);
    const auto eyes = random_eyes(*pages_in_memory(field, 1.0, 1), 3, 1, 64, 64);
    ASSERT_FALSE(eyes.ok());
}

TEST(RandomEyes, SpreadIsByRank) {
    std::vector<double> values(200);
    std::iota(values.begin(), values.end(), 1.0);
    std::swap(values[3], values[199]);
    const SpreadOfEyes spread = spread_of(values);
    EXPECT_EQ(spread.median, 100.5);
    EXPECT_EQ(spread.high, 190.0) << "95 % have no more";
    EXPECT_EQ(spread.worst, 200.0);
    EXPECT_EQ(spread.worst_eyes, (std::vector<std::size_t>{3, 198, 197, 196, 195}));
    EXPECT_EQ(spread_of({7.0}).high, 7.0);
    EXPECT_TRUE(spread_of({}).worst_eyes.empty());
}

}  // namespace
}  // namespace oro
