#include "core/terrain/summit.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/support/made_terrain.h"

namespace oro {
namespace {

// Posts 0.01 degree apart; the highest is that of row 3 and column 5: 46.97 N, 8.05 E.
std::optional<Geodetic> found(const Geodetic& place, double peak_m = 100.0) {
    const HeightField field = test::made_field(47.0, 8.0, 100.0, 11, 11, [](double, double) { return 0.0F; });
    return highest_post_near(field.grid, place, [&](int row, int column) -> std::optional<double> {
        if (row == 5 && column == 5) return std::nullopt;
        return row == 3 && column == 5 ? peak_m : 10.0 - row - 0.1 * column;
    });
}

TEST(Summit, IsTheHighestPostAtMostTwoPostsAway) {
    for (const Geodetic& near : {Geodetic{46.9851, 8.05, 0.0}, {46.951, 8.069, 0.0}, {46.97, 8.05, 99.0}}) {
        const auto summit = found(near);
        ASSERT_TRUE(summit);
        EXPECT_NEAR(summit->lat_deg, 46.97, 1e-12);
        EXPECT_NEAR(summit->lon_deg, 8.05, 1e-12);
        EXPECT_EQ(summit->h_m, 100.0);
    }
    // Three columns away: what is highest there is another post.
    const auto other = found({46.97, 8.08, 0.0});
    ASSERT_TRUE(other);
    EXPECT_LT(other->h_m, 100.0);
}

TEST(Summit, IsHigherThanThePlace) {
    EXPECT_FALSE(found({46.97, 8.05, 100.0}));
    EXPECT_FALSE(found({46.0, 8.05, 0.0})) << "beyond the grid";
    EXPECT_FALSE(found({46.97, 95.0, 0.0}));
}

// A slope that rises to the north by 10 m a post: the highest post near is the last that is looked at.
TEST(Summit, IsNoneWhereTheGroundGoesOnRising) {
    const HeightField field = test::made_field(47.0, 8.0, 100.0, 11, 11, [](double, double) { return 0.0F; });
    const auto rises = [&](int top_row, const Geodetic& place) {
        const PostHeight post_h_m = [&](int row, int) -> std::optional<double> {
            return 100.0 - 10.0 * std::abs(row - top_row);
        };
        const auto highest = highest_post_near(field.grid, place, post_h_m);
        return highest && rises_beyond(field.grid, place, *highest, post_h_m);
    };
    const Geodetic place{46.95, 8.05, 0.0};  // row 5
    EXPECT_TRUE(rises(2, place)) << "row 3 is reached, row 2 is higher";
    EXPECT_FALSE(rises(3, place));
    EXPECT_FALSE(rises(4, place));
    EXPECT_FALSE(rises(0, {46.98, 8.05, 0.0})) << "the grid ends there";
}

}  // namespace
}  // namespace oro
