#include "geo/vectors/coordinate_columns.h"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "geo/files/letter_case.h"

namespace oro {
namespace {

std::vector<std::string> plain_headings(const std::vector<std::string>& headings) {
    std::vector<std::string> names;
    names.reserve(headings.size());
    for (const std::string& heading : headings) names.push_back(plain_heading(heading));
    return names;
}

// The column of the first of these names that a table has.
std::optional<std::size_t> column_of(const std::vector<std::string>& names,
                                     std::initializer_list<const char*> known) {
    for (const char* const name : known) {
        const auto at = std::ranges::find(names, std::string_view(name));
        if (at != names.end()) return static_cast<std::size_t>(at - names.begin());
    }
    return std::nullopt;
}

DegreeColumns degree_columns_of(const std::vector<std::string>& names) {
    return {column_of(names, {"lat", "latitude", "lat deg", "latitude deg", "decimallatitude", "lat wgs84",
                              "gps latitude", "wgs84 lat"}),
            column_of(names, {"lon", "lng", "long", "longitude", "lon deg", "longitude deg",
                              "decimallongitude", "lon wgs84", "gps longitude", "wgs84 lon"})};
}

// Whether what a heading has in brackets, where it has some, says metres over the ground.
bool is_in_metres(const std::string& heading) {
    const std::size_t open = heading.find_first_of("([");
    if (open == std::string::npos) return true;
    std::string unit = lower_case(heading.substr(open + 1, heading.find_first_of(")]", open) - open - 1));
    std::erase_if(unit, [](char c) { return c == '.' || c == '_'; });
    constexpr std::array known{"m", "metre", "metres", "meter", "meters", "agl", "m agl", "m above ground"};
    return std::ranges::any_of(known, [&](const char* name) { return unit == name; });
}

}  // namespace

std::string plain_heading(std::string_view heading) {
    if (heading.starts_with('#')) heading.remove_prefix(1);
    std::string plain;
    for (const char c : lower_case(heading.substr(0, heading.find_first_of("([")))) {
        const bool is_blank = c == ' ' || c == '_' || c == '-' || c == '.' || c == '\t';
        if (!is_blank) plain += c;
        if (is_blank && !plain.empty() && plain.back() != ' ') plain += ' ';
    }
    while (!plain.empty() && plain.back() == ' ') plain.pop_back();
    return plain;
}

DegreeColumns degree_columns(const std::vector<std::string>& headings) {
    return degree_columns_of(plain_headings(headings));
}

std::optional<std::size_t> above_ground_column(const std::vector<std::string>& headings) {
    std::vector<std::string> names = plain_headings(headings);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i].ends_with(" m")) names[i].erase(names[i].size() - 2);
        if (!is_in_metres(headings[i])) names[i].clear();
    }
    return column_of(names, {"above", "above ground", "height above ground", "height agl", "agl",
                             "mast height", "eye height", "eye", "eyes", "height"});
}

CoordinateColumns coordinate_columns(const std::vector<std::string>& headings) {
    const std::vector<std::string> names = plain_headings(headings);
    CoordinateColumns columns;
    columns.height = column_of(names, {"ele", "elevation", "alt", "altitude", "z", "point z"});
    columns.crs = column_of(names, {"crs", "epsg", "srid", "srs"});
    const auto wkt = column_of(names, {"wkt", "geometry", "geom", "the geom", "wkt geom"});
    const DegreeColumns degrees = degree_columns_of(names);
    const auto x = column_of(names, {"x", "e", "easting", "east", "xcoord", "x coord", "coord x", "point x"}),
               y = column_of(names,
                             {"y", "n", "northing", "north", "ycoord", "y coord", "coord y", "point y"});
    if (degrees.lat && degrees.lon)
        columns.kind = CoordinateColumns::Kind::degrees, columns.x = degrees.lon, columns.y = degrees.lat;
    else if (wkt)
        columns.kind = CoordinateColumns::Kind::wkt, columns.x = columns.y = wkt;
    else if (x && y)
        columns.kind = CoordinateColumns::Kind::plane, columns.x = x, columns.y = y;
    return columns;
}

}  // namespace oro
