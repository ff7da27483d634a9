// Which source a place's ground comes from, on boxes written down here and on files.
#include "geo/posts/source_at.h"

#include <gtest/gtest.h>

#include "tests/geo/written_terrain.h"
#include "tests/support/net_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

SourceReport source(const std::string& path, double per_deg, const BoundingBox& box) {
    SourceReport report;
    report.path = path;
    report.lat_spacing_deg = report.lon_spacing_deg = 1.0 / per_deg;
    report.box = box;
    return report;
}

std::string name_at(const RegionGrid& region, double lat_deg, double lon_deg) {
    const SourceReport* const found = source_at(region, lat_deg, lon_deg);
    return found ? found->path : "none";
}

TEST(SourceAt, TheFinerWinsWhereTwoOverlap) {
    RegionGrid region;
    region.sources = {source("a/coarse.tif", 120, {8, 46, 10, 48}),
                      source("z/fine.tif", 3600, {8.5, 46.5, 9, 47})};
    EXPECT_EQ(name_at(region, 46.7, 8.7), "z/fine.tif");
    EXPECT_EQ(name_at(region, 46.7, 9.2), "a/coarse.tif");
    EXPECT_EQ(name_at(region, 46.5, 8.5), "z/fine.tif") << "its rim is its own";
    EXPECT_EQ(name_at(region, 46.4999, 8.7), "a/coarse.tif") << "18 m south of its last post";
    EXPECT_EQ(name_at(region, 45.9, 8.7), "none");
    EXPECT_EQ(name_at(region, 46.7, 10.1), "none");
    EXPECT_EQ(name_at({}, 46.7, 8.7), "none");
}

TEST(SourceAt, AmongEqualsTheFirstFileNameWhateverItsFolder) {
    RegionGrid region;
    region.sources = {source("a/N46E008.hgt", 1200, {8, 46, 9, 47}),
                      source("b/N46E007.hgt", 1200, {7, 46, 8, 47})};
    EXPECT_EQ(name_at(region, 46.5, 8.0), "b/N46E007.hgt") << "the meridian that both have";
    EXPECT_EQ(name_at(region, 46.5, 8.000001), "a/N46E008.hgt");
    EXPECT_EQ(name_at(region, 46.5, 7.999999), "b/N46E007.hgt");
}

// Two files of a turned lattice, side by side: each one's box holds a corner of the other.
TEST(SourceAt, OnANetByTheFilesOwnPosts) {
    const test::PlaneOfPosts plane{101, 201, {46.5, 8.5}, 30.0, 30.0};
    RegionGrid region;
    region.field.grid = grid_on_net(test::net_of(plane));
    const BoundingBox all{8.0, 46.0, 9.0, 47.0};
    region.sources = {source("a.tif", 3600, all), source("b.tif", 3600, all)};
    region.sources[0].part = PartOfGrid{0, 0, 101, 101};
    region.sources[1].part = PartOfGrid{0, 101, 101, 100};
    const auto name = [&](double row, double column) {
        const PostPlace place = plane.place_of(row, column);
        return name_at(region, place.lat_deg, place.lon_deg);
    };
    EXPECT_EQ(name(50.0, 30.0), "a.tif");
    EXPECT_EQ(name(50.0, 170.0), "b.tif");
    EXPECT_EQ(name(3.0, 99.5), "a.tif");
    EXPECT_EQ(name(97.0, 102.0), "b.tif");
    EXPECT_EQ(name(50.0, 100.4), "a.tif") << "half a cell beyond its last post";
    EXPECT_EQ(name(-3.0, 50.0), "none");
}

TEST(SourceAt, OverTheAntimeridianInEveryTurn) {
    // Boxes as sources write them: west > east, or east beyond 180; and one round the Earth.
    for (const BoundingBox& box : {BoundingBox{177, -20, -178, -15}, BoundingBox{177, -20, 182, -15}}) {
        RegionGrid region;
        region.sources = {source("fiji.tif", 60, box)};
        for (const double lon_deg : {177.0, 179.5, 180.0, -180.0, -179.0, 181.0, -178.0, 182.0, -183.0})
            EXPECT_EQ(name_at(region, -17.0, lon_deg), "fiji.tif") << lon_deg;
        for (const double lon_deg : {176.9, -177.9, 0.0, 182.1, -183.1})
            EXPECT_EQ(name_at(region, -17.0, lon_deg), "none") << lon_deg;
    }
    RegionGrid world;
    world.sources = {source("world.tif", 1, {-180, -90, 180, 90})};
    for (const double lon_deg : {-180.0, -0.0, 180.0, 359.9})
        EXPECT_EQ(name_at(world, 90.0, lon_deg), "world.tif") << lon_deg;
}

// Two rasters of cell centres side by side: between their last posts there is a cell that neither box holds.
TEST(SourceAt, BetweenTwoBoxesTheNearerOne) {
    RegionGrid region;
    region.sources = {source("west.tif", 10, {8.05, 46.05, 8.95, 46.95}),
                      source("east.tif", 10, {9.05, 46.05, 9.95, 46.95})};
    EXPECT_EQ(name_at(region, 46.5, 8.97), "west.tif");
    EXPECT_EQ(name_at(region, 46.5, 9.03), "east.tif");
    EXPECT_EQ(name_at(region, 46.5, 10.1), "none");
}

// The surface says who it comes from: each file has a height of its own.
TEST(SourceAt, NamesTheFileWhoseHeightsTheSurfaceHas) {
    const fs::path folder = scratch_folder();
    Raster fine;
    fine.rows = fine.columns = 101;
    fine.cell_corners = posts_from(20.25, 10.75, 200.0);
    fine.points = true;
    write_raster(folder / "fine.tif", fine, [](int, int) { return 200.0; });
    Raster coarse;
    coarse.rows = coarse.columns = 21;
    coarse.cell_corners = posts_from(20.0, 11.0, 20.0);
    coarse.points = true;
    write_raster(folder / "coarse.tif", coarse, [](int, int) { return 100.0; });
    const auto region = opened(request_for({folder.string()}));
    ASSERT_TRUE(region);
    int fine_places = 0, coarse_places = 0;
    for (int i = 0; i < 40; ++i) {
        for (int j = 0; j < 40; ++j) {
            const double lat_deg = 10.0127 + 0.0243 * i, lon_deg = 20.0119 + 0.0243 * j;
            const float H_m = region->field.H_at_m(lat_deg, lon_deg);
            const std::string name = fs::path(name_at(*region, lat_deg, lon_deg)).filename().string();
            if (H_m == 200.0F) {
                ++fine_places;
                EXPECT_EQ(name, "fine.tif") << lat_deg << " " << lon_deg;
            } else if (H_m == 100.0F) {
                ++coarse_places;
                EXPECT_EQ(name, "coarse.tif") << lat_deg << " " << lon_deg;
            }  // else: the cells between the two
        }
    }
    EXPECT_GT(fine_places, 300);
    EXPECT_GT(coarse_places, 1000);
}

}  // namespace
}  // namespace oro
