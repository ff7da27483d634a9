#include "geo/web_maps/mercator_tiles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace oro {
namespace {

constexpr double pi = std::numbers::pi;

// Where the part of a grid's box that the map has lies in a zoom.
struct PixelBox {
    MercatorPixel north_west, south_east;
};

PixelBox box_of(int zoom, const PostGrid& grid) {
    const auto corner = [&](double lat_deg, double lon_deg) {
        return mercator_pixel(zoom, std::clamp(lat_deg, -mercator_limit_deg, mercator_limit_deg), lon_deg);
    };
    return {corner(grid.north_deg(), grid.west_deg()), corner(grid.south_deg(), grid.east_deg())};
}

// Tiles that a grid's box touches; columns may run past the map's east rim.
struct TileBox {
    std::int64_t first_x{}, last_x{}, first_y{}, last_y{};
};

TileBox tiles_of(int zoom, const PostGrid& grid) {
    const auto [north_west, south_east] = box_of(zoom, grid);
    const auto tile = [](double at_px) {
        return static_cast<std::int64_t>(std::floor(at_px / mercator_tile_px));
    };
    const std::int64_t last = (std::int64_t{1} << zoom) - 1;
    const std::int64_t first_x = tile(north_west.x_px);
    // No more than one turn.
    return {first_x, std::min(tile(south_east.x_px), first_x + last),
            std::clamp(tile(north_west.y_px), std::int64_t{0}, last),
            std::clamp(tile(south_east.y_px), std::int64_t{0}, last)};
}

}  // namespace

MercatorPixel mercator_pixel(int zoom, double lat_deg, double lon_deg) {
    const auto side_px = static_cast<double>(mercator_side_px(zoom));
    const double lat_rad = lat_deg * pi / 180.0;
    return {(lon_deg + 180.0) / 360.0 * side_px,
            (0.5 - std::asinh(std::tan(lat_rad)) / (2.0 * pi)) * side_px};
}

PostPlace mercator_place(int zoom, const MercatorPixel& pixel) {
    const auto side_px = static_cast<double>(mercator_side_px(zoom));
    return {std::atan(std::sinh(pi * (1.0 - 2.0 * pixel.y_px / side_px))) * 180.0 / pi,
            pixel.x_px / side_px * 360.0 - 180.0};
}

std::vector<MercatorTile> mercator_tiles(int zoom, std::span<const PostGrid* const> grids) {
    std::vector<MercatorTile> tiles;
    const std::int64_t side = std::int64_t{1} << zoom;
    for (const PostGrid* const grid : grids) {
        const TileBox box = tiles_of(zoom, *grid);
        for (std::int64_t x = box.first_x; x <= box.last_x; ++x)
            for (std::int64_t y = box.first_y; y <= box.last_y; ++y)
                tiles.push_back({zoom, (x % side + side) % side, y});
    }
    std::ranges::sort(tiles);
    tiles.erase(std::unique(tiles.begin(), tiles.end()), tiles.end());
    return tiles;
}

double most_mercator_tiles(int zoom, std::span<const PostGrid* const> grids) {
    double tiles = 0.0;
    for (const PostGrid* const grid : grids) {
        const TileBox box = tiles_of(zoom, *grid);
        tiles += static_cast<double>(box.last_x - box.first_x + 1) *
                 static_cast<double>(box.last_y - box.first_y + 1);
    }
    return tiles;
}

ZoomRange mercator_zooms(std::span<const PostGrid* const> grids) {
    ZoomRange zooms{most_mercator_zoom, 0};
    for (const PostGrid* const grid : grids) {
        const double middle_deg = std::clamp(0.5 * (grid->north_deg() + grid->south_deg()),
                                             -mercator_limit_deg, mercator_limit_deg);
        // A pixel of zoom z at a latitude is as wide as an angle of 2 pi cos(latitude) / side.
        const double pixels = 2.0 * pi * std::cos(middle_deg * pi / 180.0) / grid->row_step_rad();
        const double needed = std::ceil(std::log2(pixels / mercator_tile_px) - 1.0e-9);
        zooms.high =
            std::max(zooms.high, static_cast<int>(std::clamp(needed, 0.0, double{most_mercator_zoom})));
        const auto [north_west, south_east] = box_of(0, *grid);
        const double share =
            std::max(south_east.x_px - north_west.x_px, south_east.y_px - north_west.y_px) / mercator_tile_px;
        const double fits = std::floor(-std::log2(std::max(share, 1.0e-9)));
        zooms.low = std::min(zooms.low, static_cast<int>(std::clamp(fits, 0.0, double{most_mercator_zoom})));
    }
    zooms.low = std::min(zooms.low, zooms.high);
    return zooms;
}

}  // namespace oro
