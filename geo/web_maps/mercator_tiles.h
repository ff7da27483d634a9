// The tiles of web maps: Web Mercator (EPSG:3857), z/x/y with y from the north, 256 pixels a side.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/terrain/post_grid.h"

namespace oro {

inline constexpr int mercator_tile_px = 256;
// Where the square map ends, north and south. Source: 2 atan(exp(pi)) - pi / 2.
inline constexpr double mercator_limit_deg = 85.051128779806604;

struct MercatorTile {
    int zoom{};
    std::int64_t x{}, y{};  // 0 .. 2^zoom - 1, eastwards from 180 W and southwards from the limit
    auto operator<=>(const MercatorTile&) const = default;
};

// Pixels of a whole zoom along one side.
constexpr std::int64_t mercator_side_px(int zoom) {
    return std::int64_t{mercator_tile_px} << zoom;
}

// Where a place lies in a zoom, in pixels from the map's north-west corner: pixel (0, 0) has its centre at
// (0.5, 0.5). Latitudes of -90 to 90, exclusive; longitudes in any turn.
struct MercatorPixel {
    double x_px{}, y_px{};
};
MercatorPixel mercator_pixel(int zoom, double lat_deg, double lon_deg);
// The way back. Longitudes of -180 to 180 where x_px lies in the map.
PostPlace mercator_place(int zoom, const MercatorPixel& pixel);

// All tiles of a zoom that the boxes of some grids touch, each once, from west to east and north to south.
std::vector<MercatorTile> mercator_tiles(int zoom, std::span<const PostGrid* const> grids);
// No fewer than mercator_tiles() gives, without making them.
double most_mercator_tiles(int zoom, std::span<const PostGrid* const> grids);

// Zooms from the one in which all grids fit into about one tile to the first whose pixels are, in the middle
// of the finest grid, no larger than its posts are apart; 0 to most_mercator_zoom.
inline constexpr int most_mercator_zoom = 22;
struct ZoomRange {
    int low{}, high{};
};
ZoomRange mercator_zooms(std::span<const PostGrid* const> grids);

}  // namespace oro
