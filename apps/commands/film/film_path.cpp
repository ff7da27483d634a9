#include "apps/commands/film/film_path.h"

#include <filesystem>
#include <string>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/commands/film/tour_keys.h"
#include "apps/commands/film/track_keys.h"
#include "apps/report/json_fields.h"
#include "geo/files/letter_case.h"
#include "geo/files/text_encoding.h"

namespace oro {

Result<WrittenPath> read_path(const FilmOptions& options) {
    WrittenPath path;
    const std::string ending = lower_case(std::filesystem::path(options.path).extension().string());
    const double usual_fov_deg = options.view.vertical_fov_deg.value_or(45.0);
    if (ending == ".json") {
        ORO_TRY(std::string bytes, read_text_file(options.path));
        const auto text = utf8_text(std::move(bytes));
        if (!text.ok()) return Error{text.error().kind, options.path, text.error().what};
        const bool is_geojson = text->find("\"coordinates\"") != std::string::npos;
        if (!is_geojson || text->find("\"orograph_path\"") != std::string::npos) {
            ORO_TRY(path.keys, keys_from_json(*text, options.path, usual_fov_deg));
        }
    } else if (ending == ".kml") {
        ORO_TRY(path.stops, read_kml_tour(options.path));
    }
    const bool is_track = path.keys.empty() && path.stops.empty();
    if (is_track) {
        ORO_TRY(path.track, line_of_file("FLIGHT", options.path, options.line));
    } else if (const char* const option = first_track_option(options)) {
        return refused(option, "", "is for tracks, and " + options.path + " says itself where the camera is");
    }
    return path;
}

Result<std::vector<CameraKey>> keys_of(const WrittenPath& path, const FilmOptions& options,
                                       const Region& region, double exaggeration) {
    if (path.track) {
        ORO_TRY(const TrackFlight flight, track_flight(options, path.track->distances_m.back()));
        return keys_along_track(*path.track, flight, region, exaggeration);
    }
    if (!path.stops.empty())
        return keys_of_tour(path.stops, options.view.vertical_fov_deg.value_or(45.0), region, exaggeration,
                            options.path);
    return eyes_over_region(path.keys, region, exaggeration, options.path);
}

}  // namespace oro
