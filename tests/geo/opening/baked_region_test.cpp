// A baked region opens as the sources did that it was baked from: the same surface to the bit, whole or cut.
#include "geo/opening/baked_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "core/baked/bake.h"
#include "geo/region/region_description.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

// Bakes what the paths hold; gives the file.
std::string baked(const RegionGrid& region, const fs::path& file) {
    BakeOptions how;
    how.path = file.string();
    how.description = region_description(region);
    how.threads = 2;
    const auto done = bake_region(region.field, how);
    EXPECT_TRUE(done.ok()) << done.error().line();
    return file.string();
}

// Two tiles beside each other with a hole in one, and a cell between them and a third that has no source.
std::vector<std::string> three_tiles(const fs::path& folder) {
    const auto hills = [](int r, int c) {
        if (r > 500 && r < 520 && c > 700 && c < 900) return -32768.0;
        return std::round(800.0 + 300.0 * std::sin(0.01 * r) * std::cos(0.013 * c));
    };
    return {write_hgt(folder / "N10E020.hgt", 1201, hills), write_hgt(folder / "N10E021.hgt", 1201, hills),
            write_hgt(folder / "N10E023.hgt", 1201, hills)};
}

void expect_same_surface(const RegionGrid& is, const RegionGrid& was) {
    const PostGrid &a = is.field.grid, &b = was.field.grid;
    ASSERT_EQ(a.rows(), b.rows());
    ASSERT_EQ(a.columns(), b.columns());
    EXPECT_EQ(a.lat.first, b.lat.first);
    EXPECT_EQ(a.lon.first, b.lon.first);
    EXPECT_EQ(a.north_deg(), b.north_deg());
    EXPECT_EQ(a.west_deg(), b.west_deg());
    EXPECT_EQ(a.east_deg(), b.east_deg());
    std::size_t differing = 0;
    for (int row = 0; row < a.rows(); ++row) {
        for (int column = 0; column < a.columns(); ++column)
            differing += is.field.H_at_post_m(row, column) != was.field.H_at_post_m(row, column) ? 1U : 0U;
    }
    EXPECT_EQ(differing, 0U);
    for (int row = 0; row < a.rows(); row += 97) {
        for (int column = 0; column < a.columns(); column += 89)
            ASSERT_EQ(is.field.undulation.at_m(a.lat.at_deg(row), a.lon.at_deg(column)),
                      was.field.undulation.at_m(b.lat.at_deg(row), b.lon.at_deg(column)));
    }
    EXPECT_EQ(is.voids, was.voids);
    EXPECT_EQ(is.geoid, was.geoid);
    EXPECT_EQ(is.missing_cells, was.missing_cells);
    EXPECT_EQ(height_range(is.field).lowest_m, height_range(was.field).lowest_m);
    EXPECT_EQ(height_range(is.field).highest_m, height_range(was.field).highest_m);
}

TEST(BakedRegion, IsTheSurfaceOfItsSources) {
    const fs::path folder = scratch_folder();
    const auto tiles = opened(request_for(three_tiles(folder)));
    ASSERT_TRUE(tiles);
    EXPECT_FALSE(tiles->file);
    EXPECT_EQ(tiles->missing_cells, std::vector<std::string>{"N10E022"});
    const auto region = opened(request_for({baked(*tiles, folder / "region.oro")}));
    ASSERT_TRUE(region);
    ASSERT_TRUE(region->file);
    EXPECT_TRUE(region->field.H_m.empty()) << "no post is read before it is asked for";
    expect_same_surface(*region, *tiles);
    EXPECT_EQ(region_description(*region), region_description(*tiles));
}

// Boxes inside, across a tile's edge, beyond the region, smaller than a cell: the same posts as from the
// tiles.
TEST(BakedRegion, ABoxCutsOutWhatItCutsOutOfTheSources) {
    const fs::path folder = scratch_folder();
    const std::vector<std::string> paths = three_tiles(folder);
    const auto tiles = opened(request_for(paths));
    ASSERT_TRUE(tiles);
    const std::string file = baked(*tiles, folder / "region.oro");
    constexpr unsigned seed = 2611;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<BoundingBox> boxes{{20.25, 10.25, 20.75, 10.75}, {20.0, 10.0, 21.0, 11.0},
                                   {20.9, 10.1, 21.1, 10.2},     {19.0, 9.0, 20.5, 10.5},
                                   {-30.0, -30.0, 40.0, 40.0},   {20.50001, 10.50001, 20.50002, 10.50002}};
    for (int i = 0; i < 6; ++i) {
        const double west = between(20.0, 21.3), south = between(10.0, 10.9);
        // Not into the cell without a tile: there the file's grid has void posts, and a grid of tiles ends
        // before.
        boxes.push_back({west, south, std::min(22.0, west + between(0.01, 0.6)), south + between(0.01, 0.6)});
    }
    for (const BoundingBox& box : boxes) {
        SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << box.west_deg << "," << box.south_deg
                                        << "," << box.east_deg << "," << box.north_deg);
        RegionRequest of_tiles = request_for(paths), of_file = request_for({file});
        of_tiles.box = of_file.box = box;
        const auto expected = opened(of_tiles), cut = opened(of_file);
        ASSERT_TRUE(expected && cut);
        EXPECT_FALSE(cut->file) << "a part is no whole file";
        expect_same_surface(*cut, *expected);
        EXPECT_EQ(cut->sources.size(), 3U);
        EXPECT_NE(cut->notes.back().find("cut out of"), std::string::npos);
    }
}

// Where a box ends in a cell without source, a cut from the sources ends with them; one from the baked region
// has void posts up to the box's edge.
TEST(BakedRegion, ABoxThatEndsBetweenSourcesHasVoidPostsThere) {
    const fs::path folder = scratch_folder();
    const std::vector<std::string> paths = three_tiles(folder);
    const auto tiles = opened(request_for(paths));
    ASSERT_TRUE(tiles);
    RegionRequest of_tiles = request_for(paths),
                  of_file = request_for({baked(*tiles, folder / "region.oro")});
    of_tiles.box = of_file.box = BoundingBox{21.5, 10.25, 22.5, 10.75};
    const auto expected = opened(of_tiles), cut = opened(of_file);
    ASSERT_TRUE(expected && cut);
    ASSERT_EQ(expected->field.grid.columns(), 601);
    ASSERT_EQ(cut->field.grid.columns(), 1201);
    ASSERT_EQ(cut->field.grid.rows(), expected->field.grid.rows());
    EXPECT_EQ(cut->field.grid.lon.first, expected->field.grid.lon.first);
    EXPECT_EQ(cut->voids, expected->voids + 601U * 600U);
    std::size_t differing = 0;
    for (int row = 0; row < 601; ++row) {
        for (int column = 0; column < 1201; ++column) {
            const float is = cut->field.H_at_post_m(row, column);
            differing +=
                is != (column < 601 ? expected->field.H_at_post_m(row, column) : void_height_m) ? 1U : 0U;
        }
    }
    EXPECT_EQ(differing, 0U);
    EXPECT_EQ(cut->missing_cells, std::vector<std::string>{"N10E022"});
}

TEST(BakedRegion, ABoxOverTheAntimeridian) {
    const fs::path folder = scratch_folder();
    const auto hills = [](int r, int c) { return 100 + (r * 7 + c * 13) % 900; };
    const std::vector<std::string> paths{write_hgt(folder / "S17E179.hgt", 1201, hills),
                                         write_hgt(folder / "S17W180.hgt", 1201, hills)};
    const auto tiles = opened(request_for(paths));
    ASSERT_TRUE(tiles);
    const std::string file = baked(*tiles, folder / "region.oro");
    for (const BoundingBox& box : {BoundingBox{179.75, -16.75, -179.75, -16.25},
                                   {-179.9, -16.9, -179.5, -16.1},
                                   {179.25, -16.5, 179.5, -16.25}}) {
        RegionRequest of_tiles = request_for(paths), of_file = request_for({file});
        of_tiles.box = of_file.box = box;
        const auto expected = opened(of_tiles), cut = opened(of_file);
        ASSERT_TRUE(expected && cut);
        expect_same_surface(*cut, *expected);
    }
}

// The whole Earth, whose last column is its first.
TEST(BakedRegion, BoxesOutOfARegionRoundTheEarth) {
    const fs::path folder = scratch_folder();
    Raster raster;
    raster.rows = 181;
    raster.columns = 360;
    raster.cell_corners = posts_from(-180.0, 90.0, 1.0);
    raster.points = true;
    const std::string path = write_raster(folder / "earth.tif", raster,
                                          [](int r, int c) { return 10.0 * r + 5.0 * std::abs(c - 180); });
    const auto whole = opened(request_for({path}));
    ASSERT_TRUE(whole);
    ASSERT_TRUE(whole->field.grid.wraps_longitude());
    const std::string file = baked(*whole, folder / "region.oro");
    for (const BoundingBox& box :
         {BoundingBox{-10.0, -10.0, 10.0, 10.0}, {170.0, -20.0, -170.0, 20.0}, {-180.0, 60.0, 180.0, 90.0}}) {
        RegionRequest of_tiles = request_for({path}), of_file = request_for({file});
        of_tiles.box = of_file.box = box;
        const auto expected = opened(of_tiles), cut = opened(of_file);
        ASSERT_TRUE(expected && cut);
        expect_same_surface(*cut, *expected);
    }
}

// Of a projected file, which is baked post by post: whole, a part, and a part baked again.
TEST(BakedRegion, OfPostsInTheirOwnCrsIsThatOfItsSource) {
    const fs::path folder = scratch_folder();
    Raster raster;
    raster.rows = 500;
    raster.columns = 400;
    raster.crs = "EPSG:25832";
    // Rows northwards, turned.
    raster.cell_corners = {600000.0, 25.0, -6.0, 5300000.0, 6.0, 25.0};
    const auto hills = [](int r, int c) { return 800.0 + 300.0 * std::sin(0.03 * r) * std::cos(0.05 * c); };
    const auto source = opened(request_for({write_raster(folder / "own.tif", raster, hills)}));
    ASSERT_TRUE(source && source->field.grid.net && source->posts_crs);
    const auto whole = opened(request_for({baked(*source, folder / "own.oro")}));
    ASSERT_TRUE(whole && whole->field.grid.net);
    EXPECT_EQ(whole->posts_crs->wkt, source->posts_crs->wkt);
    EXPECT_EQ(whole->posts_crs->crs_from_post, source->posts_crs->crs_from_post);
    EXPECT_EQ(whole->posts_hash, source->posts_hash);
    const PostPlace middle = source->field.grid.place_at(250, 200);
    RegionRequest of_source = request_for({(folder / "own.tif").string()}),
                  of_file = request_for({(folder / "own.oro").string()});
    of_source.box = of_file.box = BoundingBox{middle.lon_deg - 0.02, middle.lat_deg - 0.015,
                                              middle.lon_deg + 0.02, middle.lat_deg + 0.015};
    const auto expected = opened(of_source), cut = opened(of_file);
    ASSERT_TRUE(expected && cut && cut->field.grid.net);
    const auto again = opened(request_for({baked(*cut, folder / "cut.oro")}));
    ASSERT_TRUE(again);
    const PostGrid& grid = expected->field.grid;
    EXPECT_LT(grid.rows(), 250);
    for (const auto& one : {cut, again}) {
        ASSERT_EQ(one->field.grid.rows(), grid.rows());
        ASSERT_EQ(one->field.grid.columns(), grid.columns());
        for (std::size_t i = 0; i < 6; ++i)
            EXPECT_NEAR(one->posts_crs->crs_from_post[i], expected->posts_crs->crs_from_post[i], 1e-8);
        for (int row = 0; row < grid.rows(); ++row) {
            for (int column = 0; column < grid.columns(); ++column) {
                ASSERT_EQ(one->field.H_at_post_m(row, column), expected->field.H_at_post_m(row, column));
                ASSERT_EQ(one->field.N_at_post_m(row, column), expected->field.N_at_post_m(row, column));
                ASSERT_EQ(one->field.grid.place_at(row, column).lat_deg, grid.place_at(row, column).lat_deg);
                ASSERT_EQ(one->field.grid.place_at(row, column).lon_deg, grid.place_at(row, column).lon_deg);
            }
        }
        EXPECT_EQ(one->posts_hash, expected->posts_hash);
    }
    RegionRequest resampled = request_for({(folder / "own.oro").string()});
    resampled.resample = true;
    const auto refused = test::open_grid(resampled);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::usage);
    // One whose description does not tell it.
    RegionGrid without = *source;
    without.posts_crs.reset();
    const auto damaged = test::open_grid(request_for({baked(without, folder / "without.oro")}));
    ASSERT_FALSE(damaged.ok());
    EXPECT_NE(damaged.error().what.find("does not tell the CRS"), std::string::npos);
}

class BakedRegionErrors : public testing::Test {
  protected:
    void SetUp() override {
        tile_ = three_tiles(folder_)[0];
        const auto tiles = opened(request_for({tile_}));
        ASSERT_TRUE(tiles);
        file_ = baked(*tiles, folder_ / "region.oro");
    }
    Error error_of(const RegionRequest& request) const {
        const auto region = test::open_grid(request);
        EXPECT_FALSE(region.ok());
        return region.ok() ? Error{} : region.error();
    }

    const fs::path folder_ = scratch_folder();
    std::string tile_;
    std::string file_;
};

TEST_F(BakedRegionErrors, OtherPathsBesideIt) {
    for (const auto& paths :
         {std::vector{file_, tile_}, std::vector{tile_, file_}, std::vector{file_, file_}}) {
        const Error error = error_of(request_for(paths));
        EXPECT_EQ(error.kind, ErrorKind::usage);
        EXPECT_NE(error.line().find("opened alone"), std::string::npos) << error.line();
    }
}

TEST_F(BakedRegionErrors, OptionsThatWereDecidedWhenItWasBaked) {
    std::vector<RegionRequest> requests(5, request_for({file_}));
    requests[0].height_unit = "ft";
    requests[1].fill_voids = true;
    requests[2].strict_datum = true;
    requests[3].source_crs = "EPSG:2056";
    requests[4].source_vertical = "EPSG:4979";
    for (const RegionRequest& request : requests) {
        const Error error = error_of(request);
        EXPECT_EQ(error.kind, ErrorKind::usage);
        EXPECT_NE(error.line().find("is decided when a region is baked"), std::string::npos) << error.line();
    }
}

TEST_F(BakedRegionErrors, BoxesWithoutPosts) {
    RegionRequest request = request_for({file_});
    request.box = BoundingBox{0.0, 0.0, 1.0, 1.0};
    EXPECT_EQ(error_of(request).kind, ErrorKind::no_data);
    request.box = BoundingBox{20.65, 10.57, 20.70, 10.58};  // in the hole
    const Error in_hole = error_of(request);
    EXPECT_EQ(in_hole.kind, ErrorKind::no_data);
    EXPECT_NE(in_hole.line().find("has a height"), std::string::npos) << in_hole.line();
}

// A description that tells of another region than the file's is no region's.
TEST_F(BakedRegionErrors, DescriptionsThatDoNotFit) {
    const auto tiles = opened(request_for({tile_}));
    ASSERT_TRUE(tiles);
    BakeOptions how;
    how.path = (folder_ / "other.oro").string();
    how.description = "no description";
    ASSERT_TRUE(bake_region(tiles->field, how).ok());
    EXPECT_NE(error_of(request_for({how.path})).line().find("its description cannot be read"),
              std::string::npos);
    RegionGrid described = *tiles;
    ASSERT_GT(described.voids, 0U);
    described.voids = 0;
    how.path = (folder_ / "another.oro").string();
    how.description = region_description(described);
    ASSERT_TRUE(bake_region(tiles->field, how).ok());
    EXPECT_NE(error_of(request_for({how.path})).line().find("void posts"), std::string::npos);
}

}  // namespace
}  // namespace oro
