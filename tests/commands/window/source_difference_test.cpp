// Differences of two sources as figures, colours and a file.
#include "apps/window/source_difference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/made_terrain.h"

namespace oro {
namespace {

float slope(double lat_deg, double lon_deg) {
    return static_cast<float>(1000.0 + 200.0 * (lat_deg - 46.0) - 100.0 * (lon_deg - 8.0));
}

Region region_of_field(HeightField field) {
    Region region;
    region.grids.emplace_back().field = std::move(field);
    return region;
}

Region plane(double posts_per_deg, int posts, float lift_m, double west_deg = 8.0) {
    return region_of_field(
        test::made_field(47.0, west_deg, posts_per_deg, posts, posts,
                         [&](double lat_deg, double lon_deg) { return slope(lat_deg, lon_deg) + lift_m; }));
}

// A plane against a coarser one that lies 7 m lower: at the posts of the finer one, either way round.
TEST(SourceDifferences, AreAtThePostsOfTheFinerSource) {
    const Region fine = plane(100.0, 41, 0.0F), coarse = plane(20.0, 9, -7.0F);
    double share = 0.0;
    const auto found = source_difference({fine, "fine.tif"}, {coarse, "coarse.tif"},
                                         [&](double now) { share = std::max(share, now); }, {});
    ASSERT_TRUE(found.ok()) << found.error().line();
    EXPECT_EQ(share, 1.0);
    EXPECT_EQ(found->title, "H of fine.tif minus H of coarse.tif");
    EXPECT_EQ(found->posts, "posts of fine.tif");
    EXPECT_FALSE(found->is_of_second);
    EXPECT_EQ(found->found.posts, 41U * 41U);
    EXPECT_NEAR(found->found.mean_m, 7.0, 0.0005);
    EXPECT_NEAR(found->found.rms_m, 7.0, 0.0005);
    EXPECT_EQ(found->limit_m, 20.0);
    const auto turned = source_difference({coarse, "coarse.tif"}, {fine, "fine.tif"}, {}, {});
    ASSERT_TRUE(turned.ok()) << turned.error().line();
    EXPECT_TRUE(turned->is_of_second);
    EXPECT_EQ(turned->posts, "posts of fine.tif");
    EXPECT_NEAR(turned->found.mean_m, -7.0, 0.0005);
}

TEST(SourceDifferences, HaveColoursWhereTheFileHasValues) {
    Region one = plane(100.0, 31, 3.0F);
    one.grids.front().field.H_m[5 * 31 + 6] = void_height_m;
    const Region other = plane(100.0, 31, 0.0F, 8.1);
    const auto found = source_difference({one, "a"}, {other, "b"}, {}, {});
    ASSERT_TRUE(found.ok()) << found.error().line();
    const PostRaster& raster = found->raster;
    ASSERT_EQ(raster.bands.size(), 1U);
    const std::vector<float>& values = raster.bands.front().values;
    const std::vector<std::uint32_t>& colours = found->colours->rgba;
    ASSERT_EQ(values.size(), colours.size());
    ASSERT_EQ(values.size(), raster.part.count());
    EXPECT_EQ(raster.part.rows, found->colours->part.rows);
    EXPECT_EQ(raster.part.first_column, found->colours->part.first_column);
    EXPECT_EQ(raster.no_value, void_height_m);
    std::uint64_t posts = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_EQ(values[i] == void_height_m, colours[i] == 0U) << i;
        if (colours[i] == 0U) continue;
        EXPECT_NEAR(static_cast<double>(values[i]), 3.0, 0.0005);
        ++posts;
    }
    EXPECT_EQ(posts, found->found.posts);
    EXPECT_EQ(posts, 31U * 21U) << "columns 10 to 30 of the first: its void post lies before them";
}

TEST(SourceDifferences, OfPlacesApartAreRefused) {
    const Region one = plane(100.0, 11, 0.0F), other = plane(100.0, 11, 0.0F, 20.0);
    const auto found = source_difference({one, "a"}, {other, "b"}, {}, {});
    ASSERT_FALSE(found.ok());
    EXPECT_EQ(found.error().kind, ErrorKind::no_data);
}

TEST(SourceDifferences, TheRampIsSymmetricAndEndsAtItsLimit) {
    EXPECT_EQ(ramp_limit_m(0.0), 0.1);
    EXPECT_EQ(ramp_limit_m(0.5), 1.0);
    EXPECT_EQ(ramp_limit_m(0.51), 2.0);
    EXPECT_EQ(ramp_limit_m(7.0), 20.0);
    EXPECT_EQ(ramp_limit_m(30.0), 100.0);
    using Colour = std::array<std::uint8_t, 3>;
    EXPECT_EQ(ramp_colour(0.0, 5.0), (Colour{247, 247, 247}));
    EXPECT_EQ(ramp_colour(-5.0, 5.0), (Colour{33, 102, 172}));
    EXPECT_EQ(ramp_colour(9.0, 5.0), (Colour{178, 24, 43}));
    EXPECT_EQ(ramp_colour(2.5, 5.0), (Colour{213, 136, 145})) << "half way, rounded";
}

}  // namespace
}  // namespace oro
