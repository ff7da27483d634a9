#include "geo/web_maps/quantized_tiles.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <system_error>

#include "core/base/parallel.h"
#include "geo/files/plain_file.h"
#include "geo/web_maps/each_web_tile.h"
#include "geo/web_maps/random_places.h"

namespace oro {
namespace {
namespace fs = std::filesystem;

constexpr int tile_corners = quantized_quads + 1;

std::vector<const PostGrid*> grids_under(const TrueGround& ground) {
    std::vector<const PostGrid*> grids;
    for (std::size_t i = 0; i < ground.grids(); ++i) grids.push_back(&ground.surface(i).field().grid);
    return grids;
}

// The ground's h at a corner of a tile's quads; has_ground tells whether it has any.
double corner_h_m(const TrueGround& ground, const GeographicTile& tile, int row, int column, double hole_H_m,
                  bool& has_ground) {
    const PostPlace south_west = south_west_of(tile);
    const double side_deg = geographic_tile_deg(tile.zoom);
    const double lat_deg = south_west.lat_deg + side_deg * quantized_corner(row) / quantized_steps;
    const double lon_deg = south_west.lon_deg + side_deg * quantized_corner(column) / quantized_steps;
    const std::optional<double> h_m = ground.h_m(lat_deg, lon_deg);
    has_ground = h_m.has_value();
    return h_m ? *h_m : hole_H_m + ground.N_m(lat_deg, lon_deg);
}

struct CornerHeights {
    TileHeights h_m;
    std::uint64_t holes{};
};
CornerHeights corner_heights(const TrueGround& ground, const GeographicTile& tile, double hole_H_m) {
    CornerHeights heights;
    heights.h_m.reserve(std::size_t{tile_corners} * tile_corners);
    for (int row = 0; row < tile_corners; ++row) {
        for (int column = 0; column < tile_corners; ++column) {
            bool has_ground = false;
            heights.h_m.push_back(corner_h_m(ground, tile, row, column, hole_H_m, has_ground));
            heights.holes += has_ground ? 0 : 1;
        }
    }
    return heights;
}

std::string column_folder(const std::string& folder, const GeographicTile& tile) {
    return folder + "/" + std::to_string(tile.zoom) + "/" + std::to_string(tile.x);
}

// Where a zoom's triangles put the ground at a place; nothing where a corner of the quad has none.
std::optional<double> encoded_h_m(const TrueGround& ground, const QuantizedTiles& tiles, int zoom,
                                  const PostPlace& place) {
    const PlaceInTile at = place_in_tile(zoom, place.lat_deg, place.lon_deg);
    const auto written = std::ranges::lower_bound(tiles.tiles, at.tile, {}, &QuantizedTile::tile);
    if (written == tiles.tiles.end() || written->tile != at.tile) return std::nullopt;
    const auto quad_of = [](double share) {
        int quad = std::clamp(static_cast<int>(share * quantized_quads), 0, quantized_quads - 1);
        const double step = share * quantized_steps;
        while (quad > 0 && quantized_corner(quad) > step) --quad;
        while (quad < quantized_quads - 1 && quantized_corner(quad + 1) <= step) ++quad;
        const double first = quantized_corner(quad);
        return std::pair(quad, (step - first) / (quantized_corner(quad + 1) - first));
    };
    const auto [column, right] = quad_of(at.right);
    const auto [row, up] = quad_of(at.up);
    std::array<double, 4> h_m{};
    for (int corner = 0; corner < 4; ++corner) {
        bool has_ground = false;
        const double is_m =
            corner_h_m(ground, at.tile, row + corner / 2, column + corner % 2, 0.0, has_ground);
        if (!has_ground) return std::nullopt;
        h_m[static_cast<std::size_t>(corner)] =
            height_of_quantized_m(quantized_height(is_m, written->steps), written->steps);
    }
    const auto& [south_west, south_east, north_west, north_east] = h_m;
    return right >= up ? south_west + right * (south_east - south_west) + up * (north_east - south_east)
                       : south_west + up * (north_west - south_west) + right * (north_east - north_west);
}

ZoomError error_of(const TrueGround& ground, const QuantizedTiles& tiles, int zoom, int places) {
    constexpr int tries_a_place = 20;
    ZoomError error{zoom, 0, 0.0, 0.0};
    const auto grids = grids_under(ground);
    RandomShares random(static_cast<std::uint64_t>(zoom));
    double squares_m2 = 0.0;
    for (int i = 0; i < tries_a_place * places && error.places < static_cast<std::uint64_t>(places); ++i) {
        const PostPlace place = random_place(grids, random);
        const std::optional<double> is_m = ground.h_m(place.lat_deg, place.lon_deg);
        const std::optional<double> has_m = is_m ? encoded_h_m(ground, tiles, zoom, place) : std::nullopt;
        if (!has_m) continue;
        ++error.places;
        error.largest_m = std::max(error.largest_m, std::abs(*has_m - *is_m));
        squares_m2 += (*has_m - *is_m) * (*has_m - *is_m);
    }
    if (error.places > 0) error.rms_m = std::sqrt(squares_m2 / static_cast<double>(error.places));
    return error;
}

std::vector<GeographicTile> tiles_to_try(const TrueGround& ground, int zoom) {
    if (zoom == 0) return {{0, 0, 0}, {0, 1, 0}};
    return geographic_tiles(zoom, grids_under(ground));
}

// Of a tile without ground nothing is made but where it is wanted even so.
KeptWebTile quantized_tile(const TrueGround& ground, const GeographicTile& tile,
                           const QuantizedTilesRequest& request, bool without_ground_too) {
    const CornerHeights heights = corner_heights(ground, tile, request.hole_H_m);
    KeptWebTile made;
    made.has_ground = heights.holes < heights.h_m.size();
    made.holes = heights.holes;
    if (!made.has_ground && !without_ground_too) return made;
    made.steps = height_steps_of(heights.h_m);
    made.bytes = quantized_mesh_bytes(tile, heights.h_m);
    return made;
}

Result<KeptWebTile> tile_of(const TrueGround& ground, const GeographicTile& tile,
                            const QuantizedTilesRequest& request) {
    return kept_or_made(request.share.kept, ground, tile,
                        [&] { return Result<KeptWebTile>(quantized_tile(ground, tile, request, false)); });
}

// Writes the tiles of one zoom after another, the finest first.
class QuantizedTilesWriter {
  public:
    QuantizedTilesWriter(const std::string& folder, const TrueGround& ground,
                         const QuantizedTilesRequest& request)
        : folder_(folder), ground_(ground), request_(request) {}

    Result<void> write_zoom(int zoom);
    // What was written, sorted.
    QuantizedTiles take() {
        std::ranges::sort(written_.tiles, {}, &QuantizedTile::tile);
        return std::move(written_);
    }

  private:
    void write_tile_of(const GeographicTile& tile);
    [[nodiscard]] bool has_child(const GeographicTile& tile) const;

    const std::string& folder_;
    const TrueGround& ground_;
    const QuantizedTilesRequest& request_;
    QuantizedTiles written_;
    std::vector<GeographicTile> finer_;  // of the zoom before, sorted
    std::mutex mutex_;
    Result<void> fault_;
};

bool QuantizedTilesWriter::has_child(const GeographicTile& tile) const {
    for (int i = 0; i < 4; ++i)
        if (std::ranges::binary_search(finer_,
                                       GeographicTile{tile.zoom + 1, 2 * tile.x + i % 2, 2 * tile.y + i / 2}))
            return true;
    return false;
}

void QuantizedTilesWriter::write_tile_of(const GeographicTile& tile) {
    Result<KeptWebTile> kept = tile_of(ground_, tile, request_);
    const bool has_ground = kept.ok() && kept->has_ground;
    if (kept.ok() && !has_ground && tile.zoom > 0 && !has_child(tile)) return;
    Result<void> done;
    if (!kept.ok()) done = kept.error();
    if (kept.ok() && !has_ground) kept = quantized_tile(ground_, tile, request_, true);
    if (kept.ok())
        done = write_plain_file(column_folder(folder_, tile) + "/" + std::to_string(tile.y) + ".terrain",
                                kept->bytes);
    const std::scoped_lock lock(mutex_);
    if (!done.ok() && fault_.ok()) fault_ = done;
    if (!kept.ok()) return;
    written_.tiles.push_back({tile, kept->steps, has_ground});
    written_.bytes += kept->bytes.size();
    written_.hole_corners += has_ground ? kept->holes : 0;
}

Result<void> QuantizedTilesWriter::write_zoom(int zoom) {
    const std::vector<GeographicTile> tiles = tiles_to_try(ground_, zoom);
    std::error_code failed;
    for (const GeographicTile& tile : tiles)
        if (fs::create_directories(column_folder(folder_, tile), failed); failed)
            return Error{ErrorKind::failed, column_folder(folder_, tile),
                         "cannot be made: " + failed.message()};
    in_parallel(static_cast<int>(tiles.size()), request_.threads, [&](int i) {
        const bool go_on = [&] {
            const std::scoped_lock lock(mutex_);
            return fault_.ok();
        }();
        if (go_on) write_tile_of(tiles[static_cast<std::size_t>(i)]);
    });
    ORO_CHECK(fault_);
    finer_.clear();
    for (const QuantizedTile& one : written_.tiles)
        if (one.tile.zoom == zoom) finer_.push_back(one.tile);
    std::ranges::sort(finer_);
    // Of folders that hold something rmdir does nothing.
    for (const GeographicTile& tile : tiles) fs::remove(column_folder(folder_, tile), failed);
    fs::remove(folder_ + "/" + std::to_string(zoom), failed);
    return {};
}

}  // namespace

std::vector<QuantizedTiles::Rectangle> QuantizedTiles::rectangles(int zoom) const {
    std::vector<Rectangle> columns;  // runs of one column each
    for (const QuantizedTile& one : tiles) {
        if (one.tile.zoom != zoom) continue;
        if (!columns.empty() && columns.back().last_x == one.tile.x &&
            columns.back().last_y + 1 == one.tile.y)
            columns.back().last_y = one.tile.y;
        else
            columns.push_back({one.tile.x, one.tile.y, one.tile.x, one.tile.y});
    }
    std::vector<Rectangle> joined;
    for (const Rectangle& column : columns) {
        const auto wider = std::ranges::find_if(joined, [&](const Rectangle& one) {
            return one.last_x + 1 == column.first_x && one.first_y == column.first_y &&
                   one.last_y == column.last_y;
        });
        if (wider != joined.end())
            wider->last_x = column.last_x;
        else
            joined.push_back(column);
    }
    return joined;
}

Result<QuantizedTiles> write_quantized_tiles(const std::string& folder, const TrueGround& ground,
                                             const QuantizedTilesRequest& request,
                                             const TilesProgress& progress) {
    QuantizedTilesWriter writer(folder, ground, request);
    double done = 0.0, all = 0.0;
    for (int zoom = 0; zoom <= request.highest_zoom; ++zoom) all += std::ldexp(1.0, 2 * zoom);
    for (int zoom = request.highest_zoom; zoom >= 0; --zoom) {
        ORO_CHECK(writer.write_zoom(zoom));
        if (progress) progress((done += std::ldexp(1.0, 2 * zoom)) / all);
    }
    QuantizedTiles written = writer.take();
    ORO_CHECK(ground.health());
    if (std::ranges::none_of(written.tiles, &QuantizedTile::has_ground))
        return Error{ErrorKind::no_data, "--to quantized-mesh", "no corner of these tiles has ground"};
    return written;
}

Result<std::uint64_t> keep_quantized_tiles(const TrueGround& ground, const QuantizedTilesRequest& request,
                                           const TilesProgress& progress) {
    std::vector<GeographicTile> own;
    std::size_t number = 0;
    for (int zoom = 0; zoom <= request.highest_zoom; ++zoom)
        for (const GeographicTile& tile : tiles_to_try(ground, zoom))
            if (request.share.holds(number++)) own.push_back(tile);
    ORO_CHECK(each_web_tile(ground, own.size(), request.threads, progress,
                            [&](std::size_t number_of_own) -> Result<void> {
                                ORO_TRY(const KeptWebTile one, tile_of(ground, own[number_of_own], request));
                                return {};
                            }));
    return std::uint64_t{own.size()};
}

Result<std::vector<ZoomError>> quantized_tiles_error(const TrueGround& ground, const QuantizedTiles& tiles,
                                                     const QuantizedTilesRequest& request, int places) {
    std::vector<ZoomError> errors(static_cast<std::size_t>(request.highest_zoom + 1));
    in_parallel(static_cast<int>(errors.size()), request.threads,
                [&](int i) { errors[static_cast<std::size_t>(i)] = error_of(ground, tiles, i, places); });
    ORO_CHECK(ground.health());
    return errors;
}

}  // namespace oro
