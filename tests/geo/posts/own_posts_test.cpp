// Posts of files in CRSs of their own lie where PROJ and GeographicLib put them.
#include "geo/posts/own_posts.h"

#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <GeographicLib/Geocentric.hpp>
#include <chrono>
#include <cmath>
#include <random>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/page_on_net.h"
#include "geo/files/raster_library.h"
#include "geo/region/region.h"
#include "tests/geo/datum/proj_folder.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace {

struct Case {
    const char* name;
    const char* crs;
    std::array<double, 6> cell_corners;
    int rows, columns;
    const char* shifts{""};  // the grid of shifts that its datum comes by, whose kinks no polynomial follows
};

// Made heights, which name their post.
double made_H_m(int row, int column) {
    return 500.0 + 300.0 * std::sin(0.05 * row) + 200.0 * std::cos(0.031 * column) +
           0.25 * ((row + column) % 2);
}

const std::array<Case, 9> cases{{
    {"LV95", "EPSG:2056", {2600000.0, 25.0, 0.0, 1200000.0, 0.0, -25.0}, 900, 1100},
    // 9 E is the zone's middle, 500 km its easting; 166 km lies at its western edge.
    {"UTM at the edge of a zone", "EPSG:32632", {166000.0, 30.0, 0.0, 5200000.0, 0.0, -30.0}, 700, 900},
    {"the north pole", "EPSG:3413", {-1500.0, 3.0, 0.0, 1500.0, 0.0, -3.0}, 1000, 1000},
    {"the south pole", "EPSG:3031", {-900000.0, 2000.0, 0.0, 900000.0, 0.0, -2000.0}, 900, 900},
    {"Lambert", "EPSG:2154", {600000.0, 90.0, 0.0, 6500000.0, 0.0, -90.0}, 800, 1200},
    {"NZTM", "EPSG:2193", {1400000.0, 15.0, 0.0, 5200000.0, 0.0, -15.0}, 900, 700},
    {"turned by 30 degrees", "EPSG:32632", {400000.0, 17.32, 10.0, 5150000.0, 10.0, -17.32}, 600, 800},
    {"rows northwards", "EPSG:25832", {600000.0, 25.0, 0.0, 5300000.0, 0.0, 25.0}, 500, 400},
    {"degrees on another datum", "EPSG:4267", {-105.0, 0.001, 0.0, 40.0, 0.0, -0.001}, 700, 800},
}};

const std::array<Case, 6> kinked{{
    {"BETA2007 every 25 m",
     "EPSG:31468",
     {4400000.0, 25.0, 0.0, 5300000.0, 0.0, -25.0},
     900,
     1100,
     "BETA2007.gsb"},
    {"BETA2007 every 90 m",
     "EPSG:31467",
     {3450000.0, 90.0, 0.0, 5600000.0, 0.0, -90.0},
     700,
     500,
     "BETA2007.gsb"},
    {"BETA2007 every km",
     "EPSG:31467",
     {3400000.0, 1000.0, 0.0, 5800000.0, 0.0, -1000.0},
     400,
     300,
     "BETA2007.gsb"},
    {"degrees by BETA2007", "EPSG:4314", {10.0, 0.0005, 0.0, 50.0, 0.0, -0.0005}, 300, 400, "BETA2007.gsb"},
    {"NTF", "EPSG:4275", {2.0, 0.0005, 0.0, 46.0, 0.0, -0.0005}, 500, 600, "ntf_r93.gsb"},
    {"NZGD49", "EPSG:27200", {2500000.0, 25.0, 0.0, 5950000.0, 0.0, -25.0}, 700, 900, "nzgd2kgrid0005.gsb"},
}};

std::string written(const std::filesystem::path& file, const Case& of) {
    Raster raster;
    raster.rows = of.rows;
    raster.columns = of.columns;
    raster.cell_corners = of.cell_corners;
    raster.crs = of.crs;
    return write_raster(file, raster, made_H_m);
}

class OwnPostsOf : public testing::TestWithParam<Case> {};

// PROJ's place of a post, by the affine map and the CRS alone.
PostPlace place_by_proj(OGRCoordinateTransformationH to_wgs84, const std::array<double, 6>& corners,
                        double row, double column) {
    double x = corners[0] + corners[1] * (column + 0.5) + corners[2] * (row + 0.5);
    double y = corners[3] + corners[4] * (column + 0.5) + corners[5] * (row + 0.5);
    EXPECT_TRUE(OCTTransform(to_wgs84, 1, &x, &y, nullptr));
    return {y, x};
}

OGRCoordinateTransformationH to_wgs84(const char* crs) {
    const OGRSpatialReferenceH from = OSRNewSpatialReference(nullptr),
                               wgs84 = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(from, crs);
    OSRImportFromEPSG(wgs84, 4326);
    OSRSetAxisMappingStrategy(from, OAMS_TRADITIONAL_GIS_ORDER);
    OSRSetAxisMappingStrategy(wgs84, OAMS_TRADITIONAL_GIS_ORDER);
    return OCTNewCoordinateTransformation(from, wgs84);
}

TEST_P(OwnPostsOf, LieWhereProjAndGeographicLibPutThem) {
    const Case& of = GetParam();
    if (!std::string(of.shifts).empty() && !proj_file(of.shifts)) GTEST_SKIP() << "needs " << of.shifts;
    const auto folder = scratch_folder();
    RegionRequest request;
    request.paths = {written(folder / "own.tif", of)};
    const auto started = std::chrono::steady_clock::now();
    const auto region = test::open_grid(request);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - started;
    ASSERT_TRUE(region.ok()) << region.error().line();
    const HeightField& field = region->field;
    ASSERT_TRUE(field.grid.net) << region->notes.front();
    ASSERT_EQ(field.grid.rows(), of.rows);
    ASSERT_EQ(field.grid.columns(), of.columns);
    EXPECT_EQ(field.grid.net->is_corrected(), !std::string(of.shifts).empty());
    EXPECT_FALSE(region->sources.at(0).resampling);
    EXPECT_LE(field.grid.net->error_m(), LatticeGeoreference::largest_error_m);

    const auto proj = to_wgs84(of.crs);
    ASSERT_TRUE(proj);
    const GeographicLib::Geocentric& earth = GeographicLib::Geocentric::WGS84();
    const bool northwards = of.cell_corners[5] > 0.0;
    constexpr unsigned seed = 601;
    std::mt19937_64 random(seed);
    double worst_m = 0.0, worst_back = 0.0;
    constexpr int posts = 100'000;
    for (int i = 0; i < posts; ++i) {
        const int row = static_cast<int>(random() % static_cast<unsigned>(of.rows));
        const int column = static_cast<int>(random() % static_cast<unsigned>(of.columns));
        const int file_row = northwards ? of.rows - 1 - row : row;
        // The file's own height, at its own post.
        ASSERT_EQ(field.H_at_post_m(row, column), static_cast<float>(made_H_m(file_row, column)));
        const PostPlace expected = place_by_proj(proj, of.cell_corners, file_row, column);
        const double h_m = std::round(2048.0 * drawn_h_m(field, row, column, 1.0)) / 2048.0;
        glm::dvec3 at{};
        earth.Forward(expected.lat_deg, expected.lon_deg, h_m, at.x, at.y, at.z);
        // As the GPU gets it: whole steps.
        const LatticePoint lattice = lattice_point(post_ecef(field, row, column, 1.0).m);
        glm::dvec3 placed{};
        for (int axis = 0; axis < 3; ++axis)
            placed[axis] = static_cast<double>(lattice.steps[static_cast<std::size_t>(axis)]) * height_step_m;
        worst_m = std::max(worst_m, glm::length(placed - at));
        const PostNumber back = field.grid.post_at(expected.lat_deg, expected.lon_deg);
        worst_back = std::max({worst_back, std::abs(back.row - row), std::abs(back.column - column)});
    }
    OCTDestroyCoordinateTransformation(proj);
    const LatticeGeoreference::Stored net = field.grid.net->stored();
    std::printf(
        "%s: seed %u, %d posts: at most %.3f mm off, and %.1e of a post back; net %.1e m, %zu of %d "
        "patches of %d x %d corrected; opened in %.2f s\n",
        of.name, seed, posts, 1e3 * worst_m, worst_back, net.error_m, net.corrections.size(),
        net.down.patches * net.across.patches, net.down.patch_posts, net.across.patch_posts, took.count());
    EXPECT_LE(worst_m, 0.5e-3);
    EXPECT_LE(worst_back, 2.0e-5);
}

std::string name_of(const testing::TestParamInfo<Case>& test) {
    std::string name = test.param.name;
    std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
    return name;
}
INSTANTIATE_TEST_SUITE_P(Crs, OwnPostsOf, testing::ValuesIn(cases), name_of);
INSTANTIATE_TEST_SUITE_P(GridOfShifts, OwnPostsOf, testing::ValuesIn(kinked), name_of);

// A part of a file is its own posts, too: the same ones.
TEST(OwnPosts, OfABoxAreThoseOfTheWhole) {
    const auto folder = scratch_folder();
    const Case& of = cases[0];
    RegionRequest request;
    request.paths = {written(folder / "own.tif", of)};
    const auto whole = test::open_grid(request);
    ASSERT_TRUE(whole.ok()) << whole.error().line();
    const auto& net = *whole->field.grid.net;
    const PostPlace middle = net.place_at(450, 550);
    request.box = BoundingBox{middle.lon_deg - 0.02, middle.lat_deg - 0.01, middle.lon_deg + 0.02,
                              middle.lat_deg + 0.01};
    const auto part = test::open_grid(request);
    ASSERT_TRUE(part.ok()) << part.error().line();
    const PostGrid& grid = part->field.grid;
    EXPECT_LT(grid.rows(), 120);
    EXPECT_GT(grid.rows(), 80);
    const PostPlace corner = grid.place_at(0, 0);
    const PostNumber first = net.post_at(corner.lat_deg, corner.lon_deg);
    const int row = static_cast<int>(std::lround(first.row)),
              column = static_cast<int>(std::lround(first.column));
    EXPECT_NEAR(first.row, row, 1e-5);
    for (int r = 0; r < grid.rows(); ++r) {
        for (int c = 0; c < grid.columns(); ++c) {
            ASSERT_EQ(part->field.H_at_post_m(r, c), whole->field.H_at_post_m(row + r, column + c));
            const PostPlace one = grid.place_at(r, c), other = net.place_at(row + r, column + c);
            ASSERT_EQ(one.lat_deg, other.lat_deg);
            ASSERT_EQ(one.lon_deg, other.lon_deg);
        }
    }
    request.box = BoundingBox{10.0, 50.0, 11.0, 51.0};
    const auto elsewhere = test::open_grid(request);
    ASSERT_FALSE(elsewhere.ok());
    EXPECT_EQ(elsewhere.error().kind, ErrorKind::no_data);
}

// Tiles of one lattice are one grid, also where one is missing: the same posts as those of one file.
TEST(OwnPosts, OfTilesAreThoseOfOneFile) {
    for (const Case& of : {cases[0], cases[7]}) {
        const auto folder = scratch_folder();
        RegionRequest request;
        request.paths = {written(folder / "whole.tif", of)};
        const auto whole = test::open_grid(request);
        ASSERT_TRUE(whole.ok()) << whole.error().line();
        // 2 x 2 tiles that share a row and a column of posts; then without the last.
        const int half_row = of.rows / 2, half_column = of.columns / 2;
        std::vector<std::string> tiles;
        for (int i = 0; i < 4; ++i) {
            const int row = i / 2 * half_row, column = i % 2 * half_column;
            Case tile = of;
            tile.rows = i / 2 == 0 ? half_row + 1 : of.rows - half_row;
            tile.columns = i % 2 == 0 ? half_column + 1 : of.columns - half_column;
            tile.cell_corners[0] += column * of.cell_corners[1] + row * of.cell_corners[2];
            tile.cell_corners[3] += column * of.cell_corners[4] + row * of.cell_corners[5];
            Raster raster;
            raster.rows = tile.rows;
            raster.columns = tile.columns;
            raster.cell_corners = tile.cell_corners;
            raster.crs = tile.crs;
            tiles.push_back(write_raster(folder / ("tile" + std::to_string(i) + ".tif"), raster,
                                         [&](int r, int c) { return made_H_m(row + r, column + c); }));
        }
        request.paths = tiles;
        const auto joined = test::open_grid(request);
        ASSERT_TRUE(joined.ok()) << joined.error().line();
        EXPECT_EQ(joined->posts_hash, whole->posts_hash);
        EXPECT_EQ(joined->seams.shared_posts, static_cast<std::uint64_t>(of.rows + of.columns - 1));
        EXPECT_EQ(joined->seams.disagreeing_posts, 0U);
        EXPECT_EQ(joined->voids, 0U);
        request.paths.pop_back();
        const auto three = test::open_grid(request);
        ASSERT_TRUE(three.ok()) << three.error().line();
        const auto missing = static_cast<std::uint64_t>(of.rows - half_row - 1) *
                             static_cast<std::uint64_t>(of.columns - half_column - 1);
        EXPECT_EQ(three->voids, missing);
        EXPECT_EQ(three->outside, missing);
        EXPECT_EQ(three->void_posts(), 0U);
    }
}

// What is not on one lattice is resampled, and a note says so and which two it is.
TEST(OwnPosts, OfSeveralLatticesAreResampled) {
    const auto folder = scratch_folder();
    const Case& of = cases[0];
    const std::string one = written(folder / "one.tif", of);
    Case half = of, turned = of, elsewhere = of;
    half.cell_corners[0] += 12.5;
    turned.cell_corners[2] = 1.0;
    elsewhere.crs = "EPSG:32632";
    for (const Case& other : {half, turned, elsewhere}) {
        RegionRequest request;
        request.paths = {one, written(folder / "other.tif", other)};
        const auto region = test::open_grid(request);
        const bool near_each_other = std::string(other.crs) == of.crs;
        ASSERT_EQ(region.ok(), near_each_other) << "far apart they need too many posts";
        if (!near_each_other) continue;
        EXPECT_FALSE(region->field.grid.net);
        EXPECT_FALSE(region->posts_crs);
        ASSERT_FALSE(region->notes.empty());
        EXPECT_NE(
            region->notes.front().find("resampled onto one grid of latitudes and longitudes: the posts of "),
            std::string::npos)
            << region->notes.front();
        EXPECT_NE(region->notes.front().find("other.tif and"), std::string::npos) << region->notes.front();
        request.resample = true;
        const auto asked = test::open_grid(request);
        ASSERT_TRUE(asked.ok());
        EXPECT_EQ(asked->posts_hash, region->posts_hash);
        EXPECT_EQ(asked->notes.size() + 1, region->notes.size()) << "what is asked for needs no note";
    }
}

// PROJ takes one operation west of 16.2 E and another east of it, 0.8 m apart. The one for the file's middle
// puts all posts: those near the middle are where PROJ has them, and none is farther off than the two
// operations differ.
TEST(OwnPosts, OfTwoOperationsLieByOne) {
    const auto file = real_data("geotiff/alpinemaps_at_mgi.tif");
    if (!file) GTEST_SKIP() << "needs geotiff/alpinemaps_at_mgi.tif";
    RegionRequest request;
    request.paths = {file->string()};
    const auto region = test::open_grid(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const PostGrid& grid = region->field.grid;
    ASSERT_TRUE(grid.net);
    EXPECT_FALSE(region->sources[0].resampling);
    const SpatialReference crs = spatial_reference(region->posts_crs->wkt);
    const CoordinateTransformation way(OCTNewCoordinateTransformation(crs.get(), wgs84_degrees().get()));
    const auto& m = region->posts_crs->crs_from_post;
    double worst_m = 0.0, worst_in_middle_m = 0.0;
    for (int row = 0; row < grid.rows(); row += 7) {
        for (int column = 0; column < grid.columns(); column += 11) {
            double x = m[0] + m[1] * column + m[2] * row, y = m[3] + m[4] * column + m[5] * row;
            ASSERT_TRUE(OCTTransform(way.get(), 1, &x, &y, nullptr));
            const PostPlace at = grid.net->place_at(row, column);
            const double off_m = std::hypot((at.lat_deg - y) * 111'200.0, (at.lon_deg - x) * 76'000.0);
            worst_m = std::max(worst_m, off_m);
            if (std::abs(row - grid.rows() / 2) < 20 && std::abs(column - grid.columns() / 2) < 20)
                worst_in_middle_m = std::max(worst_in_middle_m, off_m);
        }
    }
    std::printf("%.6f m off in the middle, %.3f m anywhere\n", worst_in_middle_m, worst_m);
    EXPECT_LT(worst_in_middle_m, 1.0e-4);
    EXPECT_LT(worst_m, 1.5);
}

// Files on latitudes and longitudes of WGS84 are read as ever.
TEST(OwnPosts, OfDegreesAreAsEver) {
    const auto folder = scratch_folder();
    const Case degrees{"", "EPSG:4326", {8.0, 0.01, 0.0, 47.0, 0.0, -0.01}, 30, 40};
    RegionRequest request;
    request.paths = {written(folder / "degrees.tif", degrees)};
    const auto usual = test::open_grid(request);
    request.resample = true;
    const auto asked = test::open_grid(request);
    ASSERT_TRUE(usual.ok() && asked.ok());
    EXPECT_FALSE(asked->field.grid.net);
    EXPECT_EQ(asked->posts_hash, usual->posts_hash);
}

}  // namespace
}  // namespace oro::test
