// What finer ground changes of the diagonals of the coarser ground around it.
#include "geo/together/rim_diagonals.h"

#include <gtest/gtest.h>

#include "core/terrain/cell_diagonal.h"

namespace oro {
namespace {

// Level ground with one ridge of 8 m, from the south-west to the north-east, through the posts of row +
// column = 10.
HeightField ridge(int rows, int columns) {
    HeightField field;
    field.grid = {{100.0, 0.0, 4600, -1, rows}, {100.0, 0.0, 800, +1, columns}, {}};
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            field.H_m.push_back(row + column == 10 ? 1008.0F : 1000.0F);
    return field;
}

GridClip cut_at(const HeightField& field, int row, int column) {
    GridClip cut;
    cut.masked_posts.resize(field.H_m.size());
    cut.masked_posts[static_cast<std::size_t>(row * field.grid.columns() + column)] = 1;
    return cut;
}

// Found: 10.9 m at 46.40552033,8.57052069, where N46E008 lies beside a finer file.
TEST(RimDiagonals, AreThoseOfCellsWithinTwoPostsOfTheRim) {
    const HeightField field = ridge(20, 20);
    ASSERT_EQ(cell_diagonal(field, 4, 5), Diagonal::sw_ne);
    EXPECT_FALSE(rim_diagonals(field, {}));
    EXPECT_FALSE(rim_diagonals(field, cut_at(field, 18, 18))) << "no cell near it rises";
    const auto found = rim_diagonals(field, cut_at(field, 5, 5));
    ASSERT_TRUE(found);
    // The cells whose 4 x 4 posts hold (5, 5) have their north-west posts in 3 .. 6. Those with the ridge
    // through them (row + column = 9: four) rise, and those that it touches at a corner (8 and 10: three
    // each).
    EXPECT_EQ(found->cells, 10U);
    EXPECT_DOUBLE_EQ(found->most_m, 8.0);
    EXPECT_NEAR(found->place.lat_deg, 46.0 - 0.01 * 3.5, 1e-9);
    EXPECT_NEAR(found->place.lon_deg, 8.0 + 0.01 * 6.5, 1e-9);
}

}  // namespace
}  // namespace oro
