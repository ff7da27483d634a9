// Grids that lie wholly under others are left out of what is drawn, and no others are.
#include "geo/together/covered_grids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <string>
#include <utility>

#include "geo/region/region_fingerprints.h"
#include "geo/together/cut_regions.h"
#include "tests/support/net_terrain.h"

namespace oro {
namespace {

HeightField flat(PostGrid grid) {
    HeightField field;
    field.grid = std::move(grid);
    field.H_m.assign(field.grid.post_count(), 500.0F);
    return field;
}
// Rows run south from north_deg, columns east from west_deg.
HeightField flat_on_degrees(double north_deg, double west_deg, double posts_per_deg, int rows, int columns) {
    return flat({{posts_per_deg, north_deg, 0, -1, rows}, {posts_per_deg, west_deg, 0, 1, columns}, {}});
}

void add(Region& region, HeightField field, int rank) {
    RegionGrid& grid = region.grids.emplace_back();
    grid.field = std::move(field);
    grid.voids = static_cast<std::uint64_t>(std::ranges::count_if(grid.field.H_m, is_void));
    grid.posts_hash = posts_hash(grid.field);
    grid.rank = rank;
    grid.notes = {"grid " + std::to_string(rank)};
}

std::vector<int> ranks_left(Region region) {
    leave_covered_grids_out(region);
    std::vector<int> ranks;
    for (const RegionGrid& grid : region.grids) ranks.push_back(grid.rank);
    return ranks;
}

TEST(CoveredGrids, OfTwentyAlikeOneIsLeft) {
    Region region;
    for (int rank = 0; rank < 20; ++rank) add(region, flat_on_degrees(47.0, 8.0, 1200.0, 61, 61), rank);
    leave_covered_grids_out(region);
    ASSERT_EQ(region.grids.size(), 1U);
    EXPECT_EQ(region.grids[0].rank, 0);
    // The grids' own notes, and what has become of them.
    ASSERT_EQ(region.grids[0].notes.size(), 21U);
    EXPECT_EQ(region.grids[0].notes.back(), "19 grids of posts lie wholly under others, and are left out");
}

TEST(CoveredGrids, WithTheSameHolesAreLeftOutAndWithOthersStay) {
    HeightField one = flat_on_degrees(47.0, 8.0, 1200.0, 61, 61), other = one;
    one.H_m[500] = void_height_m;
    other.H_m[501] = void_height_m;
    Region same, different;
    add(same, one, 0);
    add(same, one, 1);
    add(different, one, 0);
    add(different, other, 1);
    EXPECT_EQ(ranks_left(same), (std::vector{0}));
    EXPECT_EQ(ranks_left(different), (std::vector{0, 1}));
}

TEST(CoveredGrids, OnesWithinOthersAreLeftOutAndOnesThatReachBeyondStay) {
    const HeightField large = flat_on_degrees(47.0, 8.0, 1200.0, 121, 121);
    const HeightField within = flat_on_degrees(46.98, 8.02, 3600.0, 61, 61);
    const HeightField beyond = flat_on_degrees(46.98, 8.08, 3600.0, 101, 101);
    Region region;
    add(region, within, 1);
    add(region, beyond, 2);
    add(region, large, 0);
    EXPECT_EQ(ranks_left(region), (std::vector{2, 0}));
    // The other way round the small ones are the ground.
    Region turned;
    add(turned, within, 0);
    add(turned, beyond, 1);
    add(turned, large, 2);
    EXPECT_EQ(ranks_left(turned), (std::vector{0, 1, 2}));
    // A large one with a hole may let one below it be seen.
    Region holed;
    add(holed, large, 0);
    holed.grids[0].voids = 1;
    add(holed, within, 1);
    EXPECT_EQ(ranks_left(holed), (std::vector{0, 1}));
}

TEST(CoveredGrids, AreFoundAWholeTurnApart) {
    Region region;
    add(region, flat_on_degrees(1.0, 179.0, 100.0, 101, 201), 0);
    add(region, flat_on_degrees(0.8, -179.9, 100.0, 11, 11), 1);
    EXPECT_EQ(ranks_left(region), (std::vector{0}));
}

TEST(CoveredGrids, OnNetsAreHeldAgainstEachOthersRims) {
    const PostPlace middle{46.95, 8.05};
    const auto turned = [&](int posts, double post_m, double turn_deg) {
        return flat(grid_on_net(test::net_of({posts, posts, middle, post_m, turn_deg})));
    };
    Region alike;
    add(alike, turned(81, 40.0, 27.0), 0);
    add(alike, turned(81, 40.0, 27.0), 1);
    EXPECT_EQ(ranks_left(alike), (std::vector{0}));
    // 3.2 km, turned by 45 degrees, reaches beyond a square of 4 km, and stays within one of 5 km.
    Region narrow, wide;
    add(narrow, turned(101, 40.0, 0.0), 0);
    add(narrow, turned(81, 40.0, 45.0), 1);
    add(wide, turned(126, 40.0, 0.0), 0);
    add(wide, turned(81, 40.0, 45.0), 1);
    EXPECT_EQ(ranks_left(narrow), (std::vector{0, 1}));
    EXPECT_EQ(ranks_left(wide), (std::vector{0}));
    Region under_degrees;
    add(under_degrees, flat_on_degrees(47.0, 8.0, 1200.0, 121, 121), 0);
    add(under_degrees, turned(81, 40.0, 27.0), 1);
    EXPECT_EQ(ranks_left(under_degrees), (std::vector{0}));
}

// Of random grids, those that go are within the one above, and the cut leaves nothing of them.
TEST(CoveredGrids, AreThoseOfWhichNothingIsDrawn) {
    constexpr unsigned seed = 4711;
    std::mt19937 random(seed);
    const auto some = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    int gone = 0;
    for (int i = 0; i < 60; ++i) {
        Region region;
        const int first_row = some(0, 12), first_column = some(0, 12);
        add(region, flat_on_degrees(47.0, 8.0, 100.0, 21, 21), 0);
        add(region,
            flat_on_degrees(47.04 - 0.01 * first_row, 7.96 + 0.01 * first_column, 100.0, some(4, 22),
                            some(4, 22)),
            1);
        const auto cut = cut_of(region, region.grids[1]);
        ASSERT_TRUE(cut.ok());
        // No triangle keeps all its posts, and nothing makes up for those that are lost.
        const PostGrid& grid = region.grids[1].field.grid;
        const auto is_left = [&](int row, int column) {
            return cut->masked_posts.empty() ||
                   cut->masked_posts[static_cast<std::size_t>(row * grid.columns() + column)] == 0;
        };
        bool draws = !cut->ground.empty();
        for (int row = 0; row + 1 < grid.rows(); ++row)
            for (int column = 0; column + 1 < grid.columns(); ++column)
                draws = draws || (is_left(row, column) && is_left(row + 1, column + 1) &&
                                  (is_left(row + 1, column) || is_left(row, column + 1)));
        const std::size_t left = ranks_left(std::move(region)).size();
        const int rows = grid.rows(), columns = grid.columns();
        const bool is_within = first_row - 4 > 0 && first_row - 4 + rows - 1 < 20 && first_column - 4 > 0 &&
                               first_column - 4 + columns - 1 < 20;
        EXPECT_EQ(left, is_within ? 1U : 2U) << "seed " << seed << ", region " << i;
        EXPECT_FALSE(is_within && draws) << "seed " << seed << ", region " << i;
        gone += left == 1 ? 1 : 0;
    }
    EXPECT_GT(gone, 3) << "seed " << seed;
    EXPECT_LT(gone, 57) << "seed " << seed;
}

// 2,000 grids: 2 million comparisons of boxes. The bound is 100 times what they take.
TEST(CoveredGrids, CostLittleForEachPair) {
    Region region;
    for (int rank = 0; rank < 2000; ++rank)
        add(region, flat_on_degrees(47.0, -170.0 + 0.17 * rank, 10.0, 2, 2), rank);
    const auto start = std::chrono::steady_clock::now();
    leave_covered_grids_out(region);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    EXPECT_EQ(region.grids.size(), 2000U);
    EXPECT_LT(took.count(), 5.0);
}

}  // namespace
}  // namespace oro
