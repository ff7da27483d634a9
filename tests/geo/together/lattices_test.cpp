// Which sources that lie together are one grid, and which are grids of their own.
#include "geo/together/lattices.h"

#include <cpl_conv.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <string>
#include <vector>

#include "geo/opening/region_sources.h"

namespace oro {
namespace {

// A tile of a degree on WGS84 degrees.
Source tile(int lat_deg, int lon_deg, double posts_per_deg = 1200.0) {
    Source source = source_of_cell({lat_deg, lon_deg});
    source.report.path = std::to_string(lat_deg) + "," + std::to_string(lon_deg) + "/" +
                         std::to_string(static_cast<int>(posts_per_deg));
    source.on_degrees = true;
    const int posts = static_cast<int>(posts_per_deg) + 1;
    source.report.rows = source.report.columns = posts;
    source.lat_spacing_deg = source.lon_spacing_deg = 1.0 / posts_per_deg;
    source.lat_axis = {posts_per_deg, lat_deg + 1.0, -1, posts};
    source.lon_axis = {posts_per_deg, static_cast<double>(lon_deg), 1, posts};
    return source;
}

std::string wkt(const char* crs) {
    const OGRSpatialReferenceH reference = OSRNewSpatialReference(nullptr);
    EXPECT_EQ(OSRSetFromUserInput(reference, crs), OGRERR_NONE);
    char* text = nullptr;
    OSRExportToWkt(reference, &text);
    std::string exported = text;
    CPLFree(text);
    OSRDestroySpatialReference(reference);
    return exported;
}

// 100 x 100 posts of LV95, from so many metres east and south of a place in N46E008.
Source swiss(double east_m, double south_m, double post_m) {
    Source source = source_of_cell({46, 8});
    source.report.path = "swiss";
    source.report.rows = source.report.columns = 100;
    source.crs_wkt = wkt("EPSG:2056");
    source.crs_from_post = {2650000.0 + east_m, post_m, 0.0, 1150000.0 - south_m, 0.0, -post_m};
    source.lat_spacing_deg = post_m / 111'200.0;
    source.lon_spacing_deg = post_m / 76'500.0;
    source.projected = true;
    return source;
}

TEST(Lattices, TilesOfOneSpacingShareOne) {
    EXPECT_TRUE(share_lattice(tile(46, 8), tile(46, 9)));
    EXPECT_TRUE(share_lattice(tile(46, 8), tile(-12, -170)));
    EXPECT_FALSE(share_lattice(tile(46, 8), tile(46, 9, 3600.0)));
    Source half = tile(46, 9);
    half.lon_axis.start_deg += 0.5 / 1200.0;
    EXPECT_FALSE(share_lattice(tile(46, 8), half));
    half.lon_axis.start_deg += 0.5 / 1200.0;
    EXPECT_TRUE(share_lattice(tile(46, 8), half));
}

TEST(Lattices, ProjectedOnesShareOneByCrsSpacingAndPhase) {
    EXPECT_TRUE(share_lattice(swiss(0, 0, 10), swiss(5000, 300, 10)));
    EXPECT_FALSE(share_lattice(swiss(0, 0, 10), swiss(5005, 300, 10)));
    EXPECT_FALSE(share_lattice(swiss(0, 0, 10), swiss(5000, 300, 20)));
    EXPECT_FALSE(share_lattice(swiss(0, 0, 10), tile(46, 8)));
    Source other = swiss(0, 0, 10);
    other.crs_wkt = wkt("EPSG:32632");
    EXPECT_FALSE(share_lattice(swiss(0, 0, 10), other));
}

TEST(Lattices, GridsOnDegreesStayOneWhileThatIsCheap) {
    // A box of two tiles at 1 second has 1.6 times the posts of both.
    EXPECT_EQ(by_lattice({tile(46, 8), tile(46, 9, 3600.0)}, {}).size(), 1U);
    // A box of 9 tiles at 1 second has 5 times the posts of 8 at 3 seconds and 1 at 1 second.
    std::vector<Source> many{tile(46, 8, 3600.0)};
    for (int i = 1; i < 9; ++i) many.push_back(tile(46 + i / 3, 8 + i % 3));
    const auto grids = by_lattice(many, {});
    ASSERT_EQ(grids.size(), 2U);
    EXPECT_EQ(grids[0].size(), 1U);
    EXPECT_EQ(grids[1].size(), 8U);
}

TEST(Lattices, APostOfAnotherCrsIsAnothersGrid) {
    const auto grids = by_lattice({tile(46, 8), swiss(0, 0, 90), tile(46, 9), swiss(900, 0, 90)}, {});
    ASSERT_EQ(grids.size(), 2U);
    EXPECT_EQ(grids[0].size(), 2U);
    EXPECT_EQ(grids[1].size(), 2U);
}

}  // namespace
}  // namespace oro
