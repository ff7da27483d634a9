// The lattice of trees: a stand of it against a field inventory, and where its tiles lie.
#include "core/growth/tree_sites.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace oro {
namespace {

// Trees of closed forest on so many sites a side, half of them needle trees; places in metres.
std::vector<SiteTree> stand(std::uint32_t side) {
    constexpr std::uint32_t first_row = 3'412'345, first_column = 6'512'345;
    std::vector<SiteTree> trees;
    for (std::uint32_t row = 0; row < side; ++row)
        for (std::uint32_t column = 0; column < side; ++column) {
            SiteTree tree =
                tree_of_site(first_row + row, first_column + column, (7 * row + 3 * column) % 2 == 0);
            if (!tree.stands) continue;
            tree.row = (tree.row - first_row) * site_spacing_m();
            tree.column = (tree.column - first_column) * site_spacing_m();
            trees.push_back(tree);
        }
    return trees;
}

double square_m(std::uint32_t side) {
    return std::pow(side * site_spacing_m(), 2.0);
}

bool within_15_percent(double value, double measured) {
    return std::abs(value - measured) <= 0.15 * measured;
}

// Source: field inventory and lidar of Chablais, plot 3 (J.-M. Monnet, R package lidaRtRee): 402 stems a
// hectare, 311 of them above 10 m; quantiles of height of 10, 50, 90 and 99 %.
TEST(TreeSites, HoldAStandAsAnInventoryCountsIt) {
    constexpr std::uint32_t side = 200;
    const std::vector<SiteTree> trees = stand(side);
    const double hectares = square_m(side) / 1.0e4;
    EXPECT_PRED2(within_15_percent, static_cast<double>(trees.size()) / hectares, 402.0);
    std::vector<double> heights_m;
    for (const SiteTree& tree : trees) heights_m.push_back(tree.height_m);
    std::ranges::sort(heights_m);
    const auto above = heights_m.end() - std::ranges::lower_bound(heights_m, 10.0);
    EXPECT_PRED2(within_15_percent, static_cast<double>(above) / hectares, 311.0);
    const auto quantile = [&](double share) {
        return heights_m[static_cast<std::size_t>(share * static_cast<double>(heights_m.size()))];
    };
    EXPECT_PRED2(within_15_percent, quantile(0.10), 7.3);
    EXPECT_PRED2(within_15_percent, quantile(0.50), 14.3);
    EXPECT_PRED2(within_15_percent, quantile(0.90), 21.7);
    EXPECT_PRED2(within_15_percent, quantile(0.99), 25.9);
}

// Mean distance to the nearest tree, of that of a random forest of as many. Source: P. Clark, F. Evans,
// Distance to nearest neighbor as a measure of spatial relationships in populations, Ecology 35(4),
// 1954; 1.08 in the inventory.
TEST(TreeSites, StandAsFarApartAsInAForest) {
    constexpr std::uint32_t side = 120;
    const std::vector<SiteTree> trees = stand(side);
    const double edge_m = 6.0 * site_spacing_m(), far_m = side * site_spacing_m() - edge_m;
    double sum_m = 0.0;
    std::size_t count = 0;
    for (const SiteTree& tree : trees) {
        if (std::min(tree.row, tree.column) < edge_m || std::max(tree.row, tree.column) > far_m) continue;
        double nearest_m = 1.0e9;
        for (const SiteTree& other : trees)
            if (&other != &tree)
                nearest_m = std::min(nearest_m, std::hypot(tree.row - other.row, tree.column - other.column));
        sum_m += nearest_m;
        ++count;
    }
    const double random_m = 0.5 / std::sqrt(static_cast<double>(trees.size()) / square_m(side));
    EXPECT_PRED2(within_15_percent, sum_m / static_cast<double>(count) / random_m, 1.08);
}

// Of the ground 0.76 lies under crowns of trees above 3 m.
TEST(TreeSites, CoverTheGroundAsMuch) {
    constexpr std::uint32_t side = 60;
    const std::vector<SiteTree> trees = stand(side);
    std::size_t covered = 0, places = 0;
    for (double row = 12.0; row < side * site_spacing_m() - 12.0; row += 1.7)
        for (double column = 12.0; column < side * site_spacing_m() - 12.0; column += 1.7) {
            ++places;
            covered += std::ranges::any_of(trees, [&](const SiteTree& tree) {
                return tree.height_m > 3.0 &&
                       std::hypot(tree.row - row, tree.column - column) < tree.radius_m;
            });
        }
    EXPECT_PRED2(within_15_percent, static_cast<double>(covered) / static_cast<double>(places), 0.76);
}

TEST(TreeSites, HaveTilesThatMeetRoundTheEarth) {
    for (const std::uint32_t row : {0U, 1U, 20'000U, 39'071U, 58'000U, 78'143U}) {
        const std::uint32_t columns = site_tile_columns(row);
        ASSERT_GE(columns, 1U);
        EXPECT_DOUBLE_EQ(site_tile_west_deg(row, 0), -180.0);
        EXPECT_NEAR(site_tile_west_deg(row, columns - 1) + 360.0 / columns, 180.0, 1.0e-9);
        EXPECT_LT(site_tile_south_deg(row), site_tile_south_deg(row + 1));
    }
    EXPECT_DOUBLE_EQ(site_tile_south_deg(gpu::site_tile_rows), 90.0);
    // Square but for 2 % below 80 degrees of latitude.
    const std::uint32_t row = 59'000;
    const double lat_deg = site_tile_south_deg(row), degree_m = 111'320.0;
    const double width_m =
        360.0 / site_tile_columns(row) * degree_m * std::cos(lat_deg * 0.017453292519943295);
    EXPECT_NEAR(width_m, site_spacing_m() * gpu::sites_per_side, 0.02 * width_m);
}

}  // namespace
}  // namespace oro
