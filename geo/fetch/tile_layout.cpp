#include "geo/fetch/tile_layout.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "geo/fetch/places_source.h"

namespace oro {
namespace {

constexpr std::string_view latitude_field = "{latitude}", longitude_field = "{longitude}",
                           key_field = "{key}";

void put(std::string& text, std::string_view field, const std::string& value) {
    for (std::size_t at = text.find(field); at != std::string::npos; at = text.find(field, at + value.size()))
        text.replace(at, field.size(), value);
}

std::string with_corner(std::string text, const TileName& tile) {
    const std::string name = tile_name(tile.lat_deg, tile.lon_deg);  // N46E008
    put(text, latitude_field, name.substr(0, 3));
    put(text, longitude_field, name.substr(3));
    return text;
}

bool has_all(const std::string& text, std::initializer_list<std::string_view> fields) {
    return std::ranges::all_of(fields,
                               [&](std::string_view field) { return text.find(field) != std::string::npos; });
}

// Where nobody listens on the way.
bool is_encrypted_or_near(const std::string& url) {
    return url.starts_with("https://") || url.starts_with("http://127.0.0.1:") ||
           url.starts_with("http://localhost:");
}

// What tells the addresses of tiles apart.
std::string fault_of_fields(const TileLayout& layout) {
    const bool has_corner = has_all(layout.url, {latitude_field, longitude_field});
    const bool has_sides = has_all(layout.url, {"{south}", "{west}", "{north}", "{east}"});
    if (layout.format == TileFormat::terrarium)
        return has_all(layout.url, {"{z}", "{x}", "{y}"}) ? "" : "'url' must have {z}, {x} and {y}";
    if (!has_corner && !has_sides)
        return "'url' must have {latitude} and {longitude}, or {south}, {west}, {north} and {east}";
    return "";
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
    if (const std::string fault = fault_of_fields(layout); !fault.empty()) return fault;
    if (!has_all(layout.file, {latitude_field, longitude_field}))
        return "'file' must have {latitude} and {longitude}";
    const bool has_key = layout.url.find(key_field) != std::string::npos;
    if (has_key == layout.key_variable.empty())
        return "an address with {key} and 'key_variable' belong together";
    if (has_key && !is_encrypted_or_near(layout.url))
        return "'url' must begin with https://, for it has a key";
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
    std::string url = with_corner(layout.url, tile);
    put(url, "{south}", std::to_string(tile.lat_deg));
    put(url, "{west}", std::to_string(tile.lon_deg));
    put(url, "{north}", std::to_string(tile.lat_deg + layout.side_deg));
    put(url, "{east}", std::to_string(tile.lon_deg + layout.side_deg));
    return url;
}

FetchAddress address_of(const TileLayout& layout, const TileName& tile, const std::string& key) {
    std::string url = url_of(layout, tile);
    if (layout.key_variable.empty()) return {url};
    put(url, key_field, key);
    return {url, key};
}

std::string file_of(const TileLayout& layout, const TileName& tile) {
    return with_corner(layout.file, tile);
}

}  // namespace oro
