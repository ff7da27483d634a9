// Heights go over from a finer grid to the one below, along its rim, and nowhere else.
#include "geo/together/feather.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <random>

#include "geo/together/coverage_rim.h"
#include "geo/together/cut_regions.h"
#include "geo/together/region_ground.h"
#include "tests/support/three_grids.h"

namespace oro {
namespace {

const std::vector<char>* masked_in(const RegionCuts& cuts, std::size_t grid) {
    return cuts.grids[grid].masked_posts.empty() ? nullptr : &cuts.grids[grid].masked_posts;
}

// The third grid lies over the second, and that over the first.
std::optional<double> H_below_m(const std::vector<RegionGrid>& grids, const RegionCuts& cuts,
                                std::size_t number, const PostPlace& at) {
    std::optional<double> H_m;
    for (std::size_t below = number; below-- > 0 && !H_m;)
        H_m = grids[below].field.surface_H_m(at.lat_deg, at.lon_deg, masked_in(cuts, below));
    return H_m;
}

// By a search over all posts of the rim, and a weight of its own.
TEST(Feather, IsWhatDistancesToTheRimSay) {
    constexpr unsigned seed = 17;
    constexpr double width_m = 200.0;
    std::mt19937 random(seed);
    const Region before = test::three_grids(90);
    Region after = test::three_grids(90);
    ASSERT_TRUE(feather(after, width_m).ok());
    const std::vector<RegionGrid>&grids = before.grids, &changed = after.grids;
    const RegionCuts cuts = cut_regions(before).value();
    EXPECT_FALSE(changed[0].feathered);
    double worst_m = 0.0;
    int inside = 0, moved = 0;
    for (const std::size_t number : {1U, 2U}) {
        const HeightField& own = grids[number].field;
        const HeightField& now = changed[number].field;
        const std::vector<RimEdge> rim = coverage_rim(own);
        for (int i = 0; i < 1500; ++i) {
            const int row = static_cast<int>(random() % static_cast<unsigned>(own.grid.rows())),
                      column = static_cast<int>(random() % static_cast<unsigned>(own.grid.columns()));
            if (is_void(own.H_at_post_m(row, column))) {
                EXPECT_TRUE(is_void(now.H_at_post_m(row, column)));
                continue;
            }
            double away_m = 1.0e9;
            for (const RimEdge& edge : rim)
                for (const GridPost& post : {edge.from, edge.to})
                    away_m = std::min(away_m, std::hypot((row - post.row) * own.grid.net->row_m(),
                                                         (column - post.column) * own.grid.net->column_m()));
            if (away_m > width_m) {
                ++inside;
                EXPECT_EQ(own.H_at_post_m(row, column), now.H_at_post_m(row, column));
                continue;
            }
            const PostPlace at = own.grid.place_at(row, column);
            const std::optional<double> below_m = H_below_m(changed, cuts, number, at);
            if (!below_m) {
                EXPECT_EQ(own.H_at_post_m(row, column), now.H_at_post_m(row, column));
                continue;
            }
            const double share = away_m / width_m, weight = share * share * (3.0 - 2.0 * share);
            const double expected_m =
                (1.0 - weight) * *below_m + weight * static_cast<double>(own.H_at_post_m(row, column));
            worst_m =
                std::max(worst_m, std::abs(expected_m - static_cast<double>(now.H_at_post_m(row, column))));
            ++moved;
        }
    }
    std::printf("seed %u: %d posts inside keep their bits, %d near a rim, at most %.6f m off\n", seed, inside,
                moved, worst_m);
    EXPECT_GT(inside, 500);
    EXPECT_GT(moved, 500);
    EXPECT_LT(worst_m, 0.001);
    EXPECT_GT(changed[1].feathered->posts, 1000U);
    EXPECT_GT(changed[1].feathered->most_m, 10.0);
    EXPECT_GT(changed[1].feathered->rms_m, 1.0);
}

// No step is left along rims but what straight lines between posts leave.
TEST(Feather, LeavesNoSteps) {
    Region region = test::three_grids(90);
    const double west_deg = region.grids[0].field.grid.west_deg() + 0.001;
    const auto highest_step_m = [&] {
        const auto ground = RegionGround::of(region, 1.0);
        EXPECT_TRUE(ground.ok());
        double most_m = 0.0;
        for (const SurfaceTriangle& piece : (*ground)->ground().pieces())
            for (std::size_t i = 0; i < 3; ++i) {
                const Geodetic &one = piece.corners[i], &next = piece.corners[(i + 1) % 3];
                // Where the coarse grid ends beside a finer one there is nothing to go over to.
                if (one.lon_deg < west_deg) continue;
                if (one.lat_deg == next.lat_deg && one.lon_deg == next.lon_deg)
                    most_m = std::max(most_m, std::abs(one.h_m - next.h_m));
            }
        return most_m;
    };
    const double before_m = highest_step_m();
    ASSERT_TRUE(feather(region, 200.0).ok());
    const double after_m = highest_step_m();
    std::printf("steps of up to %.2f m before, %.2f m after\n", before_m, after_m);
    EXPECT_GT(before_m, 15.0);
    EXPECT_LT(after_m, 0.5 * before_m);
}

}  // namespace
}  // namespace oro
