// The rules of orograph-bench-diagonals, on ground whose better diagonal is known.
#include "apps/bench/diagonal_rules.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace oro {
namespace {

// From metres at (row, column), the cell between 1 and 2.
CellHeights heights_of(const std::function<double(double, double)>& h_m) {
    CellHeights heights{};
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column)
            heights[row][column] = h_m(static_cast<double>(row), static_cast<double>(column));
    }
    return heights;
}

// A crest from south-west to north-east through the cell's middle, 10 m a post steep, level along its top:
// the ground does not bend along it. (Its two other posts are as near to each other in height.)
TEST(DiagonalRules, JoinACrest) {
    const CellHeights sw_ne =
        heights_of([](double row, double column) { return -10.0 * std::abs(row + column - 3.0); });
    EXPECT_DOUBLE_EQ(middle_m(sw_ne, Diagonal::sw_ne), 0.0);
    EXPECT_DOUBLE_EQ(middle_m(sw_ne, Diagonal::nw_se), -10.0);
    for (const auto rule : {least_bend, nearest_smooth}) EXPECT_EQ(rule(sw_ne), Diagonal::sw_ne);
    const CellHeights nw_se =
        heights_of([](double row, double column) { return -10.0 * std::abs(row - column); });
    for (const auto rule : {least_bend, nearest_smooth}) EXPECT_EQ(rule(nw_se), Diagonal::nw_se);
}

// The same crest on a slope of 30 m a post along it: its posts are far apart in height, those across it are
// not. Who joins the nearest heights cuts the crest.
TEST(DiagonalRules, NearestHeightsCutACrestThatClimbs) {
    const CellHeights climbs = heights_of([](double row, double column) {
        return 30.0 * (column - row) - 10.0 * std::abs(row + column - 3.0);
    });
    EXPECT_EQ(nearest_heights(climbs), Diagonal::nw_se);
    EXPECT_EQ(least_bend(climbs), Diagonal::sw_ne);
    EXPECT_EQ(nearest_smooth(climbs), Diagonal::sw_ne);
}

// On a plane both will do, and the first is taken.
TEST(DiagonalRules, TakeTheFirstOnAPlane) {
    const CellHeights plane = heights_of([](double row, double column) { return 2.0 * row + 4.0 * column; });
    EXPECT_EQ(least_bend(plane), Diagonal::nw_se);
    EXPECT_EQ(nearest_smooth(plane), Diagonal::nw_se);
}

// The smooth middle of a cubic along one axis is exact: 1.5 cubed is 3.375.
TEST(DiagonalRules, TheSmoothMiddleIsThatOfACubic) {
    CellHeights cubic = heights_of([](double, double column) { return column * column * column; });
    // Both diagonals have 4.5 there; lowering one post by less than 4 * (4.5 - 3.375) brings its diagonal
    // nearer.
    cubic[1][1] -= 0.5;
    EXPECT_EQ(nearest_smooth(cubic), Diagonal::nw_se);
    cubic[1][1] += 1.0;
    EXPECT_EQ(nearest_smooth(cubic), Diagonal::sw_ne);
}

}  // namespace
}  // namespace oro
