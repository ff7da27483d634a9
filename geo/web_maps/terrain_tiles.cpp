#include "geo/web_maps/terrain_tiles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <span>
#include <system_error>

#include "core/base/parallel.h"
#include "geo/files/plain_file.h"
#include "geo/pictures/png_bytes.h"
#include "geo/web_maps/each_web_tile.h"
#include "geo/web_maps/random_places.h"

namespace oro {
namespace fs = std::filesystem;

namespace {

constexpr double lowest_H_m = -10000.0, steps_per_m = 10.0;
constexpr std::int64_t most_steps = 0xFFFFFF;

std::vector<const PostGrid*> grids_of(const TrueGround& ground) {
    std::vector<const PostGrid*> grids;
    for (std::size_t i = 0; i < ground.grids(); ++i) grids.push_back(&ground.surface(i).field().grid);
    return grids;
}

std::string folder_of(const std::string& folder, const MercatorTile& tile) {
    return folder + "/" + std::to_string(tile.zoom) + "/" + std::to_string(tile.x);
}

struct TilePixels {
    std::vector<std::uint8_t> rgb;
    std::uint64_t holes{};
};

TilePixels pixels_of(const TrueGround& ground, const MercatorTile& tile, double hole_H_m) {
    constexpr int side = mercator_tile_px;
    TilePixels pixels;
    pixels.rgb.reserve(std::size_t{3} * side * side);
    const std::array<std::uint8_t, 3> hole = terrain_rgb(hole_H_m);
    const auto centre = [&](int row, int column) {
        return mercator_place(tile.zoom, {static_cast<double>(tile.x * side + column) + 0.5,
                                          static_cast<double>(tile.y * side + row) + 0.5});
    };
    std::array<double, side> lon_deg{};
    for (int column = 0; column < side; ++column)
        lon_deg[static_cast<std::size_t>(column)] = centre(0, column).lon_deg;
    for (int row = 0; row < side; ++row) {
        const double lat_deg = centre(row, 0).lat_deg;
        for (const double column_lon_deg : lon_deg) {
            const std::optional<double> H_m = ground_H_m(ground, lat_deg, column_lon_deg);
            pixels.holes += H_m ? 0 : 1;
            const auto rgb = H_m ? terrain_rgb(*H_m) : hole;
            pixels.rgb.insert(pixels.rgb.end(), rgb.begin(), rgb.end());
        }
    }
    return pixels;
}

Result<KeptWebTile> made_tile(const TrueGround& ground, const MercatorTile& tile, double hole_H_m) {
    const TilePixels pixels = pixels_of(ground, tile, hole_H_m);
    KeptWebTile made;
    made.has_ground = pixels.holes < pixels.rgb.size() / 3;
    made.holes = pixels.holes;
    if (!made.has_ground) return made;
    ORO_TRY(made.bytes, png_bytes(pixels.rgb, mercator_tile_px, mercator_tile_px));
    return made;
}

Result<KeptWebTile> tile_of(const TrueGround& ground, const MercatorTile& tile,
                            const TerrainTilesRequest& request) {
    return kept_or_made(request.share.kept, ground, tile,
                        [&] { return made_tile(ground, tile, request.hole_H_m); });
}

std::vector<MercatorTile> tiles_of(const TrueGround& ground, const ZoomRange& zooms) {
    std::vector<MercatorTile> tiles;
    for (int zoom = zooms.low; zoom <= zooms.high; ++zoom) {
        const auto more = mercator_tiles(zoom, grids_of(ground));
        tiles.insert(tiles.end(), more.begin(), more.end());
    }
    return tiles;
}

// One tile of each column of each zoom, of sorted ones: a column has a folder.
std::vector<MercatorTile> columns_of(std::span<const MercatorTile> tiles) {
    std::vector<MercatorTile> columns;
    std::ranges::unique_copy(
        tiles, std::back_inserter(columns),
        [](const MercatorTile& a, const MercatorTile& b) { return a.zoom == b.zoom && a.x == b.x; });
    return columns;
}

Result<void> make_folders(const std::string& folder, std::span<const MercatorTile> columns) {
    std::error_code failed;
    for (const MercatorTile& column : columns) {
        const std::string path = folder_of(folder, column);
        if (fs::create_directories(path, failed); failed)
            return Error{ErrorKind::failed, path, "cannot be made: " + failed.message()};
    }
    return {};
}

void remove_empty_folders(const std::string& folder, std::span<const MercatorTile> columns) {
    std::error_code ignored;
    // rmdir: of folders that hold something it does nothing.
    for (const MercatorTile& column : columns) fs::remove(folder_of(folder, column), ignored);
    for (const MercatorTile& column : columns)
        fs::remove(folder + "/" + std::to_string(column.zoom), ignored);
}

// Where a zoom's pixels put the ground at a place; nothing where one of the four around it has none.
std::optional<double> encoded_H_m(const TrueGround& ground, int zoom, const PostPlace& place) {
    const MercatorPixel pixel = mercator_pixel(zoom, place.lat_deg, place.lon_deg);
    const double x = std::floor(pixel.x_px - 0.5), y = std::floor(pixel.y_px - 0.5);
    const double right = pixel.x_px - 0.5 - x, down = pixel.y_px - 0.5 - y;
    double H_m = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
        const int column = corner % 2, row = corner / 2;
        const PostPlace centre = mercator_place(zoom, {x + column + 0.5, y + row + 0.5});
        const std::optional<double> at_m = ground_H_m(ground, centre.lat_deg, centre.lon_deg);
        if (!at_m) return std::nullopt;
        H_m += (column == 1 ? right : 1.0 - right) * (row == 1 ? down : 1.0 - down) *
               H_of_terrain_rgb_m(terrain_rgb(*at_m));
    }
    return H_m;
}

ZoomError error_of_zoom(const TrueGround& ground, int zoom, int places) {
    constexpr int tries_a_place = 20;
    ZoomError error{zoom, 0, 0.0, 0.0};
    const auto grids = grids_of(ground);
    double squares_m2 = 0.0;
    RandomShares random(static_cast<std::uint64_t>(zoom));
    for (int i = 0; i < tries_a_place * places && error.places < static_cast<std::uint64_t>(places); ++i) {
        const PostPlace place = random_place(grids, random);
        if (std::abs(place.lat_deg) >= mercator_limit_deg) continue;
        const std::optional<double> is_m = ground_H_m(ground, place.lat_deg, place.lon_deg);
        const std::optional<double> has_m = is_m ? encoded_H_m(ground, zoom, place) : std::nullopt;
        if (!has_m) continue;
        ++error.places;
        error.largest_m = std::max(error.largest_m, std::abs(*has_m - *is_m));
        squares_m2 += (*has_m - *is_m) * (*has_m - *is_m);
    }
    if (error.places > 0) error.rms_m = std::sqrt(squares_m2 / static_cast<double>(error.places));
    return error;
}

}  // namespace

std::array<std::uint8_t, 3> terrain_rgb(double H_m) {
    const double most = static_cast<double>(most_steps);
    const auto steps =
        static_cast<std::uint32_t>(std::clamp(std::round((H_m - lowest_H_m) * steps_per_m), 0.0, most));
    return {static_cast<std::uint8_t>(steps >> 16U), static_cast<std::uint8_t>(steps >> 8U & 0xFFU),
            static_cast<std::uint8_t>(steps & 0xFFU)};
}

double H_of_terrain_rgb_m(const std::array<std::uint8_t, 3>& rgb) {
    return lowest_H_m + static_cast<double>(rgb[0] * 65536 + rgb[1] * 256 + rgb[2]) / steps_per_m;
}

std::optional<double> ground_H_m(const TrueGround& ground, double lat_deg, double lon_deg) {
    const std::optional<double> h_m = ground.h_m(lat_deg, lon_deg);
    if (!h_m) return std::nullopt;
    return *h_m - ground.N_m(lat_deg, lon_deg);
}

Result<TerrainTilesWritten> write_terrain_tiles(const std::string& folder, const TrueGround& ground,
                                                const TerrainTilesRequest& request,
                                                const TilesProgress& progress) {
    const std::vector<MercatorTile> tiles = tiles_of(ground, request.zooms);
    const std::vector<MercatorTile> columns = columns_of(tiles);
    ORO_CHECK(make_folders(folder, columns));
    std::atomic<std::uint64_t> written{0}, bytes{0}, holes{0};
    ORO_CHECK(each_web_tile(
        ground, tiles.size(), request.threads, progress, [&](std::size_t number) -> Result<void> {
            const MercatorTile& tile = tiles[number];
            ORO_TRY(const KeptWebTile one, tile_of(ground, tile, request));
            if (!one.has_ground) return {};
            ++written;
            holes += one.holes;
            bytes += one.bytes.size();
            return write_plain_file(folder_of(folder, tile) + "/" + std::to_string(tile.y) + ".png",
                                    one.bytes);
        }));
    remove_empty_folders(folder, columns);
    return TerrainTilesWritten{written, bytes, holes};
}

Result<std::uint64_t> keep_terrain_tiles(const TrueGround& ground, const TerrainTilesRequest& request,
                                         const TilesProgress& progress) {
    const std::vector<MercatorTile> tiles = tiles_of(ground, request.zooms);
    std::atomic<std::uint64_t> own{0};
    ORO_CHECK(each_web_tile(ground, tiles.size(), request.threads, progress,
                            [&](std::size_t number) -> Result<void> {
                                if (!request.share.holds(number)) return {};
                                ++own;
                                ORO_TRY(const KeptWebTile one, tile_of(ground, tiles[number], request));
                                return {};
                            }));
    return own.load();
}

Result<std::vector<ZoomError>> terrain_tiles_error(const TrueGround& ground, const ZoomRange& zooms,
                                                   int places, int threads) {
    std::vector<ZoomError> errors(static_cast<std::size_t>(zooms.high - zooms.low + 1));
    in_parallel(static_cast<int>(errors.size()), threads, [&](int i) {
        errors[static_cast<std::size_t>(i)] = error_of_zoom(ground, zooms.low + i, places);
    });
    ORO_CHECK(ground.health());
    return errors;
}

}  // namespace oro
