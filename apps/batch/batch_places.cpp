#include "apps/batch/batch_places.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/search/text_lines.h"
#include "geo/files/letter_case.h"
#include "geo/vectors/coordinate_columns.h"
#include "geo/vectors/vector_file.h"

namespace oro {
namespace {

constexpr std::size_t most_places = 1'000'000;

// The fields of a line of a table, by RFC 4180 but that a text with quotes ends with its line.
std::vector<std::string> fields_of_line(const std::string& line, char separator) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += line[++i];
        } else if (c == '"' && (quoted || fields.back().empty())) {
            quoted = !quoted;
        } else if (c == separator && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

char separator_of(const std::string& first_line) {
    for (const char c : {'\t', ';'})
        if (first_line.find(c) != std::string::npos) return c;
    return ',';
}

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

std::string without_blanks_around(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

Result<std::vector<BatchPlace>> places_of_table(const std::string& file, std::vector<std::string>& names) {
    ORO_TRY(TextLines lines, TextLines::of(file));
    std::vector<BatchPlace> places;
    std::vector<OtherName> others;
    char separator = ',';
    std::string line;
    while (true) {
        ORO_TRY(const bool more, lines.next(line));
        if (!more) break;
        const auto fault = [&](const std::string& what) {
            return Error{ErrorKind::failed, file, "line " + std::to_string(lines.number()) + " " + what};
        };
        if (lines.is_cut()) return fault("is longer than 64 KiB");
        if (line.find('\0') != std::string::npos) return fault("is no text");
        if (line.find_first_not_of(" \t") == std::string::npos) continue;
        if (names.empty()) {
            separator = separator_of(line);
            names = fields_of_line(line, separator);
            others = other_names(names);
            continue;
        }
        const std::vector<std::string> fields = fields_of_line(line, separator);
        if (fields.size() > names.size())
            return fault("has " + std::to_string(fields.size()) + " fields, and the first line names " +
                         std::to_string(names.size()));
        if (places.size() == most_places) return too_many(file);
        BatchPlace& place = places.emplace_back();
        place.number = places.size();
        for (std::size_t i = 0; i < names.size(); ++i)
            place.fields[names[i]] = i < fields.size() ? fields[i] : "";
        for (const OtherName& other : others)
            place.fields[other.field] =
                other.column < fields.size() ? without_blanks_around(fields[other.column]) : "";
    }
    return places;
}

std::string degrees_words(double angle_deg) {
    char text[40];
    std::snprintf(text, sizeof text, "%.9f", angle_deg);
    return text;
}

Result<std::vector<BatchPlace>> places_of_vectors(const std::string& file, std::vector<std::string>& names) {
    ORO_TRY(const VectorFile vectors, read_vectors(file));
    std::vector<BatchPlace> places;
    for (const VectorLayer& layer : vectors.layers) {
        bool is_layer_known = false;
        for (const VectorShape& shape : layer.shapes) {
            if (shape.kind != VectorKind::point) continue;
            if (places.size() == most_places) return too_many(file);
            BatchPlace& place = places.emplace_back();
            place.number = places.size();
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

Result<std::vector<BatchPlace>> read_places(const std::string& file) {
    std::vector<std::string> headings;
    return read_places(file, headings);
}

Result<std::vector<BatchPlace>> read_places(const std::string& file, std::vector<std::string>& headings) {
    headings.clear();
    const std::string lower = lower_case(file);
    const bool is_table = lower.ends_with(".csv") || lower.ends_with(".tsv") || lower.ends_with(".txt");
    ORO_TRY(std::vector<BatchPlace> places,
            is_table ? places_of_table(file, headings) : places_of_vectors(file, headings));
    if (places.empty())
        return Error{ErrorKind::failed, file,
                     is_table ? "has no places: the first line names fields, each other one is a place"
                              : "has no points"};
    for (BatchPlace& place : places) place.fields["number"] = std::to_string(place.number);
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
