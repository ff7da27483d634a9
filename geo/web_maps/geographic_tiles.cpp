#include "geo/web_maps/geographic_tiles.h"

#include <algorithm>
#include <cmath>

#include "core/earth/ellipsoid.h"

namespace oro {
namespace {

// Tiles of a zoom around a grid; x may run beyond the map, in a turn of its own.
struct TouchedTiles {
    std::int64_t first_x{}, last_x{}, first_y{}, last_y{};
};

TouchedTiles touched(int zoom, const PostGrid& grid) {
    const double side_deg = geographic_tile_deg(zoom);
    const std::int64_t last = (std::int64_t{1} << zoom) - 1;
    const auto number = [&](double angle_deg) {
        return static_cast<std::int64_t>(std::floor(angle_deg / side_deg));
    };
    TouchedTiles tiles{number(grid.west_deg() + 180.0), number(grid.east_deg() + 180.0),
                       std::clamp<std::int64_t>(number(grid.south_deg() + 90.0), 0, last),
                       std::clamp<std::int64_t>(number(grid.north_deg() + 90.0), 0, last)};
    tiles.last_x = std::min(tiles.last_x, tiles.first_x + 2 * last + 1);
    return tiles;
}

}  // namespace

double geographic_tile_deg(int zoom) {
    return std::ldexp(180.0, -zoom);
}

PostPlace south_west_of(const GeographicTile& tile) {
    const double side_deg = geographic_tile_deg(tile.zoom);
    return {-90.0 + side_deg * static_cast<double>(tile.y), -180.0 + side_deg * static_cast<double>(tile.x)};
}

PlaceInTile place_in_tile(int zoom, double lat_deg, double lon_deg) {
    const double side_deg = geographic_tile_deg(zoom);
    const std::int64_t wide = std::int64_t{2} << zoom, tall = std::int64_t{1} << zoom;
    const double x = (lon_deg - 360.0 * std::floor((lon_deg + 180.0) / 360.0) + 180.0) / side_deg;
    const double y = (lat_deg + 90.0) / side_deg;
    const auto column = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(x)), 0, wide - 1);
    const auto row = std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(y)), 0, tall - 1);
    return {{zoom, column, row},
            std::clamp(x - static_cast<double>(column), 0.0, 1.0),
            std::clamp(y - static_cast<double>(row), 0.0, 1.0)};
}

std::vector<GeographicTile> geographic_tiles(int zoom, std::span<const PostGrid* const> grids) {
    std::vector<GeographicTile> tiles;
    const std::int64_t wide = std::int64_t{2} << zoom;
    for (const PostGrid* const grid : grids) {
        const TouchedTiles box = touched(zoom, *grid);
        for (std::int64_t x = box.first_x; x <= box.last_x; ++x)
            for (std::int64_t y = box.first_y; y <= box.last_y; ++y)
                tiles.push_back({zoom, (x % wide + wide) % wide, y});
    }
    std::ranges::sort(tiles);
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
    return tiles;
}

double most_geographic_tiles(int zoom, std::span<const PostGrid* const> grids) {
    double tiles = 0.0;
    for (const PostGrid* const grid : grids) {
        const TouchedTiles box = touched(zoom, *grid);
        tiles += static_cast<double>(box.last_x - box.first_x + 1) *
                 static_cast<double>(box.last_y - box.first_y + 1);
    }
    return tiles;
}

int geographic_zoom(std::span<const PostGrid* const> grids, int quads) {
    int zoom = 0;
    for (const PostGrid* const grid : grids) {
        const double post_deg =
            deg_from_radians(Radians{std::min(grid->row_step_rad(), grid->column_step_rad())});
        const double needed = std::ceil(std::log2(180.0 / (post_deg * quads)) - 1.0e-9);
        zoom = std::max(zoom, static_cast<int>(std::clamp(needed, 0.0, double{most_geographic_zoom})));
    }
    return zoom;
}

}  // namespace oro
