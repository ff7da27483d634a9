// Who wins where files of one lattice overlap, and what of a raster lies in a box.
#include <gtest/gtest.h>

#include <cmath>

#include "geo/posts/own_posts.h"
#include "geo/posts/seams.h"
#include "tests/support/net_terrain.h"

namespace oro {
namespace {

Source file(const std::string& path, double lat_spacing_deg, double nominal_deg) {
    Source source;
    source.report.path = path;
    source.lat_spacing_deg = source.lon_spacing_deg = lat_spacing_deg;
    source.report.nominal_spacing_deg = nominal_deg;
    return source;
}

// In degrees at their own middles the southern one is finer: they are of one lattice all the same.
TEST(Precedence, FilesOfOneLatticeAreEquallyFine) {
    const std::vector<Source> sources{file("b.tif", 0.00080, 0.0008085), file("a.tif", 0.00081, 0.0008085)};
    EXPECT_EQ(by_precedence(sources), (std::vector<std::size_t>{1, 0}));
    const std::vector<Source> finer{file("a.tif", 0.00081, 0.0008085), file("b.tif", 0.00041, 0.0004042)};
    EXPECT_EQ(by_precedence(finer), (std::vector<std::size_t>{1, 0}));
}

// A box that is much wider than the raster: the same rows as for one as wide as that. 0.1 degrees are 11.1
// km, or 124 posts every 90 m; a parallel bends by some 7 posts over the raster's 55 km.
TEST(PostsInBox, AreThoseOfTheBoxHoweverFarItReaches) {
    const auto net = test::net_of({667, 611, {46.5, 8.5}, 90.0, 0.0});
    const PostWindow as_wide = posts_in_box(*net, {8.1, 46.5, 8.9, 46.6});
    EXPECT_NEAR(as_wide.rows, 124, 12);
    for (const BoundingBox& wide :
         {BoundingBox{0.0, 46.5, 16.0, 46.6}, BoundingBox{-20.0, 46.5, 30.0, 46.6},
          BoundingBox{-180.0, 46.5, 180.0, 46.6}, BoundingBox{340.0, 46.5, 380.0, 46.6}}) {
        const PostWindow window = posts_in_box(*net, wide);
        EXPECT_NEAR(window.rows, as_wide.rows, 2) << wide.west_deg;
        EXPECT_EQ(window.columns, 611) << wide.west_deg;
    }
    EXPECT_EQ(posts_in_box(*net, {9.5, 46.5, 16.0, 46.6}).rows, 0);
}

}  // namespace
}  // namespace oro
