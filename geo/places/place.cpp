#include "geo/places/place.h"

#include <GeographicLib/DMS.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <exception>
#include <regex>
#include <string_view>
#include <utility>

#include "geo/places/place_text.h"

namespace oro {
namespace place_text {

Error refused(const std::string& text, const std::string& what) {
    static constexpr char hex[] = "0123456789abcdef";
    std::string shown;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool starts_character = (byte & 0xC0) != 0x80;
        if (shown.size() >= 60 && starts_character) {
            shown += "...";
            break;
        }
        if (byte < 0x20 || byte == 0x7F)
            shown += {'\\', 'x', hex[byte >> 4], hex[byte & 15]};
        else
            shown += c;
    }
    return {ErrorKind::usage, "place \"" + shown + "\"", what};
}

static std::string number(double value) {
    std::array<char, 32> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 10);
    return {digits.data(), end.ptr};
}

Result<Place> checked(const std::string& text, double lat_deg, double lon_deg, const std::string& form,
                      bool letters) {
    if (!std::isfinite(lat_deg) || !std::isfinite(lon_deg)) return refused(text, "is not a finite position");
    if (std::abs(lat_deg) > 90) {
        const bool swapped = !letters && std::abs(lat_deg) <= 180 && std::abs(lon_deg) <= 90;
        return refused(text, "latitude " + number(lat_deg) + " is outside [-90, 90]" +
                                 (swapped ? "; latitude comes first: the two may be swapped, " +
                                                number(lon_deg) + "," + number(lat_deg)
                                          : ""));
    }
    if (std::abs(lon_deg) > 180) {
        const bool around = std::abs(lon_deg) <= 360;
        return refused(text, "longitude " + number(lon_deg) + " is outside [-180, 180]" +
                                 (around ? "; write " + number(lon_deg - std::copysign(360, lon_deg)) : ""));
    }
    Place place;
    place.lat_deg = lat_deg + 0.0;  // -0 becomes 0
    place.lon_deg = lon_deg == -180 ? 180 : lon_deg + 0.0;
    place.form = form;
    return place;
}

std::optional<double> decimal_number(const std::string& token) {
    static const std::regex form(R"([+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)");
    if (!std::regex_match(token, form)) return std::nullopt;
    const char* const start = token.data() + (token.front() == '+' ? 1 : 0);
    double value = 0;
    const auto end = std::from_chars(start, token.data() + token.size(), value);
    if (end.ec != std::errc{} || end.ptr != token.data() + token.size()) return std::nullopt;
    return value;
}

std::vector<std::string> words(const std::string& text) {
    std::vector<std::string> found;
    std::size_t start = 0;
    while ((start = text.find_first_not_of(' ', start)) != std::string::npos) {
        const std::size_t end = std::min(text.find(' ', start), text.size());
        found.push_back(text.substr(start, end - start));
        start = end;
    }
    return found;
}

}  // namespace place_text

namespace {
using place_text::checked;
using place_text::decimal_number;
using place_text::refused;

constexpr std::size_t longest_text = 200;
constexpr const char* known_forms =
    "is no known form of a place; these are: 46.5763,7.9904, 46d34'35\"N 7d59'25\"E, 32T 422000 5158000, "
    "32TMS2200058000, a geohash, geo:46.57,7.99 and the tile N46E008";

// Of a text that may be a name.
Error no_form(const std::string& text, const std::string& of_names) {
    return refused(text, known_forms + (of_names.empty() ? "" : " (" + of_names + ")"));
}

std::string trimmed(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

// Degree, minute and second marks, dashes and spaces as people's keyboards and web pages have them, in ASCII.
std::string with_ascii_marks(std::string text) {
    static constexpr std::array<std::pair<std::string_view, char>, 26> marks{{
        {"\u00b0", 'd'},  {"\u00ba", 'd'},  {"\u02da", 'd'},  {"\u2032", '\''}, {"\u2035", '\''},
        {"\u2018", '\''}, {"\u2019", '\''}, {"\u00b4", '\''}, {"\u02b9", '\''}, {"`", '\''},
        {"\u2033", '"'},  {"\u2036", '"'},  {"\u201c", '"'},  {"\u201d", '"'},  {"\u02ba", '"'},
        {"\u2212", '-'},  {"\u2010", '-'},  {"\u2011", '-'},  {"\u2013", '-'},  {"\u2014", '-'},
        {"\u00a0", ' '},  {"\u2009", ' '},  {"\u202f", ' '},  {"\u2007", ' '},  {"\t", ' '},
        {"''", '"'},
    }};
    for (const auto& [mark, ascii] : marks)
        for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; ++at)
            text.replace(at, mark.size(), 1, ascii);
    return text;
}

// N46E008: the cell whose south-west corner lies at 46 N 8 E; its centre is the place.
std::optional<Result<Place>> read_tile_cell(const std::string& text, const std::string& plain) {
    static const std::regex form("([NSns])([0-9]{2})([EWew])([0-9]{3})");
    std::smatch part;
    if (!std::regex_match(plain, part, form)) return std::nullopt;
    const int south = std::stoi(part[2]) * (lower(part[1]) == "s" ? -1 : 1);
    const int west = std::stoi(part[4]) * (lower(part[3]) == "w" ? -1 : 1);
    if (south < -90 || south > 89 || west < -180 || west > 179)
        return refused(text, "there is no such tile: its corner lies outside S90..N89, W180..E179");
    Result<Place> place = checked(text, south + 0.5, west + 0.5, "tile cell", true);
    if (place.ok()) place->cell = PlaceCell{south + 0.0, west + 0.0, south + 1.0, west + 1.0};
    return place;
}

// RFC 5870: geo:lat,lon[,altitude][;crs=wgs84][;u=metres][;name=value...]. Of what Android and OpenStreetMap
// append, ?z=ZOOM is dropped; any other query could hold another position, and is refused.
Result<Place> read_geo_uri(const std::string& text, const std::string& plain) {
    static const std::regex form(R"(geo:([^,;?]*),([^,;?]*)(,[^,;?]*)?((;[^;?]*)*)(\?z=[0-9.]+)?)",
                                 std::regex::icase);
    static const std::regex coordinate(R"(-?[0-9]+(\.[0-9]+)?)");
    static const std::regex system(";crs=([^;]*)", std::regex::icase);
    std::smatch part;
    if (!std::regex_match(plain, part, form)) return refused(text, "is not a geo URI: geo:46.57,7.99 is one");
    const std::string altitude = part[3].matched ? part[3].str().substr(1) : "0";
    for (const std::string& value : {part[1].str(), part[2].str(), altitude})
        if (!std::regex_match(value, coordinate) || !decimal_number(value))
            return refused(text, "\"" + value + "\" is not a number of a geo URI");
    const std::string parameters = part[4];
    std::smatch named;
    if (std::regex_search(parameters, named, system) && lower(named[1]) != "wgs84")
        return refused(text, "the reference system " + named[1].str() + " is not known; only wgs84 is");
    ORO_TRY(Place place, checked(text, *decimal_number(part[1]), *decimal_number(part[2]), "geo URI", false));
    if (part[3].matched) place.height_m = *decimal_number(altitude);
    return place;
}

// "46° 34' 35" N" -> "46°34'35"N": spaces inside one angle. A hemisphere letter belongs to what stands before
// it, unless the text starts with one.
std::string without_inner_spaces(std::string text) {
    static const std::regex after_mark("([dD'\":]) +([0-9])");
    static const std::regex before_letter("([0-9.dD'\":]) +([NSEWnsew])(?![0-9A-Za-z])");
    static const std::regex after_letter("([NSEWnsew]) +([0-9])");
    const bool letter_first =
        !text.empty() && std::string("NSEWnsew").find(text.front()) != std::string::npos;
    if (!letter_first) text = std::regex_replace(text, before_letter, "$1$2");
    text = std::regex_replace(text, letter_first ? after_letter : after_mark, "$1$2");
    return letter_first ? std::regex_replace(text, after_mark, "$1$2") : text;
}

// One angle, with GeographicLib for degrees, minutes and seconds. Its sums ("40:30+0:0:30") and a sign beside
// a letter
// ("S-46") are refused: they are typing errors more often than meant. The form is checked here to the end,
// for version 2.1.2 writes outside its arrays when there are more than three components.
Result<double> read_angle(const std::string& text, const std::string& token, GeographicLib::DMS::flag& kind) {
    static const std::string number = R"(([0-9]+\.?[0-9]*|\.[0-9]+))";
    static const std::string marks = number + "([dD](" + number + "('(" + number + "\"?)?)?)?)?";
    static const std::string angle = "(" + marks + "|" + number + ":" + number + "(:" + number + ")?)";
    static const std::regex form("[+-]?" + angle + "|[NSEWnsew]" + angle + "|" + angle + "[NSEWnsew]");
    kind = GeographicLib::DMS::NONE;
    if (const auto plain = decimal_number(token)) return *plain;
    if (!std::regex_match(token, form)) return refused(text, "\"" + token + "\" is not an angle");
    try {
        return GeographicLib::DMS::Decode(token, kind);
    } catch (const GeographicLib::GeographicErr& fault) {
        return refused(text, fault.what());
    }
}

// The same two numbers with points in the place of decimal commas: "46,5 8" and "46,5, 8,0" have them.
std::string with_points(const std::string& plain) {
    static const std::regex numbers("([+-]?[0-9]+),([0-9]+)[ ,;/]+([+-]?[0-9]+),([0-9]+)");
    std::smatch found;
    if (!std::regex_match(plain, found, numbers)) return "46.5763,7.9904";
    return found[1].str() + "." + found[2].str() + "," + found[3].str() + "." + found[4].str();
}

Result<std::pair<std::string, std::string>> two_parts(const std::string& text, const std::string& plain,
                                                      const std::string& of_names) {
    const auto commas = std::count(plain.begin(), plain.end(), ',');
    const std::string decimal_hint = "; if the commas are decimal marks, write points: 46.5763,7.9904";
    static const std::regex decimal_commas("[+-]?[0-9]+,[0-9]+[ ;/]+[+-]?[0-9]+,[0-9]+");
    if (commas >= 2) {
        if (commas == 3 || std::regex_match(plain, decimal_commas))
            return refused(text, "has decimal commas; write points: " + with_points(plain));
        return refused(
            text, "has more than two numbers (with a height, write geo:46.5763,7.9904,1034)" + decimal_hint);
    }
    std::vector<std::string> parts;
    if (commas == 1) {
        const std::size_t comma = plain.find(',');
        parts = {without_inner_spaces(trimmed(plain.substr(0, comma))),
                 without_inner_spaces(trimmed(plain.substr(comma + 1)))};
        for (const std::string& part : parts) {
            if (part.empty()) return refused(text, "has nothing on one side of the comma");
            if (part.find(' ') != std::string::npos)
                return refused(text, "\"" + part + "\" is not one angle");
        }
    } else {
        parts = place_text::words(without_inner_spaces(plain));
        if (parts.size() != 2) return no_form(text, of_names);
    }
    return std::pair{parts[0], parts[1]};
}

Result<Place> read_lat_lon(const std::string& text, const std::string& plain, const std::string& of_names) {
    using GeographicLib::DMS;
    ORO_TRY(const auto parts, two_parts(text, plain, of_names));
    DMS::flag first_kind{};
    DMS::flag second_kind{};
    ORO_TRY(double lat_deg, read_angle(text, parts.first, first_kind));
    ORO_TRY(double lon_deg, read_angle(text, parts.second, second_kind));
    if (first_kind == second_kind && first_kind != DMS::NONE)
        return refused(text, first_kind == DMS::LATITUDE ? "has two latitudes" : "has two longitudes");
    const bool letters = first_kind != DMS::NONE || second_kind != DMS::NONE;
    if (first_kind == DMS::LONGITUDE || second_kind == DMS::LATITUDE) std::swap(lat_deg, lon_deg);
    const bool degrees = decimal_number(parts.first) && decimal_number(parts.second);
    Result<Place> place = checked(text, lat_deg, lon_deg, degrees ? "degrees" : "DMS", letters);
    static const std::regex one_number("[+-]?[0-9]+,[0-9]+");
    if (!place.ok() && std::abs(lat_deg) <= 90 && std::abs(lon_deg) > 360 &&
        std::regex_match(plain, one_number))
        return refused(text, place.error().what +
                                 "; if the comma is a decimal mark, write a point and add the longitude");
    return place;
}

// A text without space or comma that is neither a tile, an MGRS square nor a geo URI.
Result<Place> read_single_word(const std::string& text, const std::string& plain,
                               const std::string& of_names) {
    // These two are geohashes as well, but far from what was meant.
    static const std::regex short_tile("[NSns][0-9]{1,2}[EWew][0-9]{1,3}");
    static const std::regex run_together("[0-9.]+[NSns][0-9.]+[EWew]");
    if (std::regex_match(plain, short_tile))
        return refused(text, "is not a tile's name; those are like N46E008");
    if (std::regex_match(plain, run_together))
        return refused(text, "needs a space or comma between latitude and longitude");
    const bool digit = plain.find_first_of("0123456789") != std::string::npos;
    const bool small_letter = plain.find_first_of("abcdefghijklmnopqrstuvwxyz") != std::string::npos;
    if (digit && small_letter && place_text::reads_as_geohash(plain))
        return place_text::read_geohash(text, plain);
    if (decimal_number(plain)) return refused(text, "is one number; a place needs two: 46.5763,7.9904");
    if (place_text::reads_as_geohash(lower(plain)))
        return refused(
            text, "reads as a name or a geohash; " + (of_names.empty() ? "" : of_names + ", and ") +
                      "a geohash is written in small letters with a digit, or as geohash:" + lower(plain));
    return no_form(text, of_names);
}

// Whether a text is a name, of several words or of letters that no form of a place has: it has no digit.
bool is_name(const std::string& plain) {
    bool has_letter = false, may_be_form = true;
    for (const char c : plain) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7F || (c >= '0' && c <= '9')) return false;
        has_letter |= (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || byte >= 0x80;
        may_be_form &= c != ' ' && c != ',' && byte < 0x80;
    }
    return has_letter && !may_be_form;
}

Result<Place> read_place(const std::string& text, const std::string& of_names) {
    if (text.size() > longest_text) return refused(text, "is too long for a place");
    const std::string plain = trimmed(with_ascii_marks(trimmed(text)));
    if (plain.empty()) return refused(text, "is empty");
    if (is_name(plain)) return no_form(text, of_names);
    for (const char c : plain)
        if (c < 0x20 || c > 0x7E) return refused(text, "holds a character that no form of a place has");
    const std::string small = lower(plain);
    if (small.starts_with("geo:")) return read_geo_uri(text, plain);
    if (small.starts_with("geohash:")) return place_text::read_geohash(text, small.substr(8));
    if (auto place = read_tile_cell(text, plain)) return *place;
    if (auto place = place_text::read_utm_ups(text, plain)) return *place;
    if (auto place = place_text::read_mgrs(text, plain)) return *place;
    if (plain.find_first_of(" ,") == std::string::npos) return read_single_word(text, plain, of_names);
    return read_lat_lon(text, plain, of_names);
}

}  // namespace

Result<Place> parse_place(const std::string& text, const std::string& of_names) {
    try {
        return read_place(text, of_names);
    } catch (const std::bad_alloc&) {
        throw;  // says nothing about the place
    } catch (const std::exception& fault) {
        return refused(text, fault.what());
    }
}

}  // namespace oro
