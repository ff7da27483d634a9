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
#include "geo/files/letter_case.h"

namespace oro {
namespace {

Error of_place(const std::string& file, const std::string& words, const Error& error) {
    return {error.kind, file + ", " + words, error.line()};
}

// A number that a place has in a field; nothing where it has no such field, or nothing in it.
Result<std::optional<double>> number_in(const BatchPlace& place, const std::string& name) {
    const auto field = place.fields.find(name);
    if (field == place.fields.end()) return std::optional<double>();
    std::string text = field->second;
    std::erase(text, ' ');
    if (text.empty()) return std::optional<double>();
    double number = 0.0;
    if (!read_whole(text, number) || !std::isfinite(number))
        return Error{ErrorKind::failed, name, "\"" + field->second + "\" is no number"};
    return std::optional(number);
}

Result<TableObserver> observer_at(const BatchPlace& place, const ViewshedOptions& options) {
    TableObserver observer{place.words(), place.number, "", {}, true};
    if (const auto name = place.fields.find("name"); name != place.fields.end()) observer.name = name->second;
    ORO_TRY(const std::optional<double> lat_deg, number_in(place, "lat"));
    ORO_TRY(const std::optional<double> lon_deg, number_in(place, "lon"));
    if (!lat_deg || !lon_deg)
        return Error{
            ErrorKind::failed, "lat and lon",
            "are missing: a table needs columns of these names, or latitude and longitude, in degrees"};
    ORO_TRY(const std::optional<double> above_m, number_in(place, "above"));
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

Result<std::vector<TableObserver>> read_observers(const ObserversOptions& observers,
                                                  const ViewshedOptions& options) {
    ORO_TRY(const std::vector<BatchPlace> places, read_places(observers.file));
    std::vector<TableObserver> all;
    all.reserve(places.size());
    for (const BatchPlace& place : places) {
        Result<TableObserver> observer = observer_at(place, options);
        if (!observer.ok()) return of_place(observers.file, place.words(), observer.error());
        all.push_back(std::move(*observer));
    }
    return all;
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

std::string observers_csv(const std::vector<TableObserver>& observers, const ViewshedReport& report,
                          const SightGround& ground) {
    std::string text = "number,name,lat_deg,lon_deg,H_m,h_m,posts,seen\n";
    std::size_t i = 0;
    for (const TableObserver& observer : observers) {
        text += std::to_string(observer.number) + "," + csv_text(observer.name) + ",";
        if (!observer.has_ground) {
            text += observer.standing.place + ",,,,\n";
            continue;
        }
        const Geodetic& eye = report.question.eyes[i];
        char line[160];
        std::snprintf(line, sizeof line, "%.9f,%.9f,%.3f,%.3f,%zu,%zu\n", eye.lat_deg, eye.lon_deg,
                      ground.H_m(eye), eye.h_m, report.each[i].cells, report.each[i].seen);
        text += line;
        ++i;
    }
    return text;
}

}  // namespace oro
