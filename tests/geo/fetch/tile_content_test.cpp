// What is taken for a tile.
#include "geo/fetch/tile_content.h"

#include <gdal.h>
#include <gtest/gtest.h>
#include <ogr_srs_api.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "geo/files/raster_library.h"
#include "tests/support/test_data.h"

namespace {
namespace fs = std::filesystem;
using oro::TileHolds;
using oro::TileLayout;

TileLayout geotiff_layout(TileHolds holds, int side_deg) {
    TileLayout layout;
    layout.file = "{latitude}{longitude}.tif";
    layout.side_deg = side_deg;
    layout.format = oro::TileFormat::geotiff;
    layout.holds = holds;
    return layout;
}

// A GeoTIFF of 64 x 64 pixels in blocks of 16 x 16, from 47 N 8 E to the south-east: pixels over ground, as
// Copernicus DEM's, of a side of side_deg.
fs::path geotiff_file(GDALDataType type, double side_deg) {
    oro::start_gdal();
    const fs::path file = oro::test::scratch_folder() / "tile.part";
    const char* const options[] = {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", nullptr};
    const oro::Dataset dataset(
        GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), 64, 64, 1, type, options));
    double place[]{8.0, side_deg / 64, 0.0, 46.0 + side_deg, 0.0, -side_deg / 64};
    GDALSetGeoTransform(dataset.get(), place);
    GDALSetSpatialRef(dataset.get(), oro::wgs84_degrees().get());
    std::vector<float> heights_m(64 * 64);
    for (std::size_t i = 0; i < heights_m.size(); ++i) heights_m[i] = static_cast<float>(10 + i % 97);
    EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(dataset.get(), 1), GF_Write, 0, 0, 64, 64, heights_m.data(), 64,
                           64, GDT_Float32, 0, 0),
              CE_None);
    return file;
}

std::string fault(const fs::path& file, const TileLayout& layout, int lon_deg = 8) {
    const auto checked = check_tile(file.string(), "tile", layout, {46, lon_deg});
    return checked.ok() ? "" : checked.error().line();
}

TEST(TileContent, GeoTiffOfHeights) {
    const TileLayout heights = geotiff_layout(TileHolds::heights, 1);
    const fs::path file = geotiff_file(GDT_Float32, 1.0);
    EXPECT_EQ(fault(file, heights), "");
    EXPECT_EQ(fault(file, heights, 9), "tile: does not lie at N46E009");
    EXPECT_EQ(fault(file, geotiff_layout(TileHolds::heights, 3)), "tile: does not lie at N46E008");
    // Half a degree of a whole one, as a tile of another product.
    EXPECT_EQ(fault(geotiff_file(GDT_Float32, 0.5), heights), "tile: does not lie at N46E008");
}

TEST(TileContent, GeoTiffOfLandCover) {
    const TileLayout cover = geotiff_layout(TileHolds::land_cover, 3);
    EXPECT_EQ(fault(geotiff_file(GDT_Byte, 3.0), cover), "");
    EXPECT_EQ(fault(geotiff_file(GDT_Float32, 3.0), cover),
              "tile: holds fractions, and no classes or whole metres");
}

// At every 500th byte.
TEST(TileContent, ATruncatedGeoTiffIsNone) {
    const fs::path whole = geotiff_file(GDT_Float32, 1.0);
    const std::uintmax_t bytes = fs::file_size(whole);
    for (std::uintmax_t end = 0; end < bytes; end += 500) {
        const fs::path cut = whole.parent_path() / "cut.part";
        fs::copy_file(whole, cut, fs::copy_options::overwrite_existing);
        fs::resize_file(cut, end);
        EXPECT_NE(fault(cut, geotiff_layout(TileHolds::heights, 1)), "") << end << " of " << bytes;
    }
}

}  // namespace
