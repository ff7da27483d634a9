// What opening says of resampling, against brute force: GDAL reads the file's posts, PROJ places each, and
// the region's own posts are joined to triangles here.
#include "geo/posts/resampling_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geo/files/raster_library.h"
#include "geo/files/source_paths.h"
#include "geo/measures/region_resampling.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/cell_rule.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// H of the surface at a place, from the region's posts alone: two flat triangles a cell.
std::optional<double> on_triangles(const HeightField& field, double lat_deg, double lon_deg) {
    const PostGrid& grid = field.grid;
    const double y = (grid.north_deg() - lat_deg) * grid.lat.posts_per_deg;
    const double x = (lon_deg - grid.west_deg()) * grid.lon.posts_per_deg;
    const auto row = static_cast<int>(std::floor(y)), column = static_cast<int>(std::floor(x));
    if (row < 0 || column < 0 || row + 1 >= grid.rows() || column + 1 >= grid.columns()) return std::nullopt;
    const double v = y - row, u = x - column;
    const float nw = field.H_at_post_m(row, column), se = field.H_at_post_m(row + 1, column + 1);
    if (sw_ne_by_rule(field, row, column)) {
        const auto a = static_cast<double>(nw), d = static_cast<double>(se),
                   b = static_cast<double>(field.H_at_post_m(row, column + 1)),
                   c = static_cast<double>(field.H_at_post_m(row + 1, column));
        return u + v <= 1.0 ? a + u * (b - a) + v * (c - a) : d + (1.0 - u) * (c - d) + (1.0 - v) * (b - d);
    }
    const float other = u > v ? field.H_at_post_m(row, column + 1) : field.H_at_post_m(row + 1, column);
    if (is_void(nw) || is_void(se) || is_void(other)) return std::nullopt;
    const auto a = static_cast<double>(nw), b = static_cast<double>(other), c = static_cast<double>(se);
    return u > v ? a + u * (b - a) + v * (c - b) : a + v * (b - a) + u * (c - b);
}

struct Expected {
    std::uint64_t compared{}, heights{};
    double squares_m2{}, worst_m{}, highest_m{-1e9}, lowest_m{1e9};
    LatLon worst{}, highest{};
};

// All posts of a file. to_m: of its unit; N is taken off where heights are ellipsoidal.
Expected brute_force(const std::string& file, const HeightField& field, double to_m = 1.0,
                     bool ellipsoidal = false) {
    const Dataset dataset(GDALOpen(file.c_str(), GA_ReadOnly));
    EXPECT_TRUE(dataset);
    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
    const int rows = GDALGetRasterYSize(dataset.get()), columns = GDALGetRasterXSize(dataset.get());
    std::vector<double> heights(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    EXPECT_EQ(
        GDALRasterIO(band, GF_Read, 0, 0, columns, rows, heights.data(), columns, rows, GDT_Float64, 0, 0),
        CE_None);
    int declared = 0;
    const double no_data = GDALGetRasterNoDataValue(band, &declared);
    std::array<double, 6> m{};
    GDALGetGeoTransform(dataset.get(), m.data());
    const SpatialReference crs(OSRClone(GDALGetSpatialRef(dataset.get())));
    OSRSetAxisMappingStrategy(crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
    const CoordinateTransformation to_degrees(
        OCTNewCoordinateTransformation(crs.get(), wgs84_degrees().get()));
    Expected found;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            double height = heights[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) +
                                    static_cast<std::size_t>(c)];
            if (declared && height == no_data) continue;
            ++found.heights;
            double x = m[0] + m[1] * (c + 0.5) + m[2] * (r + 0.5);
            double y = m[3] + m[4] * (c + 0.5) + m[5] * (r + 0.5);
            EXPECT_TRUE(OCTTransform(to_degrees.get(), 1, &x, &y, nullptr));
            height = height * to_m - (ellipsoidal ? field.undulation.at_m(y, x) : 0.0);
            const bool inside = y <= field.grid.north_deg() && y >= field.grid.south_deg() &&
                                x >= field.grid.west_deg() && x <= field.grid.east_deg();
            if (inside && height > found.highest_m) found.highest = {y, x};
            if (inside) found.highest_m = std::max(found.highest_m, height);
            if (inside) found.lowest_m = std::min(found.lowest_m, height);
            const auto shown = on_triangles(field, y, x);
            if (!shown) continue;
            ++found.compared;
            const double off_m = *shown - height;
            found.squares_m2 += off_m * off_m;
            if (std::abs(off_m) <= found.worst_m) continue;
            found.worst_m = std::abs(off_m);
            found.worst = {y, x};
        }
    }
    return found;
}

// A float holds heights of 4,000 m to 0.25 mm.
constexpr double rounding_m = 0.002, same_place_deg = 2e-9;

void expect_as_by_brute_force(const Resampling& said, const Expected& expected, const HeightField& field) {
    EXPECT_EQ(said.compared, expected.compared);
    EXPECT_EQ(said.posts, expected.heights);
    EXPECT_EQ(said.hidden, 0U);
    const double rms_m = std::sqrt(expected.squares_m2 / static_cast<double>(expected.compared));
    EXPECT_NEAR(said.rms_m, rms_m, rounding_m);
    ASSERT_TRUE(said.worst && said.highest && said.lowest);
    EXPECT_NEAR(std::abs(*said.worst->shown_H_m - said.worst->own_H_m), expected.worst_m, rounding_m);
    EXPECT_NEAR(said.worst->lat_deg, expected.worst.lat_deg, same_place_deg);
    EXPECT_NEAR(said.worst->lon_deg, expected.worst.lon_deg, same_place_deg);
    EXPECT_NEAR(said.highest->own_H_m, expected.highest_m, rounding_m);
    EXPECT_NEAR(said.highest->lat_deg, expected.highest.lat_deg, same_place_deg);
    EXPECT_NEAR(said.lowest->own_H_m, expected.lowest_m, rounding_m);
    const auto shown = on_triangles(field, expected.highest.lat_deg, expected.highest.lon_deg);
    EXPECT_EQ(shown.has_value(), said.highest->shown_H_m.has_value());
    if (shown && said.highest->shown_H_m) {
        EXPECT_NEAR(*said.highest->shown_H_m, *shown, rounding_m);
    }
}

const Resampling& only_one(const RegionGrid& region) {
    EXPECT_EQ(region.sources.size(), 1U);
    EXPECT_TRUE(region.sources[0].resampling);
    return *region.sources[0].resampling;
}

// The summit that was found lost: 4107.9 m, shown as 4087.1 m.
TEST(ResamplingError, RealTileInSwissCoordinates) {
    const auto file = real_data("geotiff/N46E008_EPSG2056_f32_cog.tif");
    if (!file) GTEST_SKIP() << "needs geotiff";
    const auto region = opened(resampled_from({file->string()}));
    ASSERT_TRUE(region);
    const Resampling& said = only_one(*region);
    expect_as_by_brute_force(said, brute_force(file->string(), region->field), region->field);
    EXPECT_NEAR(said.highest->own_H_m, 4107.896, 0.001);
    EXPECT_NEAR(*said.highest->shown_H_m, 4087.1, 0.05);
    EXPECT_NEAR(said.rms_m, 3.2036, 0.0005);
    const auto all = region_resampling(*region);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->compared, said.compared);
    EXPECT_EQ(all->rms_m, said.rms_m);
    EXPECT_EQ(worst_resampled(*region), &region->sources[0]);
}

TEST(ResamplingError, RotatedInFeetAndAnotherProjection) {
    const auto folder = real_data("geotiff");
    if (!folder) GTEST_SKIP() << "needs geotiff";
    for (const auto& [name, to_m] : {std::pair{"N46E008_EPSG21781_i16_rotated_nodata_edges.tif", 1.0},
                                     {"N46E008_UTM32_feet_f32.tif", 0.3048},
                                     {"vavilov_EPSG3413_f32.tif", 1.0},
                                     {"alpinemaps_at_mgi.tif", 1.0}}) {
        SCOPED_TRACE(name);
        const auto region = opened(resampled_from({(*folder / name).string()}));
        ASSERT_TRUE(region);
        expect_as_by_brute_force(only_one(*region),
                                 brute_force((*folder / name).string(), region->field, to_m), region->field);
    }
}

// Ridges and a few voids, in UTM.
std::string made_raster(const std::filesystem::path& file, int side, unsigned seed, double west = 400000.0,
                        double post_m = 100.0, double spike_m = 0.0) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> rough(0.0, 200.0);
    std::bernoulli_distribution hole(0.002);
    Raster raster;
    raster.rows = raster.columns = side;
    raster.crs = "EPSG:32632";
    raster.no_data = -9999.0;
    raster.cell_corners = {west, post_m, 0.0, 5100000.0, 0.0, -post_m};
    return write_raster(file, raster, [&](int r, int c) {
        if (spike_m > 0.0 && r == side / 2 + 1 && c == side / 2 + 1) return spike_m;
        return hole(random) ? -9999.0
                            : 1000.0 + 300.0 * std::sin(r / 7.0) * std::cos(c / 9.0) + rough(random);
    });
}

TEST(ResamplingError, VoidsAndRims) {
    const unsigned seed = std::random_device{}();
    std::printf("seed %u\n", seed);
    const std::string file = made_raster(scratch_folder() / "rough.tif", 150, seed);
    const auto region = opened(resampled_from({file}));
    ASSERT_TRUE(region);
    const Resampling& said = only_one(*region);
    expect_as_by_brute_force(said, brute_force(file, region->field), region->field);
    EXPECT_GT(said.unshown, 0U);
    EXPECT_LE(said.compared + said.unshown, said.posts);
}

TEST(ResamplingError, PartOfAFile) {
    const std::string file = made_raster(scratch_folder() / "rough.tif", 150, 3);
    RegionRequest request = resampled_from({file});
    request.box = BoundingBox{7.75, 45.97, 7.82, 46.02};
    const auto region = opened(request);
    ASSERT_TRUE(region);
    const Resampling& said = only_one(*region);
    const Expected expected = brute_force(file, region->field);
    EXPECT_EQ(said.compared, expected.compared);
    EXPECT_LT(said.posts, expected.heights);
    EXPECT_NEAR(said.highest->own_H_m, expected.highest_m, rounding_m);
    EXPECT_NEAR(said.lowest->own_H_m, expected.lowest_m, rounding_m);
    EXPECT_NEAR(std::abs(*said.worst->shown_H_m - said.worst->own_H_m), expected.worst_m, rounding_m);
    ASSERT_TRUE(region->sources[0].stored);
    EXPECT_FALSE(region->sources[0].stored->whole);
}

// Heights above the ellipsoid: N is taken off both.
TEST(ResamplingError, AnotherVerticalDatum) {
    const std::string file = made_raster(scratch_folder() / "rough.tif", 60, 4);
    RegionRequest request = resampled_from({file});
    request.source_vertical = "EPSG:4979";
    const auto region = opened(request);
    ASSERT_TRUE(region);
    expect_as_by_brute_force(only_one(*region), brute_force(file, region->field, 1.0, true), region->field);
    EXPECT_NEAR(region->sources[0].stored->highest_m - only_one(*region).highest->own_H_m, 50.0, 5.0);
}

// More than four million posts: every second of each row and column, and the highest whichever it is.
TEST(ResamplingError, TheHighestPostOfManyIsAlwaysThere) {
    const std::string file = made_raster(scratch_folder() / "wide.tif", 2020, 5, 400000.0, 30.0, 3000.0);
    const auto region = opened(resampled_from({file}));
    ASSERT_TRUE(region);
    const Resampling& said = only_one(*region);
    EXPECT_LT(said.compared, said.posts / 3);
    EXPECT_GT(said.compared, said.posts / 5);
    ASSERT_TRUE(said.highest && said.highest->shown_H_m && said.worst);
    EXPECT_EQ(said.highest->own_H_m, 3000.0);
    EXPECT_GE(std::abs(*said.worst->shown_H_m - said.worst->own_H_m), 3000.0 - *said.highest->shown_H_m);
    const Expected all = brute_force(file, region->field);
    EXPECT_EQ(said.posts, all.heights);
    EXPECT_NEAR(said.rms_m, std::sqrt(all.squares_m2 / static_cast<double>(all.compared)), 0.05 * said.rms_m);
}

// Ground of a finer file that wins is no loss of the coarser one's.
TEST(ResamplingError, AnotherSourcesGroundDoesNotCount) {
    const auto folder = scratch_folder();
    const std::string coarse = made_raster(folder / "coarse.tif", 100, 6);
    Raster raster;
    raster.rows = raster.columns = 60;
    raster.crs = "EPSG:32632";
    raster.cell_corners = {403000.0, 50.0, 0.0, 5097000.0, 0.0, -50.0};
    const std::string fine = write_raster(folder / "fine.tif", raster, [](int, int) { return 8000.0; });
    const auto region = opened(resampled_from({coarse, fine}));
    ASSERT_TRUE(region);
    for (const SourceReport& source : region->sources) {
        ASSERT_TRUE(source.resampling && source.resampling->worst) << source.path;
        const PostShown& worst = *source.resampling->worst;
        EXPECT_LT(std::abs(*worst.shown_H_m - worst.own_H_m), 1000.0) << source.path;
        EXPECT_EQ(source.resampling->hidden > 500, source.path == coarse);
    }
}

TEST(ResamplingError, PostsThatAreTheRegionsAreNotMeasured) {
    const auto folder = scratch_folder();
    const auto region = opened(resampled_from(
        {write_hgt(folder / "N46E008.hgt", 1201, [](int r, int c) { return (r * c) % 900; })}));
    ASSERT_TRUE(region);
    EXPECT_FALSE(region->sources[0].resampling);
    EXPECT_FALSE(region_resampling(*region));
}

// A coarser file on a whole part of the finer one's posts is interpolated, and keeps its own.
TEST(ResamplingError, InterpolatedPostsAreKept) {
    const auto folder = scratch_folder();
    Raster raster;
    raster.rows = raster.columns = 41;
    raster.cell_corners = posts_from(10.0, 50.0, 400.0);
    const std::string fine = write_raster(folder / "fine.tif", raster, [](int r, int c) { return r + c; });
    raster.cell_corners = posts_from(10.2, 50.0, 200.0);
    const std::string coarse =
        write_raster(folder / "coarse.tif", raster, [](int r, int c) { return (r * 7 + c * 13) % 50; });
    const auto region = opened(resampled_from({fine, coarse}));
    ASSERT_TRUE(region);
    int measured = 0;
    for (const SourceReport& source : region->sources) {
        if (!source.resampling) continue;
        ++measured;
        EXPECT_EQ(source.path, coarse);
        EXPECT_EQ(source.resampling->compared, 41U * 41U);
        EXPECT_LT(source.resampling->rms_m, 1e-6);
    }
    EXPECT_EQ(measured, 1);
}

}  // namespace
}  // namespace oro
