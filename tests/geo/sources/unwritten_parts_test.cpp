#include "geo/sources/unwritten_parts.h"

#include <gtest/gtest.h>

#include <cpl_string.h>

#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

constexpr std::array<double, 6> mosaic_corners{500000.0, 100.0, 0.0, 5000000.0, 0.0, -100.0};

Raster flat_utm(int rows, int columns) {
    Raster raster;
    raster.rows = rows;
    raster.columns = columns;
    raster.crs = "EPSG:32632";
    raster.cell_corners = mosaic_corners;
    return raster;
}

std::string source_element(const std::string& name, int columns, int column) {
    const std::string size = "xSize=\"" + std::to_string(columns) + "\" ySize=\"30\"";
    return "<SimpleSource><SourceFilename relativeToVRT=\"1\">" + name +
           "</SourceFilename><SourceBand>1</SourceBand><SrcRect xOff=\"0\" yOff=\"0\" " + size +
           "/><DstRect xOff=\"" + std::to_string(column) + "\" yOff=\"0\" " + size + "/></SimpleSource>";
}

std::string write_mosaic(const fs::path& file, int columns, const std::string& band) {
    std::ofstream(file)
        << "<VRTDataset rasterXSize=\"" << columns
        << "\" rasterYSize=\"30\"><SRS>EPSG:32632</SRS><GeoTransform>500000,100,0,5000000,0,-100"
           "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\">"
        << band << "</VRTRasterBand></VRTDataset>";
    return file.string();
}

// A TIFF of 64 x 64 tiles of which only the first is ever written: 700 m.
std::string write_sparse(const fs::path& file, std::optional<double> no_data) {
    start_gdal();
    CPLStringList options;
    for (const char* option : {"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=64", "SPARSE_OK=TRUE"})
        options.AddString(option);
    const GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), 160, 128, 1, GDT_Int16, options.List());
    std::array<double, 6> cells = mosaic_corners;
    GDALSetGeoTransform(dataset, cells.data());
    const OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
    OSRSetFromUserInput(crs, "EPSG:32632");
    GDALSetSpatialRef(dataset, crs);
    OSRDestroySpatialReference(crs);
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    if (no_data) GDALSetRasterNoDataValue(band, *no_data);
    std::vector<double> tile(64 * 64, 700.0);
    EXPECT_EQ(GDALRasterIO(band, GF_Write, 0, 0, 64, 64, tile.data(), 64, 64, GDT_Float64, 0, 0), CE_None);
    GDALClose(dataset);
    return file.string();
}

std::size_t gap_notes(const RegionGrid& region, const std::string& count) {
    std::size_t found = 0;
    for (const std::string& note : region.notes)
        found += note.find(": " + count + " posts have no data: they lie in gaps") != std::string::npos;
    return found;
}

TEST(UnwrittenParts, AGapOfAMosaicIsNoGroundAtSeaLevel) {
    const fs::path folder = scratch_folder();
    write_raster(folder / "a.tif", flat_utm(30, 30), [](int, int) { return 700.0; });
    write_raster(folder / "b.tif", flat_utm(30, 30), [](int, int) { return 800.0; });
    const std::string mosaic = write_mosaic(folder / "gap.vrt", 90,
                                            source_element("a.tif", 30, 0) + source_element("b.tif", 30, 60));
    const std::string of_mosaic = write_mosaic(
        folder / "outer.vrt", 120, source_element("gap.vrt", 90, 0) + source_element("a.tif", 30, 90));
    for (const std::string& file : {mosaic, of_mosaic}) {
        std::string reason;
        const auto region = opened(request_for({file}), &reason);
        ASSERT_TRUE(region) << reason;
        EXPECT_EQ(region->voids, 900U) << file;
        EXPECT_EQ(height_range(region->field).lowest_m, 700.0F) << file;
        EXPECT_TRUE(is_void(region->field.H_at_post_m(15, 30)) && is_void(region->field.H_at_post_m(15, 59)));
        EXPECT_EQ(region->field.H_at_post_m(15, 29), 700.0F);
        EXPECT_EQ(region->field.H_at_post_m(15, 60), 800.0F);
        EXPECT_EQ(gap_notes(*region, "900"), 1U) << file;
    }
}

// Three sources with two gaps between them, of which GDAL itself loses count; and ground at 0 m stays.
TEST(UnwrittenParts, SeveralGapsAndGroundAtSeaLevel) {
    const fs::path folder = scratch_folder();
    write_raster(folder / "sea.tif", flat_utm(30, 20), [](int, int c) { return c; });
    const auto region = opened(
        request_for({write_mosaic(folder / "gaps.vrt", 100,
                                  source_element("sea.tif", 20, 0) + source_element("sea.tif", 20, 40) +
                                      source_element("sea.tif", 20, 80))}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 1200U);
    EXPECT_EQ(region->field.H_at_post_m(3, 40), 0.0F);
    // A no-data value fills them.
    const auto declared = opened(
        request_for({write_mosaic(folder / "declared.vrt", 100,
                                  "<NoDataValue>-9999</NoDataValue>" + source_element("sea.tif", 20, 0) +
                                      source_element("sea.tif", 20, 80))}));
    ASSERT_TRUE(declared);
    EXPECT_EQ(declared->voids, 1800U);
    EXPECT_TRUE(declared->notes.empty());
}

// A part that leaves its own no-data value out leaves 0 there: columns 10 to 19 of 30.
TEST(UnwrittenParts, NoDataOfAPartIsNoGround) {
    const fs::path folder = scratch_folder();
    Raster raster = flat_utm(30, 30);
    write_raster(folder / "a.tif", raster, [](int, int c) { return c >= 10 && c < 20 ? -9999.0 : 20.0; });
    const std::string size = "xSize=\"30\" ySize=\"30\"";
    const std::string part =
        "<ComplexSource><SourceFilename relativeToVRT=\"1\">a.tif</SourceFilename><SourceBand>1</SourceBand>"
        "<SrcRect xOff=\"0\" yOff=\"0\" " +
        size + "/><DstRect xOff=\"0\" yOff=\"0\" " + size + "/><NODATA>-9999</NODATA></ComplexSource>";
    const auto region = opened(request_for({write_mosaic(folder / "none.vrt", 30, part)}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 300U);
    EXPECT_EQ(height_range(region->field).lowest_m, 20.0F);
    EXPECT_EQ(gap_notes(*region, "300"), 1U);
}

TEST(UnwrittenParts, BlocksThatWereNeverWrittenHaveNoData) {
    const fs::path folder = scratch_folder();
    const auto region = opened(request_for({write_sparse(folder / "sparse.tif", std::nullopt)}));
    ASSERT_TRUE(region);
    EXPECT_EQ(region->voids, 160U * 128U - 64U * 64U);
    EXPECT_EQ(height_range(region->field).lowest_m, 700.0F);
    EXPECT_EQ(gap_notes(*region, "16384"), 1U);
    const auto declared = opened(request_for({write_sparse(folder / "declared.tif", -32768.0)}));
    ASSERT_TRUE(declared);
    EXPECT_EQ(declared->voids, 160U * 128U - 64U * 64U);
    EXPECT_TRUE(declared->notes.empty());
    // In a mosaic, too: 30 of its rows.
    const auto mosaic = opened(
        request_for({write_mosaic(folder / "of_sparse.vrt", 160, source_element("sparse.tif", 160, 0))}));
    ASSERT_TRUE(mosaic);
    EXPECT_EQ(mosaic->voids, 30U * 96U);
}

}  // namespace
}  // namespace oro
