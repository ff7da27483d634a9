#include "geo/fetch/tile_content.h"

#include <gdal.h>
#include <zlib.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "core/base/files_read.h"
#include "geo/fetch/terrarium_tile.h"
#include "geo/files/file_begin.h"
#include "geo/files/raster_library.h"
#include "geo/sources/hgt_source.h"
#include "geo/sources/raster_source.h"

namespace oro {
namespace {

constexpr double most_offset_deg = 0.01;
constexpr std::uint64_t most_begin_bytes = 512;

struct CloseGzip {
    void operator()(gzFile_s* file) const { gzclose_r(file); }
};

// ", but a page of the web" and the like, of what servers send instead of files; or "".
std::string instead_words(const std::string& begin) {
    const std::size_t at = begin.find_first_not_of(" \t\r\n");
    if (begin.empty()) return ": it is empty";
    if (at == std::string::npos || begin[at] != '<') return "";
    return begin.compare(at, 5, "<?xml") == 0 ? ": it is an XML text, as servers send with an error"
                                              : ": it is a page of the web";
}

bool is_size_of_hgt(std::uint64_t bytes) {
    return bytes == std::uint64_t{2} * 1201 * 1201 || bytes == std::uint64_t{2} * 3601 * 3601;
}

Result<void> check_hgt_gz(const std::string& file, const std::string& shown) {
    const auto wrong = [&](const std::string& what) { return Error{ErrorKind::failed, shown, what}; };
    const std::string begin = begin_of_file(file, most_begin_bytes);
    if (!begin.starts_with("\x1f\x8b")) return wrong("is no gzip file" + instead_words(begin));
    const std::unique_ptr<gzFile_s, CloseGzip> packed(gzopen(file.c_str(), "rb"));
    if (!packed) return wrong("cannot be read");
    constexpr std::uint64_t most = std::uint64_t{2} * 3601 * 3601;
    std::vector<char> block(std::size_t{1} << 16U);
    std::uint64_t bytes = 0;
    int count = 0;
    while (bytes <= most &&
           (count = gzread(packed.get(), block.data(), static_cast<unsigned>(block.size()))) > 0)
        bytes += static_cast<std::uint64_t>(count);
    int fault = Z_OK;
    gzerror(packed.get(), &fault);
    if (bytes > most) return wrong("unpacks to more than a tile of 3601 x 3601 posts: it is refused");
    if (count < 0 || fault != Z_OK) return wrong("is a damaged or truncated gzip file");
    if (!is_size_of_hgt(bytes))
        return wrong("unpacks to " + std::to_string(bytes) +
                     " bytes; a tile has 2884802 (1201 x 1201 posts) or 25934402 (3601 x 3601 posts)");
    return {};
}

// A number of one of GDAL's items of a TIFF block.
std::optional<std::uint64_t> block_item(GDALRasterBandH band, const char* what, int column, int row) {
    const std::string name = std::string(what) + "_" + std::to_string(column) + "_" + std::to_string(row);
    const char* const text = GDALGetMetadataItem(band, name.c_str(), "TIFF");
    std::uint64_t value = 0;
    if (text == nullptr || std::from_chars(text, text + std::strlen(text), value).ec != std::errc{})
        return std::nullopt;
    return value;
}

// A block that the file leaves out is empty ground, and no fault.
bool has_all_blocks(GDALRasterBandH band, std::uint64_t file_bytes) {
    int width = 0, height = 0;
    GDALGetBlockSize(band, &width, &height);
    const int columns = (GDALGetRasterBandXSize(band) + width - 1) / width;
    const int rows = (GDALGetRasterBandYSize(band) + height - 1) / height;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const auto offset = block_item(band, "BLOCK_OFFSET", column, row);
            const auto size = block_item(band, "BLOCK_SIZE", column, row);
            if (offset && size && (*offset > file_bytes || *size > file_bytes - *offset)) return false;
        }
    return true;
}

bool lies_at(GDALDatasetH dataset, const TileLayout& layout, const TileName& tile) {
    std::array<double, 6> place{};
    if (GDALGetGeoTransform(dataset, place.data()) != CE_None) return false;
    const double east_deg = place[0] + place[1] * GDALGetRasterXSize(dataset);
    const double south_deg = place[3] + place[5] * GDALGetRasterYSize(dataset);
    const auto near = [](double one_deg, int other_deg) {
        return std::abs(one_deg - other_deg) <= most_offset_deg;
    };
    return near(place[0], tile.lon_deg) && near(east_deg, tile.lon_deg + layout.side_deg) &&
           near(south_deg, tile.lat_deg) && near(place[3], tile.lat_deg + layout.side_deg);
}

using IsInPlace = std::function<bool(void* dataset)>;

// One band, all its blocks inside the file; whole numbers where they must be.
Result<void> check_raster(const std::string& file, const std::string& shown, bool must_be_whole,
                          const std::string& place, const IsInPlace& is_in_place) {
    const auto wrong = [&](const std::string& what) { return Error{ErrorKind::failed, shown, what}; };
    start_gdal();
    const GdalMessages messages;
    const char* const driver[] = {"GTiff", nullptr};
    // No files beside it are looked at.
    const char* const siblings[] = {"", nullptr};
    const Dataset dataset(
        GDALOpenEx(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, driver, nullptr, siblings));
    if (!dataset) return wrong("is no GeoTIFF" + instead_words(begin_of_file(file, most_begin_bytes)));
    if (GDALGetRasterCount(dataset.get()) != 1) return wrong("has not one band");
    if (!is_in_place(dataset.get())) return wrong("does not lie at " + place);
    const GDALRasterBandH band = GDALGetRasterBand(dataset.get(), 1);
    std::error_code unread;
    const std::uintmax_t file_bytes = std::filesystem::file_size(file, unread);
    if (unread || !has_all_blocks(band, file_bytes)) return wrong("is truncated");
    if (must_be_whole && GDALDataTypeIsInteger(GDALGetRasterDataType(band)) == 0)
        return wrong("holds fractions, and no classes or whole metres");
    return {};
}

Result<void> check_elevation(const std::string& file, const std::string& shown, const std::string& name) {
    ORO_TRY(const Finding finding, inspect_raster({file, shown, name, "", true, false, 0}, {}));
    if (!finding.source) return finding.unfit;
    return {};
}

Result<void> check_geotiff(const std::string& file, const std::string& shown, const TileLayout& layout,
                           const TileName& tile) {
    const bool are_heights = layout.holds == TileHolds::heights;
    ORO_CHECK(check_raster(file, shown, !are_heights, tile_name(tile.lat_deg, tile.lon_deg),
                           [&](void* dataset) { return lies_at(dataset, layout, tile); }));
    return are_heights ? check_elevation(file, shown, file_of(layout, tile)) : Result<void>{};
}

Result<void> check_content(const std::string& file, const std::string& shown, const TileLayout& layout,
                           const TileName& tile) {
    switch (layout.format) {
        case TileFormat::hgt_gz:
            return check_hgt_gz(file, shown);
        case TileFormat::terrarium:
            return check_terrarium_tile(file, shown, layout, tile);
        case TileFormat::geotiff:
            break;
    }
    return check_geotiff(file, shown, layout, tile);
}

}  // namespace

// What was looked at gets its name only now: that is no change of what a command reads.
Result<void> check_elevation_raster(const std::string& file, const std::string& shown,
                                    const std::string& name, const IsInPlace& is_in_place) {
    Result<void> checked = check_raster(file, shown, false, "the pictures of its tile", is_in_place);
    if (checked.ok()) checked = check_elevation(file, shown, name);
    forget_file_read(file);
    return checked;
}

Result<void> check_tile(const std::string& file, const std::string& shown, const TileLayout& layout,
                        const TileName& tile) {
    const Result<void> checked = check_content(file, shown, layout, tile);
    forget_file_read(file);
    return checked;
}

}  // namespace oro
