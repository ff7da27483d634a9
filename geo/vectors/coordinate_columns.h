// Which columns of a table say where its places are, by the headings of its first line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oro {

// A heading in small letters, without a # before it and a unit in brackets behind it, its words parted by
// single blanks: "#Lat_(deg)" is "lat".
std::string plain_heading(std::string_view heading);

// The columns of latitudes and of longitudes in degrees: lat, latitude, lon, lng, longitude ... Each is known
// whether or not the other one is there. The first of these names that a table has counts.
struct DegreeColumns {
    std::optional<std::size_t> lat, lon;
};
DegreeColumns degree_columns(const std::vector<std::string>& headings);

// The column of heights over the ground in metres, for what stands on it: above, above ground, height above
// ground, agl, mast height, eye height, height ... The first of these names that a table has counts. Brackets
// must hold a unit of metres: "Height (ft)" and "Height (m a.s.l.)" are none. Only for tables of things that
// stand on the ground: of others height is mostly the one above the sea.
std::optional<std::size_t> above_ground_column(const std::vector<std::string>& headings);

struct CoordinateColumns {
    enum class Kind { none, degrees, plane, wkt };
    Kind kind{Kind::none};
    std::optional<std::size_t> x, y;  // longitude and latitude of Kind::degrees; of Kind::wkt both its column
    std::optional<std::size_t> height, crs;

    [[nodiscard]] bool has(std::size_t column) const { return column == x || column == y; }
};
// Degrees come before well-known text, and that before x and y.
CoordinateColumns coordinate_columns(const std::vector<std::string>& headings);

}  // namespace oro
