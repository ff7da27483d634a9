// The tiles of globes in degrees (EPSG:4326): two at zoom 0, z/x/y with y from the south, as TMS has it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/terrain/post_grid.h"

namespace oro {

struct GeographicTile {
    int zoom{};
    std::int64_t x{},
        y{};  // 0 .. 2^(zoom + 1) - 1 eastwards from 180 W, 0 .. 2^zoom - 1 northwards from 90 S
    auto operator<=>(const GeographicTile&) const = default;
};

// Degrees that a tile is wide and high.
double geographic_tile_deg(int zoom);
// South-western corner. Both are exact.
PostPlace south_west_of(const GeographicTile& tile);
// The tile that a place is in, and where in it: shares of its width and height, 0 .. 1. Longitudes in any
// turn; on the border of tiles it is the eastern and northern one.
struct PlaceInTile {
    GeographicTile tile;
    double right{}, up{};
};
PlaceInTile place_in_tile(int zoom, double lat_deg, double lon_deg);

// All tiles of a zoom that the boxes of some grids touch, each once, from west to east and south to north.
std::vector<GeographicTile> geographic_tiles(int zoom, std::span<const PostGrid* const> grids);
// No fewer than geographic_tiles() gives, without making them.
double most_geographic_tiles(int zoom, std::span<const PostGrid* const> grids);

// The first zoom whose tiles, so many quads a side, have quads no larger than posts are apart, in the finest
// grid; 0 to most_geographic_zoom.
inline constexpr int most_geographic_zoom = 22;
int geographic_zoom(std::span<const PostGrid* const> grids, int quads);

}  // namespace oro
