#include "geo/fetch/terrarium_tile.h"

#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/files_read.h"
#include "core/base/parallel.h"
#include "geo/fetch/tile_content.h"
#include "geo/files/raster_library.h"
#include "geo/files/whole_file.h"
#include "geo/pixels/picture_rows.h"
#include "geo/web_maps/mercator_tiles.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t side_px = mercator_tile_px;
// Half the side of the square map of EPSG:3857: the semi-major axis of WGS84 times pi.
constexpr double half_map_m = 6378137.0 * std::numbers::pi;
// A gigabyte of heights.
constexpr std::int64_t most_pictures = 4096;
constexpr double most_offset_m = 0.001;

// GDAL's transform of the pictures of a tile, from pixels to EPSG:3857.
std::array<double, 6> transform_of(const PictureBlock& block) {
    const double pixel_m = 2.0 * half_map_m / static_cast<double>(mercator_side_px(block.zoom));
    return {static_cast<double>(block.west * mercator_tile_px) * pixel_m - half_map_m,  pixel_m, 0.0,
            half_map_m - static_cast<double>(block.north * mercator_tile_px) * pixel_m, 0.0,     -pixel_m};
}

Result<void> read_rows(const std::string& file, std::span<float> heights_m, std::size_t width_px,
                       std::size_t first) {
    ORO_TRY(const auto rows, open_picture_rows(file, mercator_tile_px, mercator_tile_px));
    if (rows->is_lossy()) return Error{ErrorKind::failed, file, "is a JPEG, and no PNG"};
    std::vector<std::uint8_t> rgb(side_px * 3);
    for (std::size_t row = 0; row < side_px; ++row) {
        ORO_CHECK(rows->read_row(rgb));
        if (heights_m.empty()) continue;
        for (std::size_t column = 0; column < side_px; ++column)
            heights_m[first + row * width_px + column] = static_cast<float>(
                H_of_terrarium_m({rgb[3 * column], rgb[3 * column + 1], rgb[3 * column + 2]}));
    }
    return {};
}

// Heights of a picture, into the raster of all; the top left pixel is `first`. The file is none of the
// user's: that it goes again is no change of what was read.
Result<void> read_picture(const std::string& file, std::span<float> heights_m, std::size_t width_px,
                          std::size_t first) {
    const Result<void> read = read_rows(file, heights_m, width_px, first);
    forget_file_read(file);
    return read;
}

// Its fault is said of `shown`.
Result<void> check_picture(const std::string& file, const std::string& shown) {
    const Result<void> read = read_picture(file, {}, 0, 0);
    if (read.ok()) return {};
    return Error{ErrorKind::failed, shown, "is no picture of 256 x 256 heights: " + read.error().what};
}

std::string url_of_picture(std::string url, int zoom, std::int64_t x, std::int64_t y) {
    for (const auto& [field, value] :
         {std::pair<std::string_view, std::int64_t>{"{z}", zoom}, {"{x}", x}, {"{y}", y}})
        for (std::size_t at = url.find(field); at != std::string::npos; at = url.find(field, at))
            url.replace(at, field.size(), std::to_string(value));
    return url;
}

// The pictures of a tile on their way.
struct Pictures {
    const TileLayout& layout;
    PictureBlock block;
    fs::path folder;
    FetchLimits limits;

    [[nodiscard]] int count() const { return static_cast<int>(block.columns * block.rows); }
    [[nodiscard]] std::string file(int number) const {
        return (folder / (std::to_string(number) + ".png")).string();
    }
    // Of picture `number`, row by row from the north-west. False: the server has none.
    [[nodiscard]] Result<bool> fetch(int number, int& requests) const {
        const std::int64_t side = std::int64_t{1} << block.zoom;
        const std::string url =
            url_of_picture(layout.url, block.zoom, (block.west + number % block.columns) % side,
                           block.north + number / block.columns);
        const auto check = [&](const std::string& part) { return check_picture(part, url); };
        std::error_code unread;
        if (fs::exists(file(number), unread)) {
            if (check(file(number)).ok()) return true;
            fs::remove(file(number), unread);
        }
        ORO_TRY(const FetchedFile fetched, fetch_file(url, file(number), limits, check));
        requests += fetched.requests;
        return fetched.is_there;
    }
};

struct CloseCrs {
    void operator()(void* crs) const { OSRDestroySpatialReference(static_cast<OGRSpatialReferenceH>(crs)); }
};

Result<void> write_heights(const std::string& path, const PictureBlock& block, const std::string& attribution,
                           std::vector<float>& heights_m) {
    start_gdal();
    ORO_TRY(WholeFile file, WholeFile::create(path, false));
    // By its descriptor: it has no name yet.
    const std::string nameless = "/proc/self/fd/" + std::to_string(fileno(file.stream()));
    const GdalMessages messages;
    CPLStringList options;
    for (const char* option : {"COMPRESS=DEFLATE", "ZLEVEL=6", "PREDICTOR=3", "TILED=YES"})
        options.AddString(option);
    const int width_px = static_cast<int>(block.columns) * mercator_tile_px;
    const int height_px = static_cast<int>(block.rows) * mercator_tile_px;
    Dataset dataset(GDALCreate(GDALGetDriverByName("GTiff"), nameless.c_str(), width_px, height_px, 1,
                               GDT_Float32, options.List()));
    std::array<double, 6> transform = transform_of(block);
    const std::unique_ptr<void, CloseCrs> crs(OSRNewSpatialReference(nullptr));
    const bool is_written =
        dataset && OSRImportFromEPSG(static_cast<OGRSpatialReferenceH>(crs.get()), 3857) == OGRERR_NONE &&
        GDALSetSpatialRef(dataset.get(), static_cast<OGRSpatialReferenceH>(crs.get())) == CE_None &&
        GDALSetGeoTransform(dataset.get(), transform.data()) == CE_None &&
        GDALSetMetadataItem(dataset.get(), "TIFFTAG_COPYRIGHT", attribution.c_str(), nullptr) == CE_None &&
        GDALSetRasterNoDataValue(GDALGetRasterBand(dataset.get(), 1),
                                 std::numeric_limits<double>::quiet_NaN()) == CE_None &&
        GDALRasterIO(GDALGetRasterBand(dataset.get(), 1), GF_Write, 0, 0, width_px, height_px,
                     heights_m.data(), width_px, height_px, GDT_Float32, 0, 0) == CE_None;
    dataset.reset();
    if (!is_written || !messages.last("").empty())
        return Error{ErrorKind::failed, path, "cannot be written: " + messages.last("GDAL says no more")};
    return file.commit();
}

}  // namespace

double H_of_terrarium_m(const std::array<std::uint8_t, 3>& rgb) {
    return rgb[0] * 256.0 + rgb[1] + rgb[2] / 256.0 - 32768.0;
}

PictureBlock pictures_of(const TileLayout& layout, const TileName& tile) {
    const auto corner = [&](double lat_deg, double lon_deg) {
        return mercator_pixel(layout.zoom, std::clamp(lat_deg, -mercator_limit_deg, mercator_limit_deg),
                              lon_deg);
    };
    // A rim that is one of pictures touches no more.
    constexpr double rim_px = 1e-6;
    const MercatorPixel north_west = corner(tile.lat_deg + layout.side_deg, tile.lon_deg);
    const MercatorPixel south_east = corner(tile.lat_deg, tile.lon_deg + layout.side_deg);
    const auto number = [](double at_px) {
        return static_cast<std::int64_t>(std::floor(at_px / mercator_tile_px));
    };
    const std::int64_t last = (std::int64_t{1} << layout.zoom) - 1;
    PictureBlock block{layout.zoom, number(north_west.x_px + rim_px), number(north_west.y_px + rim_px), 0, 0};
    block.north = std::clamp(block.north, std::int64_t{0}, last);
    block.columns = number(south_east.x_px - rim_px) - block.west + 1;
    block.rows = std::clamp(number(south_east.y_px - rim_px), std::int64_t{0}, last) - block.north + 1;
    return block;
}

Result<FetchedFile> fetch_terrarium_tile(const TileLayout& layout, const TileName& tile,
                                         const std::string& path, const FetchLimits& limits, int jobs) {
    if (const PictureBlock block = pictures_of(layout, tile); block.columns * block.rows > most_pictures)
        return Error{ErrorKind::failed, file_of(layout, tile),
                     "has " + std::to_string(block.columns * block.rows) + " pictures at zoom " +
                         std::to_string(block.zoom) + ", and at most " + std::to_string(most_pictures) +
                         " are put together: take a smaller zoom"};
    // Whoever has it works on the tile; it stays empty.
    ORO_TRY(PartFile turn, PartFile::open(path, limits.share_wait_s));
    if (const auto meanwhile = fetched_meanwhile(path, turn, limits)) return *meanwhile;
    const Pictures pictures{layout, pictures_of(layout, tile), path + ".parts", limits};
    std::error_code fault;
    fs::create_directories(pictures.folder, fault);
    if (fault)
        return Error{ErrorKind::failed, pictures.folder.string(), "cannot be made: " + fault.message()};
    const auto count = static_cast<std::size_t>(pictures.count());
    std::vector<int> requests(count);
    std::vector<char> is_there(count);
    std::mutex mutex;
    std::optional<Error> first_error;
    std::atomic<bool> failed{false};
    in_parallel(pictures.count(), jobs, [&](int number) {
        if (failed) return;
        const auto at = static_cast<std::size_t>(number);
        const Result<bool> fetched = pictures.fetch(number, requests[at]);
        if (fetched.ok()) {
            is_there[at] = *fetched ? 1 : 0;
            return;
        }
        const std::lock_guard lock(mutex);
        if (!failed.exchange(true)) first_error = fetched.error();
    });
    if (first_error) return *first_error;
    FetchedFile all;
    for (const int one : requests) all.requests += one;
    all.is_there = std::ranges::any_of(is_there, [](char one) { return one != 0; });
    if (all.is_there) {
        const std::size_t width_px = static_cast<std::size_t>(pictures.block.columns) * side_px;
        std::vector<float> heights_m(count * side_px * side_px, std::numeric_limits<float>::quiet_NaN());
        for (std::size_t at = 0; at < count; ++at) {
            const std::size_t columns = static_cast<std::size_t>(pictures.block.columns);
            const std::size_t first = at / columns * side_px * width_px + at % columns * side_px;
            if (is_there[at] != 0)
                ORO_CHECK(read_picture(pictures.file(static_cast<int>(at)), heights_m, width_px, first));
        }
        ORO_CHECK(write_heights(path, pictures.block, layout.attribution, heights_m));
        all.bytes = fs::file_size(path, fault);
    }
    fs::remove_all(pictures.folder, fault);
    turn.discard();
    return all;
}

Result<void> check_terrarium_tile(const std::string& file, const std::string& shown, const TileLayout& layout,
                                  const TileName& tile) {
    const PictureBlock block = pictures_of(layout, tile);
    const std::array<double, 6> wanted = transform_of(block);
    return check_elevation_raster(file, shown, file_of(layout, tile), [&](GDALDatasetH dataset) {
        std::array<double, 6> place{};
        if (GDALGetGeoTransform(dataset, place.data()) != CE_None) return false;
        for (std::size_t i = 0; i < place.size(); ++i)
            if (!(std::abs(place[i] - wanted[i]) <= most_offset_m)) return false;
        return GDALGetRasterXSize(dataset) == block.columns * mercator_tile_px &&
               GDALGetRasterYSize(dataset) == block.rows * mercator_tile_px;
    });
}

}  // namespace oro
