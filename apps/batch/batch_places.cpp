#include "apps/batch/batch_places.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "apps/command_line/refusals.h"
#include "geo/files/letter_case.h"
#include "geo/vectors/coordinate_columns.h"
#include "geo/vectors/csv_records.h"
#include "geo/vectors/table_text.h"
#include "geo/vectors/vector_file.h"

namespace oro {
namespace {

constexpr std::size_t most_places = 1'000'000;

Error too_many(const std::string& file) {
    return {ErrorKind::failed, file, "has more than 1,000,000 places: cut it"};
}

// A field that stands for a column whose heading is written in another way.
struct OtherName {
    const char* field;
    std::size_t column;
};

// Of the fields lat, lon, name and above those that no column is called, where one means the same: Latitude,
// Name ...
std::vector<OtherName> other_names(const std::vector<std::string>& names) {
    std::vector<OtherName> others;
    const auto add = [&](const char* field, std::optional<std::size_t> column) {
        if (column && std::ranges::find(names, field) == names.end()) others.push_back({field, *column});
    };
    const DegreeColumns degrees = degree_columns(names);
    add("lat", degrees.lat);
    add("lon", degrees.lon);
    for (const char* const field : {"name", "above"}) {
        const auto found = std::ranges::find(names, field, plain_heading);
        if (found != names.end()) add(field, static_cast<std::size_t>(found - names.begin()));
    }
    return others;
}

Result<PlacesOfFile> places_of_table(const std::string& file) {
    ORO_TRY(const TableText table, read_table_text(file));
    const auto in_file = [&](const Error& error) { return Error{error.kind, file, error.what}; };
    Result<CsvRecords> records = CsvRecords::of(table.text);
    if (!records.ok()) return in_file(records.error());
    PlacesOfFile places;
    if (!table.note.empty()) places.notes.push_back(file + ": " + table.note);
    places.headings = records->headings();
    const std::vector<OtherName> others = other_names(places.headings);
    std::vector<CsvField> fields;
    for (;;) {
        const Result<bool> more = records->next(fields);
        if (!more.ok()) return in_file(more.error());
        if (!*more) return places;
        if (places.all.size() == most_places) return too_many(file);
        BatchPlace& place = places.all.emplace_back();
        place.number = places.all.size();
        for (std::size_t i = 0; i < places.headings.size(); ++i)
            place.fields[places.headings[i]] = fields[i].text;
        for (const OtherName& other : others) place.fields[other.field] = fields[other.column].text;
    }
}

std::string degrees_words(double angle_deg) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9f", angle_deg);
    return text;
}

Result<PlacesOfFile> places_of_vectors(const std::string& file) {
    ORO_TRY(const VectorFile vectors, read_vectors(file));
    PlacesOfFile places{{}, {}, vectors.notes};
    std::vector<std::string>& names = places.headings;
    for (const VectorLayer& layer : vectors.layers) {
        bool is_layer_known = false;
        for (const VectorShape& shape : layer.shapes) {
            if (shape.kind != VectorKind::point) continue;
            if (places.all.size() == most_places) return too_many(file);
            BatchPlace& place = places.all.emplace_back();
            place.number = places.all.size();
            for (const std::string& name : layer.fields) {
                place.fields[name] = layer.text(shape, name);
                if (!is_layer_known && std::ranges::find(names, name) == names.end()) names.push_back(name);
            }
            is_layer_known = true;
            for (const char* const name : {"name", "above"})
                if (layer.field_number(name) >= 0) place.fields[name] = layer.text(shape, name);
            const VectorPlace& at = shape.paths.front().front();
            place.fields["lat"] = degrees_words(at.lat_deg);
            place.fields["lon"] = degrees_words(at.lon_deg);
            if (std::isfinite(at.height_m)) place.fields["ele"] = degrees_words(at.height_m);
        }
    }
    return places;
}

// A name of a place must not lead into another folder.
std::string in_file_name(std::string text) {
    std::ranges::replace(text, '/', '_');
    return text == "." || text == ".." ? "_" : text;
}

}  // namespace

std::string BatchPlace::words() const {
    const auto name = fields.find("name");
    return "place " + std::to_string(number) +
           (name == fields.end() || name->second.empty() ? "" : " (" + name->second + ")");
}

Result<PlacesOfFile> read_places(const std::string& file) {
    const std::string lower = lower_case(file);
    const bool is_table = lower.ends_with(".csv") || lower.ends_with(".tsv") || lower.ends_with(".txt");
    ORO_TRY(PlacesOfFile places, is_table ? places_of_table(file) : places_of_vectors(file));
    if (places.all.empty())
        return Error{ErrorKind::failed, file,
                     is_table ? "has no places: the first line names fields, each other one is a place"
                              : "has no points"};
    for (BatchPlace& place : places.all) place.fields["number"] = std::to_string(place.number);
    return places;
}

Result<std::string> with_fields(const std::string& text, const BatchPlace& place, bool is_file_name) {
    std::string whole;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if ((c == '{' || c == '}') && at + 1 < text.size() && text[at + 1] == c) {
            whole += c;
            ++at;
            continue;
        }
        if (c != '{' && c != '}') {
            whole += c;
            continue;
        }
        const std::size_t end = text.find('}', at);
        if (c == '}' || end == std::string::npos)
            return Error{ErrorKind::usage, "", "\"" + text + "\" has a brace alone: {{ and }} are braces"};
        const std::string name = text.substr(at + 1, end - at - 1);
        const auto field = place.fields.find(name);
        if (field == place.fields.end()) {
            std::vector<std::string> names;
            for (const auto& [known, value] : place.fields) names.push_back(known);
            return Error{ErrorKind::usage, "",
                         "there is no field {" + name + "}; these are " + joined(names, " and ")};
        }
        whole += is_file_name ? in_file_name(field->second) : field->second;
        at = end;
    }
    return whole;
}

}  // namespace oro
