#include "apps/commands/sight/table_observers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "apps/batch/batch_places.h"
#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/figures.h"
#include "core/base/one_line.h"
#include "geo/files/letter_case.h"
#include "geo/vectors/coordinate_columns.h"

namespace oro {
namespace {

Error of_place(const std::string& file, const std::string& words, const Error& error) {
    return {error.kind, file + ", " + words, error.line()};
}

// A number with a comma for decimals, with a point; any other text as it is. A comma may part thousands where
// three digits stand behind it, but of degrees.
std::string with_point(const std::string& text, bool is_degree) {
    const std::size_t comma = text.find(',');
    if (comma == std::string::npos || text.find_first_of(",.", comma + 1) != std::string::npos ||
        text.find('.') < comma || (!is_degree && text.size() - comma - 1 == 3))
        return text;
    std::string number = text;
    number[comma] = '.';
    return number;
}

// A number that a place has in a field; nothing where it has no such field, or nothing in it.
Result<std::optional<double>> number_in(const BatchPlace& place, const std::string& name) {
    const auto field = place.fields.find(name);
    if (field == place.fields.end()) return std::optional<double>();
    std::string text = field->second;
    std::erase(text, ' ');
    if (text.empty()) return std::optional<double>();
    double number = 0.0;
    if (!read_whole(with_point(text, name == "lat" || name == "lon"), number) || !std::isfinite(number))
        return Error{ErrorKind::failed, name, "\"" + field->second + "\" is no number"};
    return std::optional(number);
}

// What is said of the first decimal comma.
std::string note_of_commas(const BatchPlace& place, const std::string& above_column) {
    for (const std::string& name : {std::string("lat"), std::string("lon"), above_column}) {
        const auto field = place.fields.find(name);
        if (field == place.fields.end()) continue;
        const std::string number = with_point(field->second, name != above_column);
        if (number != field->second)
            return "has commas for decimals: '" + one_line(field->second) + "' is read as " +
                   one_line(number);
    }
    return "";
}

// No mast is so high. A column of heights above the sea is told by it.
constexpr double highest_mast_m = 1000.0;

// Whether a column may as well hold heights above the sea, by its name.
bool may_be_above_sea(const std::string& column) {
    const std::string name = plain_heading(column);
    return name.starts_with("height") && name.find("ground") == std::string::npos &&
           name.find("agl") == std::string::npos;
}

constexpr const char* call_it_otherwise =
    "heights above the sea need another name, such as ele, and heights over the ground are called above";

// A place's height over the ground, where it has one.
Result<std::optional<double>> above_of(const BatchPlace& place, const std::string& column) {
    if (column.empty()) return std::optional<double>();
    ORO_TRY(const std::optional<double> above_m, number_in(place, column));
    if (above_m && *above_m > highest_mast_m && may_be_above_sea(column))
        return Error{ErrorKind::failed, column + " " + all_digits(*above_m),
                     std::string("is no height of a mast over the ground: ") + call_it_otherwise};
    return above_m;
}

Result<ObserverColumns> columns_of(const std::vector<std::string>& headings) {
    const DegreeColumns degrees = degree_columns(headings);
    const std::optional<std::size_t> above = above_ground_column(headings);
    ObserverColumns columns;
    if (above) columns.above = headings[*above];
    const auto is_above = [&](const std::string& heading) {
        return plain_heading(heading) == plain_heading(columns.above);
    };
    if (above && std::ranges::count_if(headings, is_above) > 1)
        return Error{ErrorKind::failed, one_line(columns.above),
                     "is the name of several columns: keep the one with heights over the ground, or call it "
                     "above"};
    for (std::size_t i = 0; i < headings.size(); ++i) {
        const bool is_asked = i == degrees.lat || i == degrees.lon || i == above ||
                              plain_heading(headings[i]) == "name" || headings[i].empty();
        if (!is_asked) columns.unused.push_back(one_line(headings[i]));
    }
    return columns;
}

Result<TableObserver> observer_at(const BatchPlace& place, const std::string& above_column,
                                  const ViewshedOptions& options) {
    TableObserver observer{place.words(), place.number, "", {}, true, false};
    if (const auto name = place.fields.find("name"); name != place.fields.end()) observer.name = name->second;
    ORO_TRY(const std::optional<double> lat_deg, number_in(place, "lat"));
    ORO_TRY(const std::optional<double> lon_deg, number_in(place, "lon"));
    for (const auto& [field, angle_deg] : {std::pair{"lat", lat_deg}, {"lon", lon_deg}})
        if (!angle_deg && place.fields.contains("lat") && place.fields.contains("lon"))
            return Error{ErrorKind::failed, field, "is empty"};
    if (!lat_deg || !lon_deg)
        return Error{
            ErrorKind::failed, "lat and lon",
            "are missing: a table needs columns of these names, or latitude and longitude, in degrees"};
    ORO_TRY(const std::optional<double> above_m, above_of(place, above_column));
    observer.has_own_height = above_m.has_value();
    Standing& standing = observer.standing;
    standing.place_option = "--observers";
    standing.place = all_digits(*lat_deg) + "," + all_digits(*lon_deg);
    standing.above_option = above_m ? "above" : "--above";
    standing.above_m = above_m ? above_m : options.above_m;
    standing.usual_above_m = 2.0;
    if (!above_m) standing.altitude_m = options.altitude_m;
    standing.on_summit = options.on_summit;
    standing.on_top = options.view.stand_on.value_or("ground") == "top";
    ORO_CHECK(place_at(standing.place_option, standing.place));
    return observer;
}

// Text of a field of a .csv, by RFC 4180.
std::string csv_text(const std::string& text) {
    if (text.find_first_of(",;\"\t\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

}  // namespace

Result<void> check_observers(const ObserversOptions& observers, const ViewshedOptions& options) {
    if (observers.file.empty())
        return observers.table.empty() ? Result<void>()
                                       : refused("--table", observers.table, "needs --observers FILE");
    if (!options.at.empty()) return refused("--observers", observers.file, "is not to be given with --at");
    if (!options.region.coordinates.empty())
        return refused("--observers", observers.file,
                       "holds latitudes and longitudes: --coordinates is for places of the command line");
    if (observers.table.empty()) return {};
    if (!lower_case(observers.table).ends_with(".csv"))
        return refused("--table", observers.table, "the file's name must end in .csv");
    return check_may_write(observers.table, options.overwrite);
}

Result<ObserversOfFile> read_observers(const ObserversOptions& observers, const ViewshedOptions& options) {
    ORO_TRY(PlacesOfFile places, read_places(observers.file));
    Result<ObserverColumns> columns = columns_of(places.headings);
    if (!columns.ok()) return Error{columns.error().kind, observers.file, columns.error().line()};
    ObserversOfFile read{{}, std::move(*columns), std::move(places.notes)};
    const std::size_t notes_of_reading = read.notes.size();
    read.all.reserve(places.all.size());
    read.columns.is_above_everywhere = true;
    for (const BatchPlace& place : places.all) {
        if (const std::string note = note_of_commas(place, read.columns.above);
            !note.empty() && read.notes.size() == notes_of_reading)
            read.notes.push_back(observers.file + ": " + note);
        Result<TableObserver> observer = observer_at(place, read.columns.above, options);
        if (!observer.ok()) return of_place(observers.file, place.words(), observer.error());
        read.columns.is_above_everywhere &= observer->has_own_height;
        read.all.push_back(std::move(*observer));
    }
    return read;
}

Result<void> find_ground(const std::string& file, const SightGround& ground,
                         std::vector<TableObserver>& observers) {
    std::optional<Error> first;
    bool any = false;
    for (TableObserver& observer : observers) {
        const Result<Standpoint> stood = stand_over_ground(observer.standing, ground);
        observer.has_ground = stood.ok();
        any |= stood.ok();
        if (stood.ok()) continue;
        const Error error = of_place(file, observer.words, stood.error());
        if (error.kind != ErrorKind::no_data) return error;
        if (!first) first = error;
    }
    return any || !first ? Result<void>() : *first;
}

Result<void> check_above_ground(const std::string& file, const ObserverColumns& columns,
                                const SightGround& ground, const std::vector<TableObserver>& observers) {
    // Heights of what is built are mostly less. Where all are alike they are a model's, of turbines say.
    constexpr double least_doubtful_m = 50.0, most_off_m = 20.0, most_off_share = 0.05;
    if (columns.above.empty() || !may_be_above_sea(columns.above)) return {};
    std::size_t count = 0, doubtful = 0;
    bool are_alike = true;
    double first_m = 0.0;
    std::string first;
    for (const TableObserver& observer : observers) {
        if (!observer.has_ground || !observer.has_own_height) continue;
        const double above_m = *observer.standing.above_m;
        if (count++ == 0) first_m = above_m;
        are_alike &= above_m == first_m;
        ORO_TRY(const Place place, place_at(observer.standing.place_option, observer.standing.place));
        const std::optional<double> h_m = ground.ground().h_m(place.lat_deg, place.lon_deg);
        if (!h_m || above_m < least_doubtful_m) continue;
        const double H_m = ground.H_m({place.lat_deg, place.lon_deg, *h_m});
        if (std::abs(above_m - H_m) > most_off_m + most_off_share * H_m) continue;
        if (doubtful++ == 0)
            first = observer.words + ": " + all_digits(above_m) + ", where the ground lies at H " +
                    std::to_string(std::lround(H_m)) + " m";
    }
    if (2 * doubtful <= count || (count > 1 && are_alike)) return {};
    return Error{ErrorKind::failed, file + ", column " + one_line(columns.above),
                 "has the ground's own heights above the sea (" + first + "): " + call_it_otherwise};
}

std::vector<Standing> standings_of(const std::vector<TableObserver>& observers) {
    std::vector<Standing> standings;
    for (const TableObserver& observer : observers)
        if (observer.has_ground) standings.push_back(observer.standing);
    return standings;
}

std::string observers_words(const std::string& file, const std::vector<TableObserver>& observers) {
    const auto left_out = std::ranges::count(observers, false, &TableObserver::has_ground);
    std::string text = grouped(observers.size() - static_cast<std::size_t>(left_out)) + " of " + file;
    if (left_out == 0) return text;
    const auto first = std::ranges::find(observers, false, &TableObserver::has_ground);
    return text + "; " + grouped(static_cast<std::size_t>(left_out)) +
           (left_out == 1 ? " stands where there are no elevation data and is left out, "
                          : " stand where there are no elevation data and are left out, the first is ") +
           first->words;
}

std::string eyes_words(const ObserverColumns& columns, const ViewshedOptions& options) {
    const std::string of_all = options.altitude_m
                                   ? "at H " + all_digits(*options.altitude_m) + " m"
                                   : all_digits(options.above_m.value_or(2.0)) + " m above the " +
                                         options.view.stand_on.value_or("ground");
    if (columns.above.empty()) return of_all + " (the table has no column above)";
    return "by the column " + one_line(columns.above) + ", in metres above the " +
           options.view.stand_on.value_or("ground") +
           (columns.is_above_everywhere ? "" : "; " + of_all + " where it is empty");
}

std::string unused_words(const ObserverColumns& columns) {
    constexpr std::size_t most = 8;
    std::vector<std::string> named = columns.unused;
    if (named.size() <= most) return joined(named, " and ");
    named.resize(most);
    named.push_back(std::to_string(columns.unused.size() - most) + " more");
    return joined(named, " and ");
}

std::string observers_csv(const std::vector<TableObserver>& observers, const ViewshedReport& report,
                          const SightGround& ground) {
    std::string text = "number,name,lat_deg,lon_deg,H_m,h_m,above_m,posts,seen\n";
    std::size_t i = 0;
    for (const TableObserver& observer : observers) {
        text += std::to_string(observer.number) + "," + csv_text(observer.name) + ",";
        if (!observer.has_ground) {
            text += observer.standing.place + ",,,,,\n";
            continue;
        }
        const Geodetic& eye = report.question.eyes[i];
        const double ground_h_m = ground.ground().h_m(eye.lat_deg, eye.lon_deg).value_or(eye.h_m);
        char line[200];
        std::snprintf(line, sizeof line, "%.9f,%.9f,%.3f,%.3f,%.3f,%zu,%zu\n", eye.lat_deg, eye.lon_deg,
                      ground.H_m(eye), eye.h_m, eye.h_m - ground_h_m, report.each[i].cells,
                      report.each[i].seen);
        text += line;
        ++i;
    }
    return text;
}

}  // namespace oro
