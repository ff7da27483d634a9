// Cloud Optimized GeoTIFFs as GDAL reads them.
#include "geo/rasters/cloud_raster.h"

#include <cpl_string.h>
#include <gdal.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "geo/files/raster_library.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

// Posts every 3 seconds, of which some have no height.
PostRaster raster_of_posts(int rows, int columns, bool whole) {
    constexpr unsigned seed = 55;
    std::printf("seed %u\n", seed);
    std::mt19937 random(seed);
    PostRaster raster;
    raster.grid.lat = {1200.0, 47.0, 0, -1, rows};
    raster.grid.lon = {1200.0, 8.0, 0, +1, columns};
    raster.part = {0, rows, 0, columns};
    raster.no_value = -32768.0F;
    raster.tags = {{"VERTICAL_DATUM", "H, above the geoid EGM96"}};
    PostRaster::Band band{"H", {}};
    for (std::size_t i = 0; i < raster.part.count(); ++i) {
        const float H_m = static_cast<float>(random() % 4000) + (whole ? 0.0F : 0.1F);
        band.values.push_back(random() % 50 == 0 ? raster.no_value : H_m);
    }
    raster.bands.push_back(std::move(band));
    return raster;
}

std::string file_bytes(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void expect_same_posts(const std::string& path, const PostRaster& raster, GDALDataType type) {
    const Dataset file(GDALOpen(path.c_str(), GA_ReadOnly));
    ASSERT_TRUE(file);
    const char* const layout = GDALGetMetadataItem(file.get(), "LAYOUT", "IMAGE_STRUCTURE");
    ASSERT_NE(layout, nullptr);
    EXPECT_STREQ(layout, "COG");
    const GDALRasterBandH band = GDALGetRasterBand(file.get(), 1);
    EXPECT_EQ(GDALGetRasterDataType(band), type);
    int has = 0;
    EXPECT_EQ(GDALGetRasterNoDataValue(band, &has), -32768.0);
    EXPECT_TRUE(has);
    EXPECT_STREQ(GDALGetRasterUnitType(band), "metre");
    EXPECT_STREQ(GDALGetMetadataItem(file.get(), "VERTICAL_DATUM", nullptr), "H, above the geoid EGM96");
    ASSERT_EQ(GDALGetRasterXSize(file.get()), raster.part.columns);
    ASSERT_EQ(GDALGetRasterYSize(file.get()), raster.part.rows);
    std::vector<float> values(raster.part.count());
    ASSERT_EQ(GDALRasterIO(band, GF_Read, 0, 0, raster.part.columns, raster.part.rows, values.data(),
                           raster.part.columns, raster.part.rows, GDT_Float32, 0, 0),
              CE_None);
    EXPECT_EQ(std::memcmp(values.data(), raster.bands[0].values.data(), 4 * values.size()), 0);
}

TEST(CloudRaster, HasThePostsToTheBit) {
    start_gdal();
    const std::string path = test::scratch_folder() / "h.tif";
    for (const bool whole : {false, true}) {
        const PostRaster raster = raster_of_posts(700, 600, whole);
        const auto written = write_cloud_raster(path, true, raster, 2);
        ASSERT_TRUE(written.ok()) << written.error().line();
        EXPECT_EQ(written->whole_numbers, whole);
        EXPECT_EQ(written->bytes, file_bytes(path).size());
        expect_same_posts(path, raster, whole ? GDT_Int16 : GDT_Float32);
        const Dataset file(GDALOpen(path.c_str(), GA_ReadOnly));
        EXPECT_GE(GDALGetOverviewCount(GDALGetRasterBand(file.get(), 1)), 1);
        std::array<double, 6> corners{};
        ASSERT_EQ(GDALGetGeoTransform(file.get(), corners.data()), CE_None);
        EXPECT_NEAR(corners[0], 8.0 - 0.5 / 1200.0, 1e-12);
        EXPECT_NEAR(corners[3], 47.0 + 0.5 / 1200.0, 1e-12);
        EXPECT_STREQ(OSRGetAuthorityCode(GDALGetSpatialRef(file.get()), nullptr), "4326");
    }
}

TEST(CloudRaster, LiesInTheCrsOfItsPosts) {
    start_gdal();
    PostRaster raster = raster_of_posts(60, 80, false);
    const SpatialReference utm(OSRNewSpatialReference(nullptr));
    OSRImportFromEPSG(utm.get(), 32632);
    char* wkt = nullptr;
    OSRExportToWkt(utm.get(), &wkt);
    raster.crs = PostsCrs{wkt, {400000.0, 30.0, 0.0, 5200000.0, 0.0, -30.0}};
    CPLFree(wkt);
    const std::string path = test::scratch_folder() / "utm.tif";
    ASSERT_TRUE(write_cloud_raster(path, false, raster, 1).ok());
    expect_same_posts(path, raster, GDT_Float32);
    const Dataset file(GDALOpen(path.c_str(), GA_ReadOnly));
    std::array<double, 6> corners{};
    GDALGetGeoTransform(file.get(), corners.data());
    EXPECT_EQ(corners, (std::array<double, 6>{399985.0, 30.0, 0.0, 5200015.0, 0.0, -30.0}));
    EXPECT_STREQ(OSRGetAuthorityCode(GDALGetSpatialRef(file.get()), nullptr), "32632");
}

TEST(CloudRaster, IsTheSameForAnyNumberOfThreads) {
    const PostRaster raster = raster_of_posts(1100, 1100, false);
    const std::filesystem::path folder = test::scratch_folder();
    const std::string one = folder / "1.tif", five = folder / "5.tif";
    ASSERT_TRUE(write_cloud_raster(one, false, raster, 1).ok());
    ASSERT_TRUE(write_cloud_raster(five, false, raster, 5).ok());
    EXPECT_TRUE(file_bytes(one) == file_bytes(five));
    EXPECT_FALSE(write_cloud_raster(one, false, raster, 1).ok()) << "it is there already";
}

}  // namespace
}  // namespace oro
