// What is seen over several grids, against lines marched over the ground: these share no code with the
// oracle.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include "core/base/parallel.h"
#include "core/sight/viewshed.h"
#include "geo/together/region_ground.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

// Least height of a straight line over the ground, every half a metre; infinite over no ground.
double least_clearance_m(const TrueGround& ground, const Geodetic& eye, const Geodetic& target) {
    const glm::dvec3 from = ecef_from_geodetic(eye).m, to = ecef_from_geodetic(target).m;
    const int steps = 2 + static_cast<int>(2.0 * glm::length(to - from));
    double least_m = std::numeric_limits<double>::infinity();
    for (int i = 1; i < steps; ++i) {
        const Geodetic at = geodetic_from_ecef({from + (to - from) * (static_cast<double>(i) / steps)});
        if (const auto ground_m = ground.h_m(at.lat_deg, at.lon_deg))
            least_m = std::min(least_m, at.h_m - *ground_m);
    }
    return least_m;
}

TEST(ViewshedOfGrids, IsWhatMarchedLinesSee) {
    const Region region = test::three_grids(200);
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const TrueGround& ground = (*grids)->ground();
    constexpr unsigned seed = 20261124;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    int compared = 0, close = 0, wrong = 0, seen = 0;
    for (const auto& [lat_deg, lon_deg] : {std::pair{46.93, 8.07}, std::pair{46.92, 8.095}}) {
        const Geodetic eye{lat_deg, lon_deg, ground.h_m(lat_deg, lon_deg).value() + 12.0};
        const ViewshedRequest request{eye, {}, 2.0, 1500.0, thread_count()};
        for (std::size_t grid = 0; grid < ground.grids(); ++grid) {
            const Viewshed shed = viewshed(ground, grid, request);
            ASSERT_GT(shed.window.rows, 0);
            for (int i = 0; i < 150; ++i) {
                const int row = shed.window.first_row +
                                std::uniform_int_distribution<int>(0, shed.window.rows - 1)(random);
                const int column = shed.window.first_column +
                                   std::uniform_int_distribution<int>(0, shed.window.columns - 1)(random);
                const float missed_m = shed.clearance_deficit_m[shed.window.number(row, column)];
                Geodetic target = target_over_post(ground.surface(grid), row, column, 0.0);
                const auto ground_m = ground.h_m(target.lat_deg, target.lon_deg);
                if (missed_m == Viewshed::unknown || !ground_m) continue;
                target.h_m = *ground_m + 2.0;
                const double clear_m = least_clearance_m(ground, eye, target);
                ++compared;
                seen += missed_m == 0.0F;
                // A step in the ground is as wide as a line's own.
                if (std::abs(clear_m) < 0.5) {
                    ++close;
                    continue;
                }
                wrong += (clear_m > 0.0) != (missed_m == 0.0F);
                // As much higher as it has to be, the line is clear but for what it is marched by.
                if (missed_m == 0.0F || std::isinf(missed_m)) continue;
                target.h_m += missed_m;
                EXPECT_NEAR(least_clearance_m(ground, eye, target), 0.0, 0.5) << row << " " << column;
            }
        }
    }
    std::printf("%d targets, %d seen, %d within 0.5 m, %d wrong\n", compared, seen, close, wrong);
    EXPECT_GT(compared, 300);
    EXPECT_GT(seen, 20);
    EXPECT_EQ(wrong, 0);
}

// Where nothing else is near, it is the viewshed of the grid alone, bit for bit.
TEST(ViewshedOfGrids, IsThatOfOneWhereNoOtherIsNear) {
    const Region region = test::three_grids(400);
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const TrueGround& ground = (*grids)->ground();
    const Geodetic eye{46.98, 8.02, ground.h_m(46.98, 8.02).value() + 20.0};
    const ViewshedRequest request{eye, standard_air, 0.0, 1500.0, 1};
    const Viewshed all = viewshed(ground, 0, request), one = viewshed(ground.surface(0), 0, request);
    EXPECT_EQ(all.window, one.window);
    EXPECT_EQ(all.clearance_deficit_m, one.clearance_deficit_m);
    EXPECT_FALSE(one.clearance_deficit_m.empty());
}

TEST(ViewshedOfGrids, TakesThePostsOfWhatCoversMost) {
    const Region region = test::three_grids(400);
    const auto grids = RegionGround::of(region, 1.0);
    ASSERT_TRUE(grids.ok());
    const TrueGround& ground = (*grids)->ground();
    const double middle = 0.5 * 400 / 1200.0;
    // Within the finest: 15 m apart, 101 x 91 posts.
    const Geodetic fine{47.0 - middle + 0.008, 8.0 + middle + 0.02, 1000.0};
    EXPECT_EQ(grid_of_most(ground, {fine}, 400.0), std::optional<std::size_t>(2));
    EXPECT_EQ(grid_of_most(ground, {fine}, 8000.0), std::optional<std::size_t>(0));
    EXPECT_EQ(grid_of_most(ground, {{46.98, 8.02, 0.0}}, 400.0), std::optional<std::size_t>(0));
    EXPECT_EQ(grid_of_most(ground, {{10.0, 8.02, 0.0}}, 400.0), std::nullopt);
}

}  // namespace
}  // namespace oro
