#include "core/growth/cleared_tiles.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/earth/ellipsoid.h"
#include "core/growth/tree_sites.h"

namespace oro {
namespace {

constexpr std::int64_t longest = 64;  // tiles

std::uint64_t key_of(std::uint32_t row, std::uint32_t column) {
    return std::uint64_t{row} << 32U | column;
}

// Degrees from the least to the greatest; longitudes from that of the first corner, in the turn around it.
struct PlaceBox {
    double south_deg, north_deg, west_deg, east_deg;
};
PlaceBox box_of(std::span<const glm::dvec3> corners) {
    const Geodetic first = geodetic_from_ecef(Ecef{corners[0]});
    PlaceBox box{first.lat_deg, first.lat_deg, first.lon_deg, first.lon_deg};
    for (const glm::dvec3& corner : corners.subspan(1)) {
        const Geodetic place = geodetic_from_ecef(Ecef{corner});
        const double lon_deg = first.lon_deg + std::remainder(place.lon_deg - first.lon_deg, 360.0);
        box.south_deg = std::min(box.south_deg, place.lat_deg);
        box.north_deg = std::max(box.north_deg, place.lat_deg);
        box.west_deg = std::min(box.west_deg, lon_deg);
        box.east_deg = std::max(box.east_deg, lon_deg);
    }
    return box;
}

void add_row(std::uint32_t row, const PlaceBox& box, std::vector<std::uint64_t>& tiles) {
    const std::int64_t count = site_tile_columns(row);
    const auto column_at = [&](double lon_deg) {
        return static_cast<std::int64_t>(std::floor((lon_deg + 180.0) / 360.0 * static_cast<double>(count)));
    };
    const std::int64_t first = column_at(box.west_deg), last = column_at(box.east_deg);
    if (last - first > longest) return;
    for (std::int64_t column = first; column <= last; ++column)
        tiles.push_back(key_of(row, static_cast<std::uint32_t>((column % count + count) % count)));
}

}  // namespace

ClearedTiles::ClearedTiles(std::span<const glm::dvec3> corners) {
    assert(corners.size() % 3 == 0);
    const auto row_at = [](double lat_deg) {
        return std::clamp<std::int64_t>(site_tile_row_at(lat_deg), 0, gpu::site_tile_rows - 1);
    };
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        const PlaceBox box = box_of(corners.subspan(i, 3));
        const std::int64_t south = row_at(box.south_deg), north = row_at(box.north_deg);
        if (north - south > longest) continue;
        for (std::int64_t row = south; row <= north; ++row)
            add_row(static_cast<std::uint32_t>(row), box, tiles_);
    }
    std::ranges::sort(tiles_);
    const auto rest = std::ranges::unique(tiles_);
    tiles_.erase(rest.begin(), rest.end());
}

bool ClearedTiles::contains(std::uint32_t row, std::uint32_t column) const {
    return std::ranges::binary_search(tiles_, key_of(row, column));
}

}  // namespace oro
