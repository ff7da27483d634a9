// Every real file that is not on latitudes and longitudes keeps its own posts: heights, places, range.
#include <gdal.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "core/terrain/ground.h"
#include "geo/files/raster_library.h"
#include "geo/region/region.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro::test {
namespace {

struct RawPosts {
    int rows{}, columns{};
    std::vector<double> values;  // as stored, NaN where GDAL says no data
};

RawPosts raw_posts(const std::string& file) {
    start_gdal();
    RawPosts raw;
    const GDALDatasetH dataset = GDALOpen(file.c_str(), GA_ReadOnly);
    raw.rows = GDALGetRasterYSize(dataset);
    raw.columns = GDALGetRasterXSize(dataset);
    raw.values.resize(static_cast<std::size_t>(raw.rows) * static_cast<std::size_t>(raw.columns));
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    EXPECT_EQ(GDALRasterIO(band, GF_Read, 0, 0, raw.columns, raw.rows, raw.values.data(), raw.columns,
                           raw.rows, GDT_Float64, 0, 0),
              CE_None);
    int has_none = 0;
    const double none = GDALGetRasterNoDataValue(band, &has_none);
    if (has_none != 0) std::ranges::replace(raw.values, none, std::nan(""));
    GDALClose(dataset);
    return raw;
}

class OwnDataOf : public testing::TestWithParam<const char*> {};

TEST_P(OwnDataOf, KeepsItsHeightsAndItsRange) {
    const auto folder = real_data("geotiff");
    if (!folder) GTEST_SKIP() << "needs geotiff";
    const std::string file = *folder / GetParam();
    RegionRequest request;
    request.paths = {file};
    const auto region = test::open_grid(request);
    request.resample = true;
    const auto resampled = test::open_grid(request);
    ASSERT_TRUE(region.ok() && resampled.ok()) << region.error().line();
    const HeightField& field = region->field;
    ASSERT_TRUE(field.grid.net);
    const RawPosts raw = raw_posts(file);
    ASSERT_EQ(raw.rows, field.grid.rows());
    ASSERT_EQ(raw.columns, field.grid.columns());
    const double metres = std::string(GetParam()).find("feet") != std::string::npos ? 0.3048 : 1.0;
    // Rows of the file run southwards in all of these.
    double lowest_m = 1e9, highest_m = -1e9, worst_m = 0.0;
    std::size_t highest = 0;
    std::uint64_t voids = 0;
    for (std::size_t i = 0; i < raw.values.size(); ++i) {
        const float H_m = field.H_m[i];
        if (std::isnan(raw.values[i])) {
            EXPECT_TRUE(is_void(H_m));
            ++voids;
            continue;
        }
        ASSERT_FALSE(is_void(H_m));
        const double expected_m = raw.values[i] * metres;
        worst_m = std::max(worst_m, std::abs(static_cast<double>(H_m) - expected_m));
        lowest_m = std::min(lowest_m, expected_m);
        if (expected_m > highest_m) highest = i;
        highest_m = std::max(highest_m, expected_m);
    }
    const HeightRange range = height_range(field), other = height_range(resampled->field);
    std::printf(
        "%s: %zu posts, %llu void; H %.3f to %.3f m (resampled %.3f to %.3f m); at most %.4f mm off\n",
        GetParam(), raw.values.size(), static_cast<unsigned long long>(voids),
        static_cast<double>(range.lowest_m), static_cast<double>(range.highest_m),
        static_cast<double>(other.lowest_m), static_cast<double>(other.highest_m), 1e3 * worst_m);
    EXPECT_LE(worst_m, 0.5e-3);
    EXPECT_NEAR(static_cast<double>(range.lowest_m), lowest_m, 0.5e-3);
    EXPECT_NEAR(static_cast<double>(range.highest_m), highest_m, 0.5e-3);
    // Who stands at the place of the highest post stands on it.
    const int row = static_cast<int>(highest) / raw.columns, column = static_cast<int>(highest) % raw.columns;
    if (row == 0 || column == 0 || row == raw.rows - 1 || column == raw.columns - 1) return;
    const PostPlace place = field.grid.place_at(row, column);
    const auto ground_m = ground_h_m(field, place.lat_deg, place.lon_deg);
    if (!ground_m) return;  // beside voids
    EXPECT_NEAR(*ground_m - field.undulation.at_m(place.lat_deg, place.lon_deg), highest_m, 0.5e-3);
}

// A continent keeps its posts, and a part of it has the same.
TEST(OwnData, OfAContinentIsKept) {
    const auto file = real_data("geotiff/antarctica_etopo1_EPSG3031_20km.tif");
    if (!file) GTEST_SKIP() << "needs geotiff";
    RegionRequest request;
    request.paths = {file->string()};
    const auto whole = test::open_grid(request);
    ASSERT_TRUE(whole.ok()) << whole.error().line();
    ASSERT_TRUE(whole->field.grid.net);
    request.box = BoundingBox{-180.0, -90.0, 180.0, -84.0};
    const auto part = test::open_grid(request);
    ASSERT_TRUE(part.ok()) << part.error().line();
    ASSERT_TRUE(part->field.grid.net);
    EXPECT_LT(part->field.H_m.size(), whole->field.H_m.size() / 4);
    for (const double lon_deg : {-150.0, 3.0, 77.0})
        EXPECT_NEAR(ground_h_m(part->field, -86.0, lon_deg).value_or(-1.0),
                    ground_h_m(whole->field, -86.0, lon_deg).value_or(1.0), 1.0e-4);
}

INSTANTIATE_TEST_SUITE_P(Files, OwnDataOf,
                         testing::Values("N46E008_EPSG2056_f32_cog.tif", "N46E008_UTM32_feet_f32.tif",
                                         "N46E008_EPSG21781_i16_rotated_nodata_edges.tif",
                                         "vavilov_EPSG3413_f32.tif", "oggm_dem.tif", "demcompare_dem_cm.tif",
                                         "jonnyhuck_data.tif", "qgis_srtm_41_19.tif",
                                         "antarctica_etopo1_EPSG3031_20km.tif"));

}  // namespace
}  // namespace oro::test
