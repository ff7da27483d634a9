// Must hold: what a sweep measures of many posts at once has the same bits as what is asked of one post.
#include "core/sight/swept_posts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

#include "core/sight/horizon_sector.h"
#include "core/sight/observer.h"
#include "tests/core/sight/against_observers.h"
#include "tests/core/sight/tangent_around.h"
#include "tests/support/made_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

HeightField hills_with_voids(std::mt19937& random) {
    const test::Waves hills{1200.0, 500.0, 90.0, 11};
    HeightField field = test::made_field(46.6, 8.3, 1200.0, 150, 150, [&](double lat_deg, double lon_deg) {
        return static_cast<float>(hills.H_m(lat_deg, lon_deg));
    });
    std::uniform_int_distribution<std::size_t> any(0, field.H_m.size() - 1);
    for (int i = 0; i < 30; ++i) field.H_m[any(random)] = void_height_m;
    return field;
}

// The rule of the sweep for one post, of how far its edges reach.
double reach_of(const EyePlane& plane, const PlanePost& post) {
    const double sine = plane.longest_edge_m() / std::max(post.distance_m, 1.0e-9);
    return sine < 0.25 ? 1.05 * sine : 4.0 * sine;
}

// A sector's posts, by both ways. Gives how many of them have a bound.
int compare_posts(const EyePlane& plane, const GridPart& window, int ranges, int first, int count) {
    SweptPosts swept(plane, ranges, first, count);
    HorizonSector sector(plane, ranges, first, count);
    std::vector<std::int64_t> numbers;
    for (int row = 0; row < window.rows; ++row)
        for (int column = 0; column < window.columns; ++column) {
            const std::int64_t number = plane.number(row, column);
            if (std::isnan(plane.post(number).z)) continue;
            numbers.push_back(number);
            swept.add(number, plane.normal(row, column));
            // Something that a sector's ranges can be above.
            sector.add_edge(number, number + 1, false);
        }
    swept.measure();
    int bounded = 0, differing = 0, above = 0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const PlanePost& post = plane.post(numbers[i]);
        const SweptPosts::Post measured = swept.at(i);
        const double most = test::most_tangent_around(plane, numbers[i]);
        bounded += most < infinite;
        differing += measured.most_tangent != most;
        differing += measured.range != static_cast<int>(azimuth_number(post) * 0.25 * ranges) - first;
        for (const double tangent : {most, -0.05, 0.0, 0.1}) {
            const bool is_above = sector.is_above(post, reach_of(plane, post), tangent);
            differing += sector.is_above(measured.first_range, measured.last_range, tangent) != is_above;
            above += is_above;
        }
    }
    EXPECT_EQ(differing, 0) << "ranges from " << first;
    // The check would hold of ranges that are never above.
    EXPECT_GT(above, 100) << "ranges from " << first;
    return bounded;
}

TEST(SweptPosts, AreMeasuredAsOneByOne) {
    constexpr unsigned seed = 20261129;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const HeightField field = hills_with_voids(random);
    const TrueSurface surface(field, 1.0, 1);
    const Observer observer(surface, test::eye_over(surface, 46.54, 8.36, 3.0), standard_air);
    const GridPart window{0, field.grid.rows(), 0, field.grid.columns()};
    EyePlane plane(surface, observer, window, 1);
    constexpr int ranges = 512;
    // Without bounds of tangents, then with them.
    EXPECT_EQ(compare_posts(plane, window, ranges, 0, ranges), 0);
    plane.bound_tangents(3.0 * plane.longest_edge_m(), 1);
    // The first and the last sector meet in the east, where azimuths begin.
    for (const auto& [first, count] :
         {std::pair{0, 64}, std::pair{448, 64}, std::pair{256, 32}, std::pair{0, ranges}})
        EXPECT_GT(compare_posts(plane, window, ranges, first, count), 10000);
}

TEST(SweptPosts, NormalsAreTurnedIntoThePostsDirections) {
    std::mt19937 random(1);
    const HeightField field = hills_with_voids(random);
    const TrueSurface surface(field, 1.0, 1);
    const Observer observer(surface, test::eye_over(surface, 46.54, 8.36, 3.0), standard_air);
    const EyePlane plane(surface, observer, {0, field.grid.rows(), 0, field.grid.columns()}, 1);
    const std::int64_t number = plane.number(20, 30);
    SweptPosts swept(plane, 512, 0, 512);
    swept.add(number, {0.0, 0.0, 1.0});
    swept.add(number, plane.normal(20, 30));
    swept.measure();
    const PlanePost& post = plane.post(number);
    EXPECT_EQ(swept.at(0).up_s, 0.0);
    EXPECT_EQ(swept.at(0).aside, 0.0);
    EXPECT_EQ(swept.at(0).up_z, 1.0);
    // The normal turns away by the angle at the Earth's centre, some 6.37e6 m below (Gaussian radius at 46.5
    // N: 6.379e6 m; Snyder, Map Projections, 1987, p. 24), in the post's own direction.
    EXPECT_NEAR(swept.at(1).up_s, post.distance_m / 6.379e6, 0.01 * post.distance_m / 6.379e6);
    EXPECT_LT(swept.at(1).aside, 0.01 * swept.at(1).up_s);
}

// Flat ground 10 m below a level line, and a normal that stands upright: by hand, a target must be 10 m high.
TEST(HiddenTargets, MissTheLineByWhatIsBetween) {
    EXPECT_NEAR(needed_height_m(-10.0, 100.0, 0.0, 1.0, 0.0, 0.0), 10.0, 1e-12);
    // A line that rises by 0.1 a metre is 10 m higher at 100 m.
    EXPECT_NEAR(needed_height_m(-10.0, 100.0, 0.0, 1.0, 0.0, 0.1), 20.0, 1e-12);
    // Light that bends by 1e-5 s^2 lifts the post by 0.1 m.
    EXPECT_NEAR(needed_height_m(-10.0, 100.0, 0.0, 1.0, 1.0e-5, 0.0), 9.9, 1e-12);
    // A normal that falls behind the line: no height would do.
    EXPECT_EQ(needed_height_m(-10.0, 100.0, 0.8, 0.6, 0.0, 1.0), infinite);
    HiddenTargets hidden;
    std::vector<float> deficits_m(3, -1.0F);
    hidden.add({1, -10.0, 100.0, 0.0, 1.0, 0.0, 2.0, 0.0});
    hidden.add({2, -10.0, 100.0, 0.0, 1.0, 0.0, 2.0, 0.5});
    hidden.write(0.0, deficits_m);
    EXPECT_EQ(deficits_m, (std::vector<float>{-1.0F, 8.0F, 8.5F}));
}

TEST(HiddenTargets, HaveTheBitsOfOneByOne) {
    constexpr unsigned seed = 20261130;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    HiddenTargets hidden;
    std::vector<float> expected_m;
    constexpr double bend_per_m = 1.02e-8;
    int unreachable = 0;
    for (std::size_t i = 0; i < 1003; ++i) {
        const double s_m = 100.0 + 6.0e4 * share(random), up_s = i % 50 == 0 ? 0.7 : s_m / 6.379e6;
        const double up_z = std::sqrt(1.0 - up_s * up_s), tangent = i % 50 == 0 ? 1.5 : share(random) - 0.5;
        const double ground_z_m = s_m * tangent - 3000.0 * share(random);
        const double needed_m = needed_height_m(ground_z_m, s_m, up_s, up_z, bend_per_m, tangent);
        unreachable += std::isinf(needed_m);
        expected_m.push_back(static_cast<float>(needed_m - 2.0));
        hidden.add({i, ground_z_m, s_m, up_s, up_z, tangent, 2.0, 0.0});
    }
    std::vector<float> deficits_m(expected_m.size(), -1.0F);
    hidden.write(bend_per_m, deficits_m);
    EXPECT_EQ(deficits_m, expected_m);
    EXPECT_EQ(unreachable, 21);  // each fiftieth of 1003, from the first on
}

TEST(SweptPosts, AreAboveWhatIsBelowAll) {
    std::vector<double> numbers(100, 0.5);
    EXPECT_TRUE(are_all_above(numbers.data(), 100, 0.4));
    EXPECT_FALSE(are_all_above(numbers.data(), 100, 0.5));
    for (const std::size_t low : {0U, 3U, 4U, 35U, 36U, 98U}) {
        numbers[low] = 0.1;
        EXPECT_FALSE(are_all_above(numbers.data(), 99, 0.4)) << low;
        numbers[low] = 0.5;
    }
    numbers[99] = 0.1;
    EXPECT_TRUE(are_all_above(numbers.data(), 99, 0.4));
    EXPECT_TRUE(are_all_above(numbers.data(), 0, 0.9));
}

}  // namespace
}  // namespace oro
