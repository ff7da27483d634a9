#include "geo/sources/elevation_band.h"

#include <gtest/gtest.h>

#include <cpl_string.h>

#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

using ValueOfBand = std::function<double(int band, int row, int column)>;

// Cells of 100 m in UTM zone 32.
void place_on_utm(GDALDatasetH dataset) {
    std::array<double, 6> corners{500000.0, 100.0, 0.0, 5000000.0, 0.0, -100.0};
    GDALSetGeoTransform(dataset, corners.data());
    const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(crs, "EPSG:32632");
    GDALSetSpatialRef(dataset, crs);
    OSRDestroySpatialReference(crs);
}

// 40 x 40 cells of several bands.
std::string write_bands(const fs::path& file, int bands, GDALDataType type, const ValueOfBand& value,
                        const std::vector<std::string>& names = {}) {
    start_gdal();
    const GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), 40, 40, bands, type, nullptr);
    place_on_utm(dataset);
    for (int b = 1; b <= bands; ++b) {
        const GDALRasterBandH band = GDALGetRasterBand(dataset, b);
        if (!names.empty()) GDALSetDescription(band, names[static_cast<std::size_t>(b - 1)].c_str());
        std::vector<double> values;
        for (int r = 0; r < 40; ++r)
            for (int c = 0; c < 40; ++c) values.push_back(value(b, r, c));
        EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, 40, 40, values.data(), 40, 40, GDT_Float64, 0, 0),
                  CE_None);
    }
    GDALClose(dataset);
    return file.string();
}

double height_m(int row, int column) {
    return 700.5 + row + 2 * column;
}

TEST(ElevationBand, IsTakenBesideMasksAndCodes) {
    const fs::path folder = scratch_folder();
    struct Case {
        const char* name;
        int heights;
        ValueOfBand value;
        std::vector<std::string> names;
    };
    const std::vector<Case> cases{
        {"mask", 1, [](int b, int r, int c) { return b == 1 ? height_m(r, c) : r % 2; }, {}},
        {"mask255", 1, [](int b, int r, int c) { return b == 1 ? height_m(r, c) : 255.0 * (c % 2); }, {}},
        {"mask_first", 2, [](int b, int r, int c) { return b == 2 ? height_m(r, c) : 1.0; }, {}},
        {"codes", 1, [](int b, int r, int c) { return b == 1 ? height_m(r, c) : (r + c) % 7; }, {}},
        {"plain", 1, [](int b, int r, int) { return b == 1 ? 3.0 + r % 4 : 1.0; }, {}},
        {"named",
         2,
         [](int b, int r, int c) { return b == 2 ? height_m(r, c) : 0.37 * c + r; },
         {"error", "Elevation (m)"}}};
    for (const Case& one : cases) {
        const auto file =
            write_bands(folder / (std::string(one.name) + ".tif"), 2, GDT_Float32, one.value, one.names);
        std::string reason;
        const auto region = opened(request_for({file}), &reason);
        ASSERT_TRUE(region) << one.name << ": " << reason;
        EXPECT_EQ(region->field.H_at_post_m(7, 9), static_cast<float>(one.value(one.heights, 7, 9)))
            << one.name;
        ASSERT_EQ(region->notes.size(), 1U) << one.name;
        EXPECT_NE(
            region->notes[0].find("has 2 bands; heights are taken from band " + std::to_string(one.heights)),
            std::string::npos)
            << region->notes[0];
    }
}

TEST(ElevationBand, IsNotGuessedAmongSeveral) {
    const fs::path folder = scratch_folder();
    const auto two = test::open_grid(request_for({write_bands(
        folder / "two.tif", 2, GDT_Float32, [](int b, int r, int c) { return b * height_m(r, c); })}));
    ASSERT_FALSE(two.ok());
    EXPECT_NE(two.error().line().find("has 2 bands, and nothing tells which of them holds heights"),
              std::string::npos)
        << two.error().line();
    EXPECT_NE(two.error().line().find("gdal_translate -b N"), std::string::npos);
    const auto image = test::open_grid(request_for({write_bands(
        folder / "rgb.tif", 3, GDT_Byte, [](int b, int r, int c) { return (b * r + c) % 256; })}));
    ASSERT_FALSE(image.ok());
    EXPECT_NE(image.error().line().find("has 3 bands: an image"), std::string::npos) << image.error().line();
}

// -5 m in a byte, as GDAL before 3.7 writes it, and in what is made of that file.
TEST(ElevationBand, SignedBytesAreNegative) {
    const fs::path folder = scratch_folder();
    start_gdal();
    const fs::path file = folder / "int8.tif";
#if GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 7, 0)
    write_bands(file, 1, GDT_Int8, [](int, int r, int) { return r < 20 ? -5.0 : 100.0; });
#else
    CPLStringList options;
    options.AddString("PIXELTYPE=SIGNEDBYTE");
    const GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), 40, 40, 1, GDT_Byte, options.List());
    place_on_utm(dataset);
    std::vector<unsigned char> values(40 * 40, 251);
    std::fill(values.begin() + 20 * 40, values.end(), static_cast<unsigned char>(100));
    EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(dataset, 1), GF_Write, 0, 0, 40, 40, values.data(), 40, 40,
                           GDT_Byte, 0, 0),
              CE_None);
    GDALClose(dataset);
#endif
    std::ofstream(folder / "int8.vrt")
        << "<VRTDataset rasterXSize=\"40\" "
           "rasterYSize=\"40\"><SRS>EPSG:32632</SRS><GeoTransform>500000,100,0,"
           "5000000,0,-100</GeoTransform><VRTRasterBand dataType=\""
        << (GDAL_VERSION_NUM >= GDAL_COMPUTE_VERSION(3, 7, 0) ? "Int8" : "Byte")
        << "\" band=\"1\"><SimpleSource><SourceFilename relativeToVRT=\"1\">int8.tif</SourceFilename>"
           "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
    std::ofstream(folder / "float.vrt")
        << "<VRTDataset rasterXSize=\"40\" "
           "rasterYSize=\"40\"><SRS>EPSG:32632</SRS><GeoTransform>500000,100,0,"
           "5000000,0,-100</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\"><SimpleSource>"
           "<SourceFilename relativeToVRT=\"1\">int8.tif</SourceFilename>"
           "<SourceBand>1</SourceBand></SimpleSource></VRTRasterBand></VRTDataset>";
    for (const char* name : {"int8.tif", "int8.vrt", "float.vrt"}) {
        std::string reason;
        const auto region = opened(request_for({(folder / name).string()}), &reason);
        ASSERT_TRUE(region) << name << ": " << reason;
        EXPECT_EQ(region->field.H_at_post_m(5, 5), -5.0F) << name;
        EXPECT_EQ(region->field.H_at_post_m(30, 5), 100.0F) << name;
    }
}

}  // namespace
}  // namespace oro
