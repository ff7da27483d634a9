// Every format that is trusted, cut at many places: the heights of the whole file, an error, or a note; never
// other heights without a word.
#include <cpl_string.h>
#include <gdal.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;
namespace fs = std::filesystem;

struct Format {
    const char* driver;
    const char* file;
    std::vector<std::string> options;
    GDALDataType type{GDT_Int16};
};

void PrintTo(const Format& format, std::ostream* out) {
    *out << format.driver;
    for (const std::string& option : format.options) *out << " " << option;
}

constexpr int side = 121;

double hilly(int row, int column) {
    return 1000.0 + 7.0 * row + 3.0 * column + (row * 37 + column * 101) % 29;
}

Dataset in_memory(GDALDataType type) {
    Dataset memory(GDALCreate(GDALGetDriverByName("MEM"), "", side, side, 1, type, nullptr));
    std::array<double, 6> corners = posts_from(8.0, 47.0, 120.0);
    GDALSetGeoTransform(memory.get(), corners.data());
    const SpatialReference crs = wgs84_degrees();
    GDALSetSpatialRef(memory.get(), crs.get());
    std::vector<double> heights;
    for (int r = 0; r < side; ++r) {
        for (int c = 0; c < side; ++c) heights.push_back(hilly(r, c));
    }
    EXPECT_EQ(GDALRasterIO(GDALGetRasterBand(memory.get(), 1), GF_Write, 0, 0, side, side, heights.data(),
                           side, side, GDT_Float64, 0, 0),
              CE_None);
    return memory;
}

// The raster and what a driver writes beside it.
bool write(const Format& format, const fs::path& file) {
    const Dataset memory = in_memory(format.type);
    CPLStringList options;
    for (const std::string& option : format.options) options.AddString(option.c_str());
    const Dataset copy(GDALCreateCopy(GDALGetDriverByName(format.driver), file.c_str(), memory.get(), FALSE,
                                      options.List(), nullptr, nullptr));
    return copy != nullptr;
}

std::string content_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

// 60 places over the whole file, and each of the last bytes.
std::set<std::size_t> cuts_of(std::size_t size) {
    std::set<std::size_t> cuts;
    for (std::size_t i = 0; i < 60; ++i) cuts.insert(size * i / 60);
    for (std::size_t i = 1; i <= std::min<std::size_t>(12, size); ++i) cuts.insert(size - i);
    return cuts;
}

// True when a region is told apart from the whole one: by failing, by a note, or not at all because it is the
// same.
bool is_no_lie(const Result<RegionGrid>& region, const RegionGrid& whole) {
    if (!region.ok() || region->notes != whole.notes) return true;
    const PostGrid &grid = region->field.grid, &of_whole = whole.field.grid;
    return grid.north_deg() == of_whole.north_deg() && grid.west_deg() == of_whole.west_deg() &&
           grid.rows() == of_whole.rows() && grid.columns() == of_whole.columns() &&
           region->field.H_m == whole.field.H_m;
}

void expect_no_lies(const fs::path& folder, const fs::path& raster) {
    std::string reason;
    const auto whole = opened(request_for({raster.string()}), &reason);
    ASSERT_TRUE(whole) << reason;
    EXPECT_NEAR(static_cast<double>(whole->field.H_at_post_m(60, 60)), hilly(60, 60), 1.0);
    int reported = 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const fs::path file = entry.path();
        const std::string content = content_of(file);
        for (const std::size_t cut : cuts_of(content.size())) {
            std::ofstream(file, std::ios::binary) << content.substr(0, cut);
            const auto region = test::open_grid(request_for({raster.string()}));
            reported += !region.ok();
            EXPECT_TRUE(is_no_lie(region, *whole))
                << file.filename() << " of " << content.size() << " bytes, cut at " << cut;
        }
        std::ofstream(file, std::ios::binary) << content;
    }
    EXPECT_GT(reported, 40);
    EXPECT_TRUE(is_no_lie(test::open_grid(request_for({raster.string()})), *whole));
}

class TrustedFormats : public testing::TestWithParam<Format> {};

TEST_P(TrustedFormats, TellWhenTheyAreCut) {
    start_gdal();
    const fs::path folder = scratch_folder();
    if (GDALGetDriverByName(GetParam().driver) == nullptr) GTEST_SKIP() << "this GDAL has no such driver";
    ASSERT_TRUE(write(GetParam(), folder / GetParam().file));
    expect_no_lies(folder, folder / GetParam().file);
}

INSTANTIATE_TEST_SUITE_P(
    All, TrustedFormats,
    testing::Values(
        Format{"GTiff", "a.tif", {}}, Format{"GTiff", "a.tif", {"TFW=YES", "PROFILE=BASELINE"}},
        Format{"GTiff", "a.tif", {"TILED=YES", "BLOCKXSIZE=32", "BLOCKYSIZE=32", "COMPRESS=DEFLATE"}},
        Format{"GTiff", "a.tif", {"COMPRESS=LZW", "PREDICTOR=2"}},
        Format{"GTiff", "a.tif", {"COMPRESS=ZSTD"}, GDT_Float32},
        Format{"GTiff", "a.tif", {"COMPRESS=LERC"}, GDT_Float32},
        Format{"GTiff", "a.tif", {"COMPRESS=PACKBITS", "BIGTIFF=YES"}},
        Format{"JP2OpenJPEG", "a.jp2", {"REVERSIBLE=YES", "QUALITY=100"}}, Format{"DTED", "a.dt0", {}},
        Format{"USGSDEM", "a.dem", {}}, Format{"HFA", "a.img", {}},
        Format{"HFA", "a.img", {"COMPRESSED=YES"}}, Format{"AAIGrid", "a.asc", {}},
        Format{"AAIGrid", "a.asc", {}, GDT_Float32}, Format{"BT", "a.bt", {}},
        Format{"GSAG", "a.grd", {}, GDT_Float32}, Format{"GSBG", "a.grd", {}, GDT_Float32},
        Format{"GS7BG", "a.grd", {}, GDT_Float32}));

// A mask beside a GeoTIFF, and sources of a VRT.
TEST(TrustedFormat, MasksAndSourcesTellWhenTheyAreCut) {
    start_gdal();
    const fs::path folder = scratch_folder();
    ASSERT_TRUE(write({"GTiff", "a.tif", {}}, folder / "a.tif"));
    {
        // GDAL from 3.9 on would write it into the GeoTIFF.
        CPLSetThreadLocalConfigOption("GDAL_TIFF_INTERNAL_MASK", "NO");
        const Dataset dataset(GDALOpen((folder / "a.tif").c_str(), GA_Update));
        ASSERT_EQ(GDALCreateDatasetMaskBand(dataset.get(), GMF_PER_DATASET), CE_None);
        std::vector<unsigned char> valid(side * side, 255);
        std::fill_n(valid.begin(), 40 * side, static_cast<unsigned char>(0));
        ASSERT_EQ(GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(dataset.get(), 1)), GF_Write, 0, 0, side,
                               side, valid.data(), side, side, GDT_Byte, 0, 0),
                  CE_None);
    }
    ASSERT_TRUE(fs::exists(folder / "a.tif.msk"));
    const auto masked = opened(request_for({(folder / "a.tif").string()}));
    ASSERT_TRUE(masked);
    EXPECT_EQ(masked->voids, 40U * side);
    expect_no_lies(folder, folder / "a.tif");
    fs::remove(folder / "a.tif.msk");
    ASSERT_TRUE(write({"VRT", "b.vrt", {}}, folder / "c.vrt"));
    const Dataset dataset(GDALOpen((folder / "a.tif").c_str(), GA_ReadOnly));
    const Dataset vrt(GDALCreateCopy(GDALGetDriverByName("VRT"), (folder / "b.vrt").c_str(), dataset.get(),
                                     FALSE, nullptr, nullptr, nullptr));
    GDALFlushCache(vrt.get());
    fs::remove(folder / "c.vrt");
    expect_no_lies(folder, folder / "b.vrt");
}

// Formats whose reading is silent about what is missing are not read, whatever their names say.
TEST(TrustedFormat, OthersAreRefused) {
    const fs::path folder = scratch_folder();
    // A netCDF of the classic kind, an ENVI raster and an EHdr one, as far as their drivers ask.
    write_bytes((folder / "a.nc").string(), {'C', 'D', 'F', 1, 0, 0, 0, 0});
    std::ofstream(folder / "b.hdr")
        << "ENVI\nsamples = 4\nlines = 4\nbands = 1\ndata type = 2\ninterleave = bsq\n";
    std::ofstream(folder / "b.img") << std::string(32, '\1');
    std::ofstream(folder / "c.hdr") << "NROWS 4\nNCOLS 4\nNBITS 16\nULXMAP 8\nULYMAP 47\nXDIM 1\nYDIM 1\n";
    std::ofstream(folder / "c.bil") << std::string(32, '\1');
    for (const char* name : {"a.nc", "b.img", "c.bil"}) {
        const auto region = test::open_grid(request_for({(folder / name).string()}));
        ASSERT_FALSE(region.ok()) << name;
        EXPECT_NE(region.error().line().find("accepted format"), std::string::npos) << region.error().line();
    }
    std::ofstream(folder / "raw.vrt")
        << "<VRTDataset rasterXSize=\"4\" rasterYSize=\"4\"><SRS>EPSG:4326</SRS><GeoTransform>8, 0.1, 0, 47, "
           "0, "
           "-0.1</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\" subClass=\"VRTRawRasterBand\">"
           "<SourceFilename relativeToVRT=\"1\">c.bil</SourceFilename></VRTRasterBand></VRTDataset>";
    const auto raw = test::open_grid(request_for({(folder / "raw.vrt").string()}));
    ASSERT_FALSE(raw.ok());
    EXPECT_NE(raw.error().line().find("raw bytes"), std::string::npos) << raw.error().line();
}

}  // namespace
}  // namespace oro
