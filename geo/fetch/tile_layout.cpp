#include "geo/fetch/tile_layout.h"

#include <cmath>
#include <string_view>

#include "geo/fetch/places_source.h"

namespace oro {
namespace {

constexpr std::string_view latitude_field = "{latitude}", longitude_field = "{longitude}";

std::string with_fields(std::string text, const TileName& tile) {
    const std::string name = tile_name(tile.lat_deg, tile.lon_deg);  // N46E008
    const auto put = [&](std::string_view field, const std::string& value) {
        for (std::size_t at = text.find(field); at != std::string::npos; at = text.find(field, at))
            text.replace(at, field.size(), value);
    };
    put(latitude_field, name.substr(0, 3));
    put(longitude_field, name.substr(3));
    return text;
}

bool has_fields(const std::string& text) {
    return text.find(latitude_field) != std::string::npos && text.find(longitude_field) != std::string::npos;
}

int floor_to(double value_deg, int side_deg) {
    return static_cast<int>(std::floor(value_deg / side_deg)) * side_deg;
}

// Of the last tile that begins before a side of the box.
int last_before(double value_deg, int side_deg) {
    return (static_cast<int>(std::ceil(value_deg / side_deg)) - 1) * side_deg;
}

}  // namespace

std::string fault_of(const TileLayout& layout) {
    if (const std::string fault = fault_of_address(layout.url); !fault.empty()) return fault;
    if (!has_fields(layout.url) || !has_fields(layout.file))
        return "'url' and 'file' must have {latitude} and {longitude}";
    if (layout.file.find('/') != std::string::npos || layout.file.starts_with('.'))
        return "'file' must be the name of a file, without folders";
    if (layout.side_deg < 1 || 180 % layout.side_deg != 0) return "'side_deg' must divide 180";
    return "";
}

Result<std::vector<TileName>> tiles_in(const BoundingBox& box, const TileLayout& layout, std::size_t most) {
    const int side = layout.side_deg;
    const double east_deg = box.west_deg > box.east_deg ? box.east_deg + 360.0 : box.east_deg;
    const int north = last_before(box.north_deg, side), south = floor_to(box.south_deg, side);
    const int west = floor_to(box.west_deg, side), east = last_before(east_deg, side);
    std::vector<TileName> tiles;
    for (int lat = north; lat >= south; lat -= side)
        for (int lon = west; lon <= east; lon += side) {
            if (tiles.size() == most)
                return Error{ErrorKind::usage, bounding_box_text(box),
                             "holds more than " + std::to_string(most) + " tiles of " + layout.name +
                                 ": name a smaller box"};
            tiles.push_back({lat, lon >= 180 ? lon - 360 : lon});
        }
    return tiles;
}

std::string url_of(const TileLayout& layout, const TileName& tile) {
    return with_fields(layout.url, tile);
}

std::string file_of(const TileLayout& layout, const TileName& tile) {
    return with_fields(layout.file, tile);
}

}  // namespace oro
