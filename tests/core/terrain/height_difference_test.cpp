// Differences of height fields: known constants, and brute force over random grids.
#include "core/terrain/height_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/made_terrain.h"

namespace oro {
namespace {

float hills(double lat_deg, double lon_deg) {
    return static_cast<float>(800.0 + 300.0 * std::sin(40.0 * lat_deg) + 200.0 * std::cos(31.0 * lon_deg));
}

HeightAtPlace heights_of(const HeightField& field) {
    return [&field](double lat_deg, double lon_deg) { return H_at_place_m(field, lat_deg, lon_deg); };
}

HeightDifference between(const HeightField& one, const HeightField& other, int threads = 2) {
    return height_difference(one, part_within(one.grid, other.grid), heights_of(other), threads, {}, {});
}

TEST(HeightDifferences, OfAFieldLiftedByAConstantAreThatConstant) {
    const HeightField one = test::made_field(47.0, 8.0, 100.0, 61, 83, hills);
    HeightField other = one;
    for (float& H_m : other.H_m) H_m -= 12.5F;
    const HeightDifference found = between(one, other);
    EXPECT_EQ(found.posts, one.grid.post_count());
    // Floats below 1500 m have steps of 0.12 mm.
    constexpr double step_m = 0.00013;
    EXPECT_NEAR(found.mean_m, 12.5, step_m);
    EXPECT_NEAR(found.rms_m, 12.5, step_m);
    EXPECT_NEAR(found.least_m, 12.5, step_m);
    EXPECT_NEAR(found.greatest_m, 12.5, step_m);
    const HeightDifference none = between(one, one);
    EXPECT_EQ(none.posts, one.grid.post_count());
    EXPECT_EQ(none.rms_m, 0.0);
}

// A plane that rises by 100 m a degree to the north, against itself moved by three posts: 3 m.
TEST(HeightDifferences, OfAMovedPlaneAreItsRise) {
    const auto plane = [](double lat_deg, double) { return static_cast<float>(100.0 * lat_deg - 4000.0); };
    const HeightField one = test::made_field(47.0, 8.0, 100.0, 51, 51, plane);
    const HeightField moved = test::made_field(47.0, 8.0, 100.0, 51, 51, [&](double lat_deg, double lon_deg) {
        return plane(lat_deg - 0.03, lon_deg);
    });
    const HeightDifference found = between(one, moved);
    EXPECT_EQ(found.posts, 51U * 51U);
    EXPECT_NEAR(found.mean_m, 3.0, 0.0002);
    EXPECT_NEAR(found.rms_m, 3.0, 0.0002);
}

TEST(HeightDifferences, AreVoidWhereEitherHasNone) {
    HeightField one = test::made_field(47.0, 8.0, 100.0, 11, 11, hills);
    HeightField other = one;
    one.H_m[3 * 11 + 4] = void_height_m;
    other.H_m[6 * 11 + 7] = void_height_m;
    other.H_m[2 * 11 + 2] += 40.0F;
    other.H_m[9 * 11 + 1] -= 70.0F;
    const HeightDifference found = between(one, other);
    EXPECT_EQ(found.posts, 119U) << "posts beside a void one are there";
    EXPECT_TRUE(is_void(found.difference_m[3 * 11 + 4]));
    EXPECT_TRUE(is_void(found.difference_m[6 * 11 + 7]));
    EXPECT_NEAR(found.least_m, -40.0, 0.0002);
    EXPECT_NEAR(found.greatest_m, 70.0, 0.0002);
    EXPECT_NEAR(found.least_at.lat_deg, 47.0 - 0.02, 1e-9);
    EXPECT_NEAR(found.least_at.lon_deg, 8.02, 1e-9);
    EXPECT_NEAR(found.greatest_at.lat_deg, 47.0 - 0.09, 1e-9);
    EXPECT_NEAR(found.greatest_at.lon_deg, 8.01, 1e-9);
    HeightDifference turned = found;
    negate(turned);
    EXPECT_EQ(turned.least_m, -found.greatest_m);
    EXPECT_EQ(turned.greatest_at.lat_deg, found.least_at.lat_deg);
    EXPECT_EQ(turned.mean_m, -found.mean_m);
    EXPECT_EQ(turned.rms_m, found.rms_m);
    EXPECT_TRUE(is_void(turned.difference_m[3 * 11 + 4]));
}

// Grids of other spacings at other places, each with voids: every post of all of the first, asked one by one.
TEST(HeightDifferences, AreWhatBruteForceFinds) {
    const auto seed = std::random_device{}();
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto between_of = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < 40; ++round) {
        const auto made = [&] {
            HeightField field = test::made_field(
                between_of(46.0, 47.0), between_of(8.0, 9.0), between_of(20.0, 60.0),
                static_cast<int>(between_of(2.0, 50.0)), static_cast<int>(between_of(2.0, 50.0)), hills);
            for (float& H_m : field.H_m)
                if (between_of(0.0, 1.0) < 0.05) H_m = void_height_m;
            return field;
        };
        const HeightField one = made(), other = made();
        const HeightDifference found = between(one, other, 3);
        double sum_m = 0.0, sum_m2 = 0.0, least_m = 0.0, greatest_m = 0.0;
        std::uint64_t posts = 0;
        for (int row = 0; row < one.grid.rows(); ++row) {
            for (int column = 0; column < one.grid.columns(); ++column) {
                const PostPlace place = one.grid.place_at(row, column);
                const float H_m = one.H_at_post_m(row, column);
                const auto other_m = H_at_place_m(other, place.lat_deg, place.lon_deg);
                const int down = row - found.window.first_row, right = column - found.window.first_column;
                const bool is_in =
                    down >= 0 && down < found.window.rows && right >= 0 && right < found.window.columns;
                const bool has_both = !is_void(H_m) && other_m;
                ASSERT_TRUE(is_in || !has_both) << round << ": " << row << ", " << column << " is left out";
                if (!is_in) continue;
                const float difference_m =
                    found.difference_m[static_cast<std::size_t>(down) *
                                           static_cast<std::size_t>(found.window.columns) +
                                       static_cast<std::size_t>(right)];
                ASSERT_EQ(is_void(difference_m), !has_both) << round << ": " << row << ", " << column;
                if (!has_both) continue;
                ASSERT_EQ(difference_m, static_cast<float>(static_cast<double>(H_m) - *other_m));
                const auto m = static_cast<double>(difference_m);
                least_m = posts == 0 ? m : std::min(least_m, m);
                greatest_m = posts == 0 ? m : std::max(greatest_m, m);
                sum_m += m;
                sum_m2 += m * m;
                ++posts;
            }
        }
        ASSERT_EQ(found.posts, posts) << round;
        EXPECT_EQ(found.least_m, least_m);
        EXPECT_EQ(found.greatest_m, greatest_m);
        const double count = posts == 0 ? 1.0 : static_cast<double>(posts);
        EXPECT_NEAR(found.mean_m, sum_m / count, 1e-9);
        EXPECT_NEAR(found.rms_m, std::sqrt(sum_m2 / count), 1e-9);
    }
}

// Longitudes of the same meridians, in another whole turn.
TEST(HeightDifferences, MeetOverTheAntimeridian) {
    const HeightField one = test::made_field(10.0, 179.0, 50.0, 20, 101, hills);
    const HeightField other =
        test::made_field(10.0, -180.0, 50.0, 20, 51, [](double, double) { return 5.0F; });
    EXPECT_EQ(between(one, other).posts, 20U * 51U);
    EXPECT_EQ(between(other, one).posts, 20U * 51U);
}

}  // namespace
}  // namespace oro
