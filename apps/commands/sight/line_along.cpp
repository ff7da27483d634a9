#include "apps/commands/sight/line_along.h"

#include <algorithm>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/eye/standpoint.h"
#include "apps/report/figures.h"
#include "core/base/file_there.h"

namespace oro {
namespace {

Result<std::vector<LatLon>> places_in(const std::string& text) {
    std::vector<LatLon> places;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(';', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        begin = end + 1;
        // A last ; ends the list.
        if (begin > text.size() && word.find_first_not_of(' ') == std::string::npos) break;
        ORO_TRY(const Place place, place_at("--along", word));
        places.push_back({place.lat_deg, place.lon_deg});
    }
    return places;
}

// A line of a file: one record's paths, one after the other.
struct FileLine {
    const VectorLayer* layer;
    std::size_t record;
    std::vector<const VectorShape*> shapes;
};

std::vector<FileLine> lines_of(const VectorFile& file) {
    std::vector<FileLine> lines;
    for (const VectorLayer& layer : file.layers) {
        for (const VectorShape& shape : layer.shapes) {
            if (shape.kind != VectorKind::line) continue;
            if (lines.empty() || lines.back().layer != &layer || lines.back().record != shape.record)
                lines.push_back({&layer, shape.record, {}});
            lines.back().shapes.push_back(&shape);
        }
    }
    return lines;
}

Result<LineAlong> line_in_file(const std::string& path, const std::optional<int>& number) {
    ORO_TRY(const VectorFile file, read_vectors(path));
    const std::vector<FileLine> lines = lines_of(file);
    if (lines.empty())
        return Error{ErrorKind::usage, path,
                     "holds no line, but " + counted(file.count(VectorKind::point), "point", "points") +
                         " and " + counted(file.count(VectorKind::polygon), "polygon", "polygons")};
    if (!number && lines.size() > 1)
        return Error{ErrorKind::usage, path,
                     "holds " + grouped(lines.size()) + " lines: say which by --line 1 to " +
                         std::to_string(lines.size())};
    const auto which = static_cast<std::size_t>(number.value_or(1)) - 1;
    if (which >= lines.size())
        return refused("--line", std::to_string(*number),
                       path + " holds " + counted(lines.size(), "line", "lines") + " only");
    LineAlong line;
    line.file = path;
    line.notes = file.notes;
    for (const VectorShape* const shape : lines[which].shapes) {
        for (const VectorPlace& place : shape->paths.front())
            line.places.push_back({place.lat_deg, place.lon_deg});
    }
    if (lines[which].shapes.size() > 1)
        line.notes.push_back(path + ": the line is in " + grouped(lines[which].shapes.size()) +
                             " parts; what lies between them is crossed by the shortest way");
    return line;
}

// Measures the ways from place to place.
Result<void> measure(const std::string& option, const std::string& text, LineAlong& line) {
    line.distances_m.push_back(0.0);
    for (std::size_t i = 1; i < line.places.size(); ++i) {
        const LatLon &from = line.places[i - 1], &to = line.places[i];
        const GeodesicPath path = geodesic_between(from.lat_deg, from.lon_deg, to.lat_deg, to.lon_deg);
        line.distances_m.push_back(line.distances_m.back() + path.distance_m);
        line.bearings_deg.push_back(path.bearing_deg);
    }
    if (!(line.distances_m.back() > 0.0)) return refused(option, text, "has no length");
    return {};
}

}  // namespace

Result<LineAlong> line_of_file(const std::string& option, const std::string& file,
                               const std::optional<int>& number) {
    ORO_TRY(LineAlong line, line_in_file(file, number));
    ORO_CHECK(measure(option, file, line));
    return line;
}

Result<LineAlong> line_along(const std::string& text, const std::optional<int>& number) {
    LineAlong line;
    ORO_TRY(const bool there, is_there(text));
    if (there || text.find(';') == std::string::npos) {
        if (!there && parse_place(text).ok())
            return refused("--along", text, "is one place: a line has two or more, with ; between them");
        ORO_TRY(line, line_in_file(text, number));
    } else {
        if (number) return refused("--line", std::to_string(*number), "is for files with several lines");
        ORO_TRY(line.places, places_in(text));
        if (line.places.size() < 2)
            return refused("--along", text, "is one place: a line has two or more, with ; between them");
    }
    ORO_CHECK(measure("--along", text, line));
    return line;
}

Result<LineAlong> line_through(const std::string& option, std::vector<LatLon> places) {
    LineAlong line;
    line.places = std::move(places);
    ORO_CHECK(measure(option, "", line));
    return line;
}

std::vector<std::string> names_of_lines(const VectorFile& file) {
    std::vector<std::string> names;
    for (const FileLine& line : lines_of(file)) {
        const std::string_view name = line.layer->text(*line.shapes.front(), "name");
        names.push_back(name.empty() ? "line " + std::to_string(names.size() + 1) : std::string(name));
    }
    return names;
}

LatLon place_on_leg(const LineAlong& line, std::size_t leg, double along_m) {
    const LatLon& from = line.places[leg];
    return geodesic_towards(from.lat_deg, from.lon_deg, line.bearings_deg[leg],
                            along_m - line.distances_m[leg]);
}

LatLon place_on_line(const LineAlong& line, double along_m) {
    const auto after = std::upper_bound(line.distances_m.begin() + 1, line.distances_m.end() - 1, along_m);
    return place_on_leg(line, static_cast<std::size_t>(after - line.distances_m.begin()) - 1, along_m);
}

}  // namespace oro
