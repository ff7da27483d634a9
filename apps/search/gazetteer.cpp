#include "apps/search/gazetteer.h"

#include <utf8.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "apps/report/figures.h"
#include "apps/search/folded_text.h"
#include "apps/search/text_lines.h"
#include "apps/vectors/named_points.h"
#include "core/base/one_line.h"
#include "geo/vectors/coordinate_columns.h"
#include "geo/vectors/csv_records.h"
#include "geo/vectors/table_text.h"

namespace oro {
namespace {

using Fields = std::vector<std::string>;

constexpr std::size_t longest_place_name = 200;  // bytes
constexpr int no_column = -1;

// Which field of a line says what; no_column where none does.
struct Columns {
    int name{no_column}, lat{no_column}, lon{no_column};
    int height{no_column}, other_height{no_column};  // the second counts where the first is empty
    int population{no_column};
    int kind{no_column}, code{no_column};
    bool is_geonames{};
};

// GeoNames' readme (download.geonames.org/export/dump/readme.txt): geonameid, name, asciiname,
// alternatenames, latitude, longitude, feature class, feature code, ..., population (14), elevation (15), dem
// (16), ...
constexpr int geonames_fields = 19;
const Columns geonames_columns{1, 4, 5, 15, 16, 14, 6, 7, true};

std::string_view trimmed_field(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Between tabs, without quotation marks, as GeoNames writes them.
Fields fields_of_dump(const std::string& line) {
    Fields fields(1);
    for (const char c : line) {
        if (c == '\t')
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

std::string_view field_of(const Fields& fields, int column) {
    if (column < 0 || static_cast<std::size_t>(column) >= fields.size()) return "";
    return trimmed_field(fields[static_cast<std::size_t>(column)]);
}

std::optional<double> number_in(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || read.ec != std::errc{} || read.ptr != text.data() + text.size() ||
        !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::string name_of_place(std::string_view text) {
    std::string name = one_line(trimmed_field(text), Joiners::kept_in_words);
    if (name.size() <= longest_place_name) return name;
    std::size_t end = longest_place_name;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0U) == 0x80U) --end;  // whole letters
    name.resize(end);
    return name;
}

// By the words of OpenStreetMap, GPX, Natural Earth and others.
PlaceClass class_in_words(std::string_view text) {
    const std::string words = " " + folded(text) + " ";
    const auto says_one_of = [&](std::initializer_list<const char*> all) {
        return std::ranges::any_of(
            all, [&](const char* one) { return words.find(" " + std::string(one) + " ") != words.npos; });
    };
    if (says_one_of({"peak", "volcano", "summit", "mountain", "mount", "gipfel", "sommet", "cima"}))
        return PlaceClass::summit;
    if (says_one_of({"city", "town", "village", "hamlet", "settlement", "populated", "ort", "ville"}))
        return PlaceClass::settlement;
    return PlaceClass::other;
}

PlaceClass class_of_geonames(std::string_view kind, std::string_view code) {
    if (kind == "P") return PlaceClass::settlement;
    if (kind != "T") return PlaceClass::other;
    for (const std::string_view summit : {"MT", "PK", "PKS", "HLL", "VLC", "MTU"})
        if (code == summit) return PlaceClass::summit;
    return PlaceClass::other;
}

// The place that a line tells; or what is wrong with the line.
std::string place_in(const Fields& fields, const Columns& columns, SearchPlace& place) {
    const std::string_view name = field_of(fields, columns.name), lat = field_of(fields, columns.lat),
                           lon = field_of(fields, columns.lon);
    const auto lat_deg = number_in(lat), lon_deg = number_in(lon);
    const auto no_angle = [](const char* what, std::string_view text) {
        return "its " + std::string(what) + " is '" + one_line(text.substr(0, 40)) + "'";
    };
    if (columns.is_geonames && fields.size() < geonames_fields)
        return "it has " + std::to_string(fields.size()) + " fields, not 19";
    if (!lat_deg || std::abs(*lat_deg) > 90.0) return no_angle("latitude", lat);
    if (!lon_deg || std::abs(*lon_deg) > 180.0) return no_angle("longitude", lon);
    if (!utf8::is_valid(name.begin(), name.end())) return "its name is no UTF-8";
    place = {};
    place.name = name_of_place(name);
    if (place.name.empty()) return "it has no name";
    place.lat_deg = *lat_deg;
    place.lon_deg = *lon_deg;
    constexpr double no_height_m = -9999.0;  // GeoNames' dem over the sea and in voids
    for (const int column : {columns.height, columns.other_height}) {
        const auto H_m = metres_from(field_of(fields, column));
        if (!place.H_m && H_m && *H_m > no_height_m) place.H_m = *H_m;
    }
    place.population = std::clamp(number_in(field_of(fields, columns.population)).value_or(0.0), 0.0, 1e10);
    const std::string_view kind = field_of(fields, columns.kind);
    place.kind =
        columns.is_geonames ? class_of_geonames(kind, field_of(fields, columns.code)) : class_in_words(kind);
    return "";
}

// The columns of places and heights, as in every table; y and x are degrees where no others are there.
void find_coordinates(const Fields& headings, Columns& columns) {
    const DegreeColumns degrees = degree_columns(headings);
    const auto height = coordinate_columns(headings).height;
    if (height) columns.height = static_cast<int>(*height);
    if (degrees.lat) columns.lat = static_cast<int>(*degrees.lat);
    if (degrees.lon) columns.lon = static_cast<int>(*degrees.lon);
    for (std::size_t i = headings.size(); i-- > 0;) {
        const std::string name = plain_heading(headings[i]);
        if (!degrees.lat && name == "y") columns.lat = static_cast<int>(i);
        if (!degrees.lon && name == "x") columns.lon = static_cast<int>(i);
    }
}

// What the columns of a table's first line are.
Result<Columns> columns_in(Fields names, const std::string& path) {
    Columns columns;
    struct Known {
        int Columns::*column;
        std::array<const char*, 4> names;  // the first that a table has
    };
    static const std::array<Known, 4> known{{{&Columns::name, {"name", "label", "title", ""}},
                                             {&Columns::height, {"height", "h m", "", ""}},
                                             {&Columns::population, {"population", "", "", ""}},
                                             {&Columns::kind, {"class", "type", "natural", "place"}}}};
    find_coordinates(names, columns);
    for (std::string& name : names) name = folded(name);
    for (const Known& one : known) {
        for (const char* const name : one.names) {
            const auto found = std::ranges::find(names, std::string(name));
            if (*name == '\0' || found == names.end() || columns.*one.column != no_column) continue;
            columns.*one.column = static_cast<int>(found - names.begin());
        }
    }
    for (const auto& [column, what] :
         {std::pair{columns.name, "name"}, {columns.lat, "lat"}, {columns.lon, "lon"}}) {
        if (column == no_column)
            return Error{
                ErrorKind::failed, path,
                "its first line names no column '" + std::string(what) +
                    "': a gazetteer is a dump of GeoNames, a table with the columns name, lat and lon, "
                    "or points of GeoJSON, GPX, KML, GeoPackage, a shapefile or FlatGeobuf"};
    }
    return columns;
}

bool is_geonames_line(const std::string& line) {
    const Fields fields = fields_of_dump(line);
    return fields.size() == geonames_fields && number_in(field_of(fields, geonames_columns.lat)) &&
           number_in(field_of(fields, geonames_columns.lon));
}

bool is_within(const SearchPlace& place, const std::optional<BoundingBox>& box) {
    if (!box) return true;
    if (place.lat_deg < box->south_deg || place.lat_deg > box->north_deg) return false;
    const bool east_of = place.lon_deg >= box->west_deg, west_of = place.lon_deg <= box->east_deg;
    return box->west_deg <= box->east_deg ? east_of && west_of : east_of || west_of;
}

// Lines that are no places.
struct LinesLeftOut {
    std::size_t count{}, first{};
    std::string why;

    void add(std::size_t number, const std::string& what) {
        if (count++ > 0) return;
        first = number;
        why = what;
    }
};

// Collects the places of a table or a dump, and which lines are none.
class TableGazetteer {
  public:
    TableGazetteer(const std::string& path, const std::optional<BoundingBox>& within)
        : path_(path), within_(within) {}

    // Takes a line, with what is wrong with it or "". False: there is no room for it, and nothing more
    // counts.
    bool take(std::size_t line, const std::string& wrong, SearchPlace place) {
        if (!wrong.empty()) {
            left_out_.add(line, wrong);
            return true;
        }
        is_any_ = true;
        if (!is_within(place, within_)) return true;
        if (gazetteer_.places.size() == most_gazetteer_places) {
            gazetteer_.notes.push_back(path_ + ": has more than " + grouped(most_gazetteer_places) +
                                       " places: those from line " + grouped(line) + " on are left out");
            return false;
        }
        gazetteer_.places.push_back(std::move(place));
        return true;
    }
    Result<Gazetteer> finish() {
        const std::string first = "line " + std::to_string(left_out_.first) + ": " + left_out_.why;
        if (!is_any_)
            return Error{ErrorKind::failed, path_,
                         "has no line with a place" + (left_out_.count > 0 ? "; " + first : std::string())};
        if (left_out_.count > 0)
            gazetteer_.notes.push_back(path_ + ": " + counted(left_out_.count, "line is", "lines are") +
                                       " left out, the first is " + first);
        return std::move(gazetteer_);
    }
    void add_note(const std::string& note) {
        if (!note.empty()) gazetteer_.notes.push_back(path_ + ": " + note);
    }

  private:
    const std::string& path_;
    const std::optional<BoundingBox>& within_;
    Gazetteer gazetteer_;
    LinesLeftOut left_out_;
    bool is_any_{};
};

Result<Gazetteer> read_dump(TextLines& lines, std::string line, TableGazetteer gazetteer,
                            const std::stop_token& stop) {
    for (bool more = true; more && !stop.stop_requested();) {
        SearchPlace place;
        const std::string wrong = lines.is_cut() ? "it is longer than 65,536 bytes"
                                                 : place_in(fields_of_dump(line), geonames_columns, place);
        if (!trimmed_field(line).empty() && !gazetteer.take(lines.number(), wrong, std::move(place))) break;
        ORO_TRY(more, lines.next(line));
    }
    return gazetteer.finish();
}

Result<Gazetteer> read_table(const std::string& path, TableGazetteer gazetteer, const std::stop_token& stop) {
    ORO_TRY(const TableText table, read_table_text(path));
    gazetteer.add_note(table.note);
    const auto in_file = [&](const Error& error) { return Error{error.kind, path, error.what}; };
    Result<CsvRecords> records = CsvRecords::of(table.text);
    if (!records.ok()) return in_file(records.error());
    ORO_TRY(const Columns columns, columns_in(records->headings(), path));
    std::vector<CsvField> fields;
    Fields texts(records->headings().size());
    while (!stop.stop_requested()) {
        const Result<bool> more = records->next(fields);
        if (!more.ok()) return in_file(more.error());
        if (!*more) break;
        for (std::size_t i = 0; i < texts.size(); ++i) texts[i] = std::move(fields[i].text);
        SearchPlace place;
        const std::string wrong = place_in(texts, columns, place);
        if (!gazetteer.take(records->line(), wrong, std::move(place))) break;
    }
    return gazetteer.finish();
}

Result<Gazetteer> read_points(const std::string& path, const std::optional<BoundingBox>& within) {
    ORO_TRY(const VectorFile file, read_vectors(path));
    Gazetteer gazetteer;
    gazetteer.notes = file.notes;
    gazetteer.places = places_of(file);
    if (gazetteer.places.empty())
        return Error{ErrorKind::failed, path, "has no point with something in the field 'name'"};
    std::erase_if(gazetteer.places, [&](const SearchPlace& place) { return !is_within(place, within); });
    return gazetteer;
}

}  // namespace

Result<Gazetteer> read_gazetteer(const std::string& path, const std::optional<BoundingBox>& within,
                                 const std::stop_token& stop) {
    ORO_TRY(TextLines lines, TextLines::of(path));
    std::string line;
    for (bool more = true; trimmed_field(line).empty();) {
        ORO_TRY(more, lines.next(line));
        if (!more) return Error{ErrorKind::failed, path, "is empty"};
    }
    const std::string_view start = trimmed_field(line);
    // A shapefile begins with the number 9994, whose last byte is the end of a line.
    constexpr std::string_view shapefile("\0\0\x27", 3);
    for (const std::string_view of_vectors :
         {std::string_view("{"), std::string_view("<"), std::string_view("PK\x03\x04"),
          std::string_view("SQLite format 3"), std::string_view("fgb\x03"), shapefile})
        if (start.starts_with(of_vectors)) return read_points(path, within);
    TableGazetteer gazetteer(path, within);
    if (is_geonames_line(line)) return read_dump(lines, line, std::move(gazetteer), stop);
    return read_table(path, std::move(gazetteer), stop);
}

std::vector<SearchPlace> places_of(const VectorFile& file, const std::string& name_field) {
    std::vector<SearchPlace> places;
    for (const VectorLayer& layer : file.layers) {
        for (const VectorShape& shape : layer.shapes) {
            if (shape.kind != VectorKind::point) continue;
            SearchPlace place;
            place.name = name_of_place(layer.text(shape, name_field));
            if (place.name.empty()) continue;
            const VectorPlace& where = shape.paths.front().front();
            place.lat_deg = where.lat_deg;
            place.lon_deg = where.lon_deg;
            place.H_m = metres_from(layer.text(shape, "ele"));
            if (!place.H_m && shape.heights == HeightAbove::sea_level && std::isfinite(where.height_m))
                place.H_m = where.height_m;
            place.population =
                std::clamp(number_in(layer.text(shape, "population")).value_or(0.0), 0.0, 1e10);
            for (const char* const field : {"natural", "place", "class", "type", "sym"})
                if (place.kind == PlaceClass::other) place.kind = class_in_words(layer.text(shape, field));
            if (metres_from(layer.text(shape, "prominence"))) place.kind = PlaceClass::summit;
            places.push_back(std::move(place));
        }
    }
    return places;
}

}  // namespace oro
