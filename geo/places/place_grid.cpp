// Places on grids: UTM, UPS, MGRS and geohash, with GeographicLib.
#include <GeographicLib/Geohash.hpp>
#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <regex>

#include "geo/places/place_text.h"

namespace oro::place_text {
namespace {
using GeographicLib::MGRS;
using GeographicLib::UTMUPS;

constexpr const char* bands = "CDEFGHJKLMNPQRSTUVWX";  // 8 degrees each from 80 S; X reaches 84 N
constexpr int longest_geohash = 18;                    // what GeographicLib looks at: about a micrometre

struct Band {
    double south_deg;
    double north_deg;
};

Band band_of(char letter) {
    const auto index = static_cast<double>(std::string(bands).find(letter));
    return {-80 + 8 * index, letter == 'X' ? 84 : -72 + 8 * index};
}

std::string upper(std::string text) {
    for (char& c : text)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    return text;
}

struct GridZone {
    int number{};        // 0: UPS
    std::string letter;  // one capital, or NORTH, SOUTH
};

std::optional<GridZone> grid_zone(const std::string& token) {
    static const std::regex form(
        "([0-9]{1,2})?([C-HJ-NP-Xc-hj-np-x]|[Nn][Oo][Rr][Tt][Hh]|[Ss][Oo][Uu][Tt][Hh])");
    static const std::regex polar("[ABYZabyz]");
    std::smatch part;
    if (std::regex_match(token, polar)) return GridZone{0, upper(token)};
    if (!std::regex_match(token, part, form)) return std::nullopt;
    const GridZone zone{part[1].matched ? std::stoi(part[1]) : 0, upper(part[2])};
    const bool hemisphere = zone.letter == "N" || zone.letter == "S" || zone.letter.size() > 1;
    if (!part[1].matched && !hemisphere) return std::nullopt;
    return zone;
}

// 32S: the southern hemisphere for GeographicLib and most GIS, the band from 32 to 40 N for soldiers and
// Google Earth. Where the northing fits that band too, neither is guessed.
std::optional<Error> two_readings(const std::string& text, const GridZone& zone, double x, double y) {
    if (zone.number == 0 || zone.letter != "S") return std::nullopt;
    double lat = 0;
    double lon = 0;
    try {
        UTMUPS::Reverse(zone.number, true, x, y, lat, lon, true);
    } catch (const GeographicLib::GeographicErr&) {
        return std::nullopt;
    }
    if (lat < 32 || lat > 40) return std::nullopt;
    const std::string number = std::to_string(zone.number);
    return refused(text, "S may be the southern hemisphere or the band from 32 to 40 N; write " + number +
                             "south or " + number + "north");
}

Result<Place> from_grid(const std::string& text, const GridZone& zone, double x, double y) {
    if (const auto doubt = two_readings(text, zone, x, y)) return *doubt;
    const char letter = zone.letter.front();
    const bool polar_half = std::string("ABYZ").find(letter) != std::string::npos;
    const bool north =
        polar_half ? letter > 'B' : letter >= 'N' && zone.letter != "S" && zone.letter != "SOUTH";
    double lat = 0;
    double lon = 0;
    try {
        UTMUPS::Reverse(zone.number, north, x, y, lat, lon, true);
    } catch (const GeographicLib::GeographicErr& fault) {
        return refused(text, fault.what());
    }
    if (polar_half && (x >= 2'000'000) != (letter == 'B' || letter == 'Z'))
        return refused(text,
                       std::string("the easting does not lie in the half ") + letter + " of the polar grid");
    const bool band = !polar_half && zone.letter.size() == 1 && letter != 'N' && letter != 'S';
    constexpr double rounding_deg = 1e-4;  // a northing in whole metres may fall just outside its band
    if (band &&
        (lat < band_of(letter).south_deg - rounding_deg || lat > band_of(letter).north_deg + rounding_deg))
        return refused(text, "lies at latitude " + std::to_string(lat) + ", outside the band " + letter);
    return checked(text, lat, lon, "UTM/UPS", true);
}

// The box around a square of a zone's grid. Nothing where a corner has no place.
std::optional<PlaceCell> box_of_square(int zone, bool north, const std::array<double, 2>& middle_m,
                                       double side_m) {
    std::optional<PlaceCell> box;
    double middle_deg = 0;
    double ignored_deg = 0;
    UTMUPS::Reverse(zone, north, middle_m[0], middle_m[1], ignored_deg, middle_deg);
    for (int i = 0; i < 9; ++i) {
        double lat = 0;
        double lon = 0;
        try {
            UTMUPS::Reverse(zone, north, middle_m[0] + (i % 3 - 1) * 0.5 * side_m,
                            middle_m[1] + (i / 3 - 1) * 0.5 * side_m, lat, lon);
        } catch (const GeographicLib::GeographicErr&) {
            return std::nullopt;
        }
        lon = middle_deg + std::remainder(lon - middle_deg, 360.0);
        if (!box) box = PlaceCell{lat, lon, lat, lon};
        box->south_deg = std::min(box->south_deg, lat), box->north_deg = std::max(box->north_deg, lat);
        box->west_deg = std::min(box->west_deg, lon), box->east_deg = std::max(box->east_deg, lon);
    }
    return box;
}

}  // namespace

std::optional<Result<Place>> read_utm_ups(const std::string& text, const std::string& plain) {
    std::string spaced = plain;
    std::replace(spaced.begin(), spaced.end(), ',', ' ');
    std::vector<std::string> token = words(spaced);
    if (token.size() != 3) return std::nullopt;
    if (!grid_zone(token[0]))
        std::rotate(token.begin(), token.begin() + 2, token.end());  // "422000 5158000 32N"
    const auto zone = grid_zone(token[0]);
    const auto easting = decimal_number(token[1]);
    const auto northing = decimal_number(token[2]);
    if (!zone || !easting || !northing) return std::nullopt;
    const bool zone_written = token[0].front() >= '0' && token[0].front() <= '9';
    if (zone_written && (zone->number < 1 || zone->number > 60))
        return refused(text, "UTM zone " + std::to_string(zone->number) + " is outside 1 to 60");
    return from_grid(text, *zone, *easting, *northing);
}

std::optional<Result<Place>> read_mgrs(const std::string& text, const std::string& plain) {
    // A polar square needs digits: three letters are a word.
    static const std::regex form(
        "([0-9]{1,2}[C-HJ-NP-X]|[ABYZ](?=[A-Z ]+[0-9])) ?[A-HJ-NP-Z]{2} ?([0-9]*)( [0-9]+)?",
        std::regex::icase);
    std::smatch part;
    if (!std::regex_match(plain, part, form)) return std::nullopt;
    std::string square = plain;
    square.erase(std::remove(square.begin(), square.end(), ' '), square.end());
    if (square == plain && square != upper(square) && reads_as_geohash(square))
        return refused(text, "reads as MGRS and as a geohash; write MGRS in capitals, or geohash:" + plain);
    const auto digits = static_cast<std::size_t>(part[2].length());
    const auto second = static_cast<std::size_t>(part[3].matched ? part[3].length() - 1 : 0);
    if (part[3].matched ? digits != second : digits % 2 != 0)
        return refused(text, "an MGRS square has as many digits for the easting as for the northing");
    try {
        int zone = 0;
        int precision = 0;
        bool north = false;
        double x = 0;
        double y = 0;
        double lat = 0;
        double lon = 0;
        MGRS::Reverse(upper(square), zone, north, x, y, precision);
        UTMUPS::Reverse(zone, north, x, y, lat, lon);
        Result<Place> place = checked(text, lat, lon, "MGRS", true);
        if (place.ok()) place->cell = box_of_square(zone, north, {x, y}, 1e5 * std::pow(10.0, -precision));
        return place;
    } catch (const GeographicLib::GeographicErr& fault) {
        return refused(text, fault.what());
    }
}

bool reads_as_geohash(const std::string& lower_case) {
    return !lower_case.empty() && lower_case.size() <= longest_geohash &&
           lower_case.find_first_not_of("0123456789bcdefghjkmnpqrstuvwxyz") == std::string::npos;
}

Result<Place> read_geohash(const std::string& text, const std::string& hash) {
    if (!reads_as_geohash(hash)) return refused(text, "a geohash has 1 to 18 of 0-9 and b-z without i, l, o");
    try {
        double lat = 0;
        double lon = 0;
        int length = 0;
        GeographicLib::Geohash::Reverse(hash, lat, lon, length);
        Result<Place> place = checked(text, lat, lon, "geohash", true);
        const double up_deg = 0.5 * GeographicLib::Geohash::LatitudeResolution(length);
        const double right_deg = 0.5 * GeographicLib::Geohash::LongitudeResolution(length);
        if (place.ok()) place->cell = PlaceCell{lat - up_deg, lon - right_deg, lat + up_deg, lon + right_deg};
        return place;
    } catch (const GeographicLib::GeographicErr& fault) {
        return refused(text, fault.what());
    }
}

}  // namespace oro::place_text
