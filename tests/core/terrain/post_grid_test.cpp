#include "core/terrain/post_grid.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

constexpr float v = void_height_m;

// A field of 3 x 3 posts, one a degree, north-west post at 47 N 8 E.
HeightField nine_posts(const std::vector<float>& H_m) {
    HeightField field;
    field.grid.lat = {1.0, 0.0, 47, -1, 3};
    field.grid.lon = {1.0, 0.0, 8, +1, 3};
    field.H_m = H_m;
    return field;
}

TEST(GridAxis, APostHasTheSameBitsInEveryRegion) {
    const GridAxis whole{3600.0, 0.0, -180 * 3600, +1, 360 * 3600 + 1};
    const GridAxis part{3600.0, 0.0, 8 * 3600 + 17, +1, 3601};
    const GridAxis falling{3600.0, 0.0, 9 * 3600, -1, 3601};
    for (int i = 0; i < part.count; ++i) {
        const auto expected = std::bit_cast<std::uint64_t>(part.at_deg(i));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(whole.at_deg(188 * 3600 + 17 + i)), expected);
        ASSERT_EQ(std::bit_cast<std::uint64_t>(falling.at_deg(3600 - 17 - i)), expected);
    }
    EXPECT_EQ(part.at_deg(-17), 8.0);
    EXPECT_EQ(falling.at_deg(3600), 8.0);
}

TEST(GridAxis, IndexIsTheInverseOfAngle) {
    std::mt19937_64 random(11);
    for (const double per_deg : {1.0, 4.0, 120.0, 1200.0, 3600.0, 10800.0, 7.3}) {
        for (const int step : {-1, +1}) {
            std::uniform_int_distribution<std::int64_t> first(static_cast<std::int64_t>(-180 * per_deg),
                                                              static_cast<std::int64_t>(180 * per_deg));
            const GridAxis axis{per_deg, 0.3 / per_deg, first(random), step, 5000};
            for (int i = 0; i < axis.count; ++i) {
                ASSERT_NEAR(axis.index_at(axis.at_deg(i)), i, 1e-9);
            }
            EXPECT_NEAR(axis.at_deg(1) - axis.at_deg(0), step / per_deg, 1e-13);
        }
    }
}

TEST(PostGrid, ColumnsAreFoundInAnyWholeTurn) {
    PostGrid grid;
    grid.lat = {10.0, 0.0, 100, -1, 11};
    grid.lon = {10.0, 0.0, 1790, +1, 21};  // 179 E to 179 W, written 181
    EXPECT_DOUBLE_EQ(grid.column_at(179.5), 5.0);
    EXPECT_NEAR(grid.column_at(-179.5), 15.0, 1e-9);
    EXPECT_NEAR(grid.column_at(180.5 - 720.0), 15.0, 1e-9);
    EXPECT_NEAR(grid.column_at(-180.0), 10.0, 1e-9);
    // Outside: the nearer end.
    EXPECT_NEAR(grid.column_at(178.0), -10.0, 1e-9);
    EXPECT_NEAR(grid.column_at(-178.0), 30.0, 1e-9);
    EXPECT_NEAR(grid.column_at(0.5), -1785.0, 1e-9);
    EXPECT_NEAR(grid.column_at(-0.5), 1805.0, 1e-9);
    EXPECT_FALSE(grid.wraps_longitude());
    grid.lon = {10.0, 0.0, -1800, +1, 3601};
    EXPECT_TRUE(grid.wraps_longitude());
    EXPECT_NEAR(grid.column_at(190.0), 100.0, 1e-9);
    EXPECT_NEAR(grid.column_at(-190.0), 3500.0, 1e-9);
    grid.lon.count = 3600;
    EXPECT_FALSE(grid.wraps_longitude());
}

TEST(HeightField, IsLinearOnTheTrianglesOfTheNorthWestSouthEastDiagonal) {
    const HeightField field = nine_posts({0, 10, 20, 100, 50, 70, 200, 210, 220});
    EXPECT_EQ(field.H_at_m(47.0, 8.0), 0.0F);
    EXPECT_EQ(field.H_at_m(46.0, 9.0), 50.0F);
    EXPECT_EQ(field.H_at_m(45.0, 10.0), 220.0F);
    // The diagonal of the first cell joins 0 and 50; the other one would give 55 in the middle.
    EXPECT_FLOAT_EQ(field.H_at_m(46.5, 8.5), 25.0F);
    // South-west triangle (0, 100, 50): a quarter east, three quarters south.
    EXPECT_FLOAT_EQ(field.H_at_m(46.25, 8.25), 0.75F * 100.0F - 0.25F * 50.0F);
    // North-east triangle (0, 10, 50): three quarters east, a quarter south.
    EXPECT_FLOAT_EQ(field.H_at_m(46.75, 8.75), 0.75F * 10.0F + 0.25F * 40.0F);
    // Whole turns do not matter; outside there is nothing.
    EXPECT_FLOAT_EQ(field.H_at_m(46.5, 8.5 + 360.0), 25.0F);
    EXPECT_FLOAT_EQ(field.H_at_m(46.5, 8.5 - 720.0), 25.0F);
    for (const auto& [lat, lon] : {std::pair{47.001, 8.5}, {44.999, 8.5}, {46.0, 7.999}, {46.0, 10.001}})
        EXPECT_TRUE(is_void(field.H_at_m(lat, lon)));
    EXPECT_TRUE(is_void(field.H_at_m(std::nan(""), 8.5)));
}

TEST(HeightField, VoidPostsTakeTheirTrianglesAway) {
    // The first cell lacks its north-east post: its south-west triangle stays.
    const HeightField field = nine_posts({0, v, 20, 100, 50, 70, 200, 210, 220});
    EXPECT_FLOAT_EQ(field.H_at_m(46.25, 8.25), 62.5F);
    EXPECT_TRUE(is_void(field.H_at_m(46.75, 8.75)));
    EXPECT_FLOAT_EQ(field.H_at_m(46.5, 8.5), 25.0F) << "the diagonal belongs to the triangle that stays";
    EXPECT_TRUE(is_void(field.H_at_m(46.75, 9.5))) << "its north-west post is void";
    EXPECT_TRUE(is_void(field.H_at_m(46.25, 9.25)));
    EXPECT_FLOAT_EQ(field.H_at_m(46.0, 9.5), 60.0F) << "the edge belongs to the cell in the south";
    EXPECT_EQ(field.H_at_m(46.0, 9.0), 50.0F);
    EXPECT_TRUE(is_void(field.H_at_m(47.0, 9.0)));

    // A void on the diagonal takes both.
    const HeightField other = nine_posts({v, 10, 20, 100, 50, 70, 200, 210, 220});
    EXPECT_TRUE(is_void(other.H_at_m(46.25, 8.25)));
    EXPECT_TRUE(is_void(other.H_at_m(46.75, 8.75)));
    EXPECT_FLOAT_EQ(other.H_at_m(46.5, 9.0), 30.0F) << "the edge belongs to the cell in the east";
    EXPECT_TRUE(is_void(other.H_at_m(46.5, 8.0)));
    EXPECT_EQ(other.H_at_m(46.0, 8.0), 100.0F);
}

TEST(HeightField, HeightRange) {
    const HeightRange range = height_range(nine_posts({v, 10, 20, 100, -50, 70, v, 210, 220}));
    EXPECT_EQ(range.lowest_m, -50.0F);
    EXPECT_EQ(range.highest_m, 220.0F);
    EXPECT_EQ(range.voids, 2U);
    const HeightRange none = height_range(nine_posts({v, v, v, v, v, v, v, v, v}));
    EXPECT_EQ(none.lowest_m, 0.0F);
    EXPECT_EQ(none.highest_m, 0.0F);
    EXPECT_EQ(none.voids, 9U);
}

TEST(UndulationField, IsBilinear) {
    UndulationField field;
    EXPECT_EQ(field.at_m(46.5, 8.5), 0.0);
    field.lat = {4.0, 0.0, 47 * 4, -1, 2};
    field.lon = {4.0, 0.0, 8 * 4, +1, 3};
    field.N_m = {40, 44, 48, 50, 58, 10};
    EXPECT_EQ(field.at_m(47.0, 8.0), 40.0);
    EXPECT_EQ(field.at_m(46.75, 8.5), 10.0);
    EXPECT_DOUBLE_EQ(field.at_m(46.875, 8.125), (40 + 44 + 50 + 58) / 4.0);
    EXPECT_DOUBLE_EQ(field.at_m(47.0 - 0.0625, 8.0 + 0.1875),
                     0.75 * (0.25 * 40 + 0.75 * 44) + 0.25 * (0.25 * 50 + 0.75 * 58));
    EXPECT_DOUBLE_EQ(field.at_m(46.875, 368.125), 48.0);
    // Beyond the nodes: the nearest.
    EXPECT_EQ(field.at_m(60.0, 0.0), 40.0);
    EXPECT_EQ(field.at_m(-60.0, 20.0), 10.0);
    EXPECT_EQ(field.at_m(47.0, 20.0 - 360.0), 48.0);
}

TEST(HeightField, LiftsPostsByTheUndulation) {
    HeightField field = nine_posts({0, 10, 20, 100, 50, 70, 200, 210, 220});
    field.undulation.lat = {1.0, 0.0, 47, -1, 3};
    field.undulation.lon = {1.0, 0.0, 8, +1, 3};
    field.undulation.N_m = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    EXPECT_DOUBLE_EQ(field.h_at_post_m(0, 0), 1.0);
    EXPECT_DOUBLE_EQ(field.h_at_post_m(1, 2), 76.0);
    EXPECT_DOUBLE_EQ(field.h_at_post_m(2, 1), 218.0);
}

TEST(HeightField, WrapsAroundTheEarth) {
    const HeightField field = test::world_field(
        1.0, 90, -180, 181, 361, [](double lat_deg, double lon_deg) { return lat_deg + std::abs(lon_deg); });
    EXPECT_FLOAT_EQ(field.H_at_m(10.0, 179.5), 189.5F);
    EXPECT_FLOAT_EQ(field.H_at_m(10.0, 180.5), 189.5F);
    EXPECT_FLOAT_EQ(field.H_at_m(10.0, -180.0), 190.0F);
    EXPECT_FLOAT_EQ(field.H_at_m(10.0, 180.0), 190.0F);
    EXPECT_FLOAT_EQ(field.H_at_m(-90.0, 0.0), -90.0F);
}

}  // namespace
}  // namespace oro
