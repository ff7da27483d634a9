#include "geo/places/bounding_box.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace oro {
namespace {

// The text as it can stand in one line.
std::string in_one_line(std::string_view text) {
    std::string result = "'";
    for (const char c : text) result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    return result + "'";
}

Error usage(const std::string& text, const std::string& what) {
    return Error{ErrorKind::usage, "bounding box " + in_one_line(text), what};
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

bool parse_number(std::string_view text, double& number) {
    text = trimmed(text);
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), number);
    return fault == std::errc{} && end == text.data() + text.size() && !text.empty();
}

Result<std::array<double, 4>> four_numbers(const std::string& text) {
    std::array<double, 4> numbers{};
    std::string_view rest = text;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t comma = rest.find(',');
        if ((comma == std::string_view::npos) != (i == 3))
            return usage(text, "needs four numbers in degrees: west,south,east,north");
        const std::string_view part = rest.substr(0, comma);
        if (!parse_number(part, numbers[i]))
            return usage(text, in_one_line(trimmed(part)) + " is no number; needs west,south,east,north");
        if (!std::isfinite(numbers[i])) return usage(text, in_one_line(trimmed(part)) + " is not a finite number");
        rest = i == 3 ? std::string_view{} : rest.substr(comma + 1);
    }
    return numbers;
}

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

// Digits only, all of them.
std::optional<int> whole_number(std::string_view digits) {
    int number = 0;
    for (const char c : digits) {
        if (c < '0' || c > '9') return std::nullopt;
        number = number * 10 + (c - '0');
    }
    return number;
}

}  // namespace

std::string tile_name(int lat_deg, int lon_deg) {
    std::array<char, 32> name{};
    std::snprintf(name.data(), name.size(), "%c%02d%c%03d", lat_deg < 0 ? 'S' : 'N', std::abs(lat_deg),
                  lon_deg < 0 ? 'W' : 'E', std::abs(lon_deg));
    return name.data();
}

std::optional<TileName> parse_tile_name(std::string_view text) {
    if (text.size() != 7) return std::nullopt;
    const char north = lower(text[0]);
    const char east = lower(text[3]);
    const auto lat = whole_number(text.substr(1, 2));
    const auto lon = whole_number(text.substr(4, 3));
    if (!lat || !lon || (north != 'n' && north != 's') || (east != 'e' && east != 'w')) return std::nullopt;
    const TileName tile{north == 's' ? -*lat : *lat, east == 'w' ? -*lon : *lon};
    if (tile.lat_deg < -90 || tile.lat_deg > 89 || tile.lon_deg < -180 || tile.lon_deg > 179)
        return std::nullopt;
    return tile;
}

std::string bounding_box_text(const BoundingBox& box) {
    std::string text;
    for (const double angle : {box.west_deg, box.south_deg, box.east_deg, box.north_deg}) {
        std::string number = std::to_string(angle);
        number.erase(number.find_last_not_of('0') + 1);
        if (number.ends_with('.')) number.pop_back();
        text += (text.empty() ? "" : ",") + number;
    }
    return text;
}

std::optional<BoundingBox> with_latitude_first(const BoundingBox& box) {
    const BoundingBox other{box.south_deg, box.west_deg, box.north_deg, box.east_deg};
    const auto within = [](double angle, double most) { return std::abs(angle) <= most; };
    if (!within(other.south_deg, 90.0) || !within(other.north_deg, 90.0) || !within(other.west_deg, 180.0) ||
        !within(other.east_deg, 180.0) || !(other.south_deg < other.north_deg) ||
        other.west_deg == other.east_deg)
        return std::nullopt;
    return other;
}

Result<BoundingBox> parse_bounding_box(const std::string& text) {
    ORO_TRY(const auto numbers, four_numbers(text));
    const BoundingBox box{numbers[0], numbers[1], numbers[2], numbers[3]};
    for (const double lat_deg : {box.south_deg, box.north_deg}) {
        if (std::abs(lat_deg) <= 90.0) continue;
        const auto swapped = with_latitude_first(box);
        return usage(
            text,
            "a latitude is beyond 90 degrees; the order is west,south,east,north" +
                (swapped ? ": longitude comes first, " + bounding_box_text(*swapped) + " may be meant" : ""));
    }
    for (const double lon_deg : {box.west_deg, box.east_deg}) {
        if (std::abs(lon_deg) > 180.0)
            return usage(text,
                         "a longitude is beyond 180 degrees; a box over the antimeridian has west > east");
    }
    if (box.south_deg >= box.north_deg)
        return usage(text, "south must lie below north; the order is west,south,east,north");
    const double width_deg = box.east_deg - box.west_deg;
    if (width_deg == 0.0 || width_deg == -360.0) return usage(text, "the box has no width");
    return box;
}

Result<BoundingBox> parse_tile_range(const std::string& text) {
    const auto fault = [&](const std::string& what) {
        return Error{ErrorKind::usage, "tile " + in_one_line(text), what};
    };
    const std::size_t colon = text.find(':');
    const auto first = parse_tile_name(std::string_view(text).substr(0, colon));
    const auto last =
        colon == std::string::npos ? first : parse_tile_name(std::string_view(text).substr(colon + 1));
    if (!first || !last)
        return fault("is no tile name such as N46E008, nor a range of them such as N46E006:N47E010");
    double west = first->lon_deg;
    double east = last->lon_deg;
    // Corners may come in any order; only a range of more than half a turn means the short way over the
    // antimeridian.
    if (west > east && west - east < 180.0) std::swap(west, east);
    const double east_edge = east + 1.0;
    return BoundingBox{west, std::min<double>(first->lat_deg, last->lat_deg),
                       west > east && east_edge > 180.0 ? east_edge - 360.0 : east_edge,
                       std::max<double>(first->lat_deg, last->lat_deg) + 1.0};
}

}  // namespace oro
