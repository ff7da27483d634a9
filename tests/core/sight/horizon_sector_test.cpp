// Must hold: posts whose edges a sweep leaves out would have changed nothing. Old rule: each edge is added.
#include "core/sight/horizon_sector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include "core/sight/observer.h"
#include "tests/core/sight/against_observers.h"
#include "tests/core/sight/tangent_around.h"
#include "tests/support/made_terrain.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

// The rule of Sweep::add_edges(), for a post alone.
void add_all_edges(const EyePlane& plane, std::int64_t number, HorizonSector& sector) {
    const PlanePost& post = plane.post(number);
    const double own2 = along(post, post);
    const EyePlane::Neighbours next = plane.neighbours(number);
    for (int i = 0; i < next.count; ++i) {
        const auto neighbour = [&](int of) {
            return next.numbers[static_cast<std::size_t>(of % next.count)];
        };
        const std::int64_t other = neighbour(i);
        const double its2 = along(plane.post(other), plane.post(other));
        if (!(its2 < own2 || (its2 == own2 && other < number))) continue;
        const bool before = std::isnan(plane.post(neighbour(i + next.count - 1)).z);
        const bool after = std::isnan(plane.post(neighbour(i + 1)).z);
        if (!(before && after)) sector.add_edge(number, other, before != after);
    }
}

// Sweeps one sector by both rules, and holds the horizons of its posts together, bit by bit. Gives the share
// of posts whose edges were left out.
double left_out_of_sector(const EyePlane& plane, const std::vector<std::int64_t>& by_distance, int ranges,
                          int first, int count) {
    HorizonSector all(plane, ranges, first, count), few(plane, ranges, first, count);
    std::size_t left_out = 0, differing = 0, compared = 0;
    for (const std::int64_t number : by_distance) {
        const PlanePost& post = plane.post(number);
        const double range = azimuth_number(post) * 0.25 * ranges - first;
        if (range >= 0.0 && range < count && post.distance_m > 1.0e-3) {
            Horizon by_all, by_few;
            const bool known = all.horizon(post, by_all);
            ++compared;
            differing += known != few.horizon(post, by_few) || by_all.tangent != by_few.tangent ||
                         by_all.lowest != by_few.lowest || by_all.highest != by_few.highest ||
                         by_all.has_rim != by_few.has_rim;
        }
        add_all_edges(plane, number, all);
        const double most = test::most_tangent_around(plane, number);
        const double reach = 1.05 * plane.longest_edge_m() / post.distance_m;
        const bool is_left_out = std::isfinite(most) && few.is_above(post, reach, most);
        left_out += is_left_out;
        if (!is_left_out) add_all_edges(plane, number, few);
    }
    EXPECT_GT(compared, 500U);
    EXPECT_EQ(differing, 0U) << "ranges from " << first;
    return static_cast<double>(left_out) / static_cast<double>(by_distance.size());
}

TEST(HorizonSector, LeavesOutOnlyPostsThatChangeNothing) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const test::Waves hills{1200.0, 500.0, 90.0, 7};
    HeightField field = test::made_field(46.6, 8.3, 1200.0, 220, 220, [&](double lat_deg, double lon_deg) {
        return static_cast<float>(hills.H_m(lat_deg, lon_deg));
    });
    std::uniform_int_distribution<std::size_t> any(0, field.H_m.size() - 1);
    for (int i = 0; i < 60; ++i) field.H_m[any(random)] = void_height_m;
    const TrueSurface surface(field, 1.0, 1);
    const Observer observer(surface, test::eye_over(surface, 46.51, 8.39, 3.0), standard_air);
    const GridPart window{0, field.grid.rows(), 0, field.grid.columns()};
    EyePlane plane(surface, observer, window, 1);
    plane.bound_tangents(3.0 * plane.longest_edge_m(), 1);
    std::vector<std::int64_t> numbers;
    for (int row = 0; row < window.rows; ++row)
        for (int column = 0; column < window.columns; ++column)
            if (!std::isnan(plane.post(plane.number(row, column)).z))
                numbers.push_back(plane.number(row, column));
    std::ranges::sort(numbers, {}, [&](std::int64_t number) {
        return std::pair(along(plane.post(number), plane.post(number)), number);
    });
    constexpr int ranges = 512;
    // The first and the last sector meet in the east, where azimuths begin; one is the whole turn.
    double most_left_out = 0.0;
    for (const auto& [first, count] :
         {std::pair{0, 64}, std::pair{448, 64}, std::pair{192, 64}, std::pair{256, 32}, std::pair{0, 512}})
        most_left_out = std::max(most_left_out, left_out_of_sector(plane, numbers, ranges, first, count));
    // The check would hold of an is_above() that is never true.
    EXPECT_GT(most_left_out, 0.2);
}

}  // namespace
}  // namespace oro
