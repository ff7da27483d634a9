// A viewshed of targets that stand on the ground under a canopy, against lines of sight, post by post.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/sight/viewshed.h"
#include "tests/core/sight/against_observers.h"
#include "tests/support/rough_terrain.h"

namespace oro::test {
namespace {

// Patches of trees, 3 to 30 m high, on a third of the posts; none within 5 posts of the middle.
HeightField raised_field(const HeightField& ground, unsigned seed) {
    std::mt19937 random(seed);
    HeightField raised = ground;
    const int rows = ground.grid.rows(), columns = ground.grid.columns();
    for (int patch = 0; patch < rows * columns / 60; ++patch) {
        const int row = std::uniform_int_distribution<int>(0, rows - 1)(random);
        const int column = std::uniform_int_distribution<int>(0, columns - 1)(random);
        const float canopy_m = std::uniform_real_distribution<float>(3.0F, 30.0F)(random);
        for (int r = row; r < std::min(row + 4, rows); ++r) {
            for (int c = column; c < std::min(column + 5, columns); ++c) {
                if (std::max(std::abs(r - rows / 2), std::abs(c - columns / 2)) <= 5) continue;
                const auto post = static_cast<std::size_t>(r * columns + c);
                raised.H_m[post] = ground.H_m[post] + canopy_m;
            }
        }
    }
    return raised;
}

TEST(CanopyViewshed, OfTargetsOnTheGroundIsWhatObserversSee) {
    constexpr unsigned seed = 20261128;
    std::printf("seed %u\n", seed);
    const HeightField ground = rough_field(46.6, 8.4, 121, 141), raised = raised_field(ground, seed);
    const TrueSurface foot(ground, 1.0, 2), top(raised, 1.0, 2);
    const TrueGround footing(foot);
    const double lat_deg = 46.6 - 60.0 / 1200.0, lon_deg = 8.4 + 70.0 / 1200.0;
    for (const auto& [above_m, target_m] : {std::pair{2.0, 0.0}, {40.0, 12.0}, {200.0, 2.0}}) {
        ViewshedRequest request{eye_over(top, lat_deg, lon_deg, above_m), standard_air, target_m, 3.0e3, 2};
        request.footing = &footing;
        const Viewshed shed = viewshed(top, 0, request);
        const Observer observer(top, request.eye, request.air);
        int compared = 0, seen = 0, sunk = 0, measured = 0;
        double worst_m = 0.0;
        for (int row = shed.window.first_row; row < shed.window.first_row + shed.window.rows; ++row) {
            for (int column = shed.window.first_column;
                 column < shed.window.first_column + shed.window.columns; ++column) {
                const float missed_m = shed.clearance_deficit_m[shed.window.number(row, column)];
                if (missed_m == Viewshed::unknown) continue;
                const Geodetic target = target_over_post(foot, row, column, target_m);
                const bool is_sunk = target.h_m < top.post_h_m(row, column).value();
                ++compared;
                sunk += is_sunk;
                seen += missed_m == 0.0F;
                ASSERT_EQ(missed_m == 0.0F, observer.sees(target)) << row << ", " << column;
                if (is_sunk) {
                    ASSERT_GT(missed_m, 0.0F) << row << ", " << column;
                }
                if (missed_m == 0.0F || (row * 7 + column) % 31 != 0) continue;
                const auto by_m = observer.clearance_deficit_m(target);
                if (!by_m || !std::isfinite(missed_m)) continue;
                ++measured;
                worst_m = std::max(
                    worst_m, std::abs(static_cast<double>(missed_m) - *by_m) / std::max(1.0, 1e-3 * *by_m));
            }
        }
        std::printf("eye %g m, target %g m: %d posts, %d seen, %d in the canopy; missed by %.1e m off\n",
                    above_m, target_m, compared, seen, sunk, worst_m);
        EXPECT_GT(compared, 1000);
        EXPECT_GT(sunk, 100);
        EXPECT_GT(seen, 10);
        EXPECT_GT(measured, 10);
        EXPECT_LE(worst_m, 0.12);  // as of any viewshed (docs/commands/viewshed.md)
    }
}

// Where nothing grows targets on the ground are those on the surface: the same bits.
TEST(CanopyViewshed, WithoutAnyIsThatOfTheGround) {
    const HeightField field = rough_field(46.6, 8.4, 61, 61);
    const TrueSurface surface(field, 1.0, 2), same(field, 1.0, 2);
    const TrueGround footing(same);
    ViewshedRequest request{eye_over(surface, 46.575, 8.425, 5.0), standard_air, 1.0, 2.0e3, 1};
    const Viewshed plain = viewshed(surface, 0, request);
    request.footing = &footing;
    EXPECT_EQ(viewshed(surface, 0, request).clearance_deficit_m, plain.clearance_deficit_m);
}

}  // namespace
}  // namespace oro::test
