#include "apps/window/films.h"

#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "apps/commands/film/film_path.h"
#include "apps/commands/film/movie.h"
#include "apps/commands/film/track_keys.h"
#include "apps/eye/standpoint.h"
#include "apps/film/film_keys.h"
#include "apps/film/tour_kml.h"
#include "apps/film/written_keys.h"
#include "apps/navigation/flight_step.h"
#include "apps/options/option_table.h"
#include "apps/report/figures.h"
#include "apps/view/view_words.h"
#include "apps/window/viewer.h"
#include "apps/window/window_start.h"
#include "core/base/files_read.h"
#include "geo/files/letter_case.h"
#include "geo/files/whole_file.h"

namespace oro {
namespace {

constexpr Limits walk_speed_m_s{0.1, 1e5}, walk_ahead_m{1.0, 1e5}, walk_above_m{eye_clearance_m, 1e5};
constexpr double walk_smoothing_m = 10.0;

void follow(Viewer& viewer, const LineAlong& line, const std::string& name) {
    auto keys = keys_of_walk(line, viewer.film.walk, viewer.region, viewer.view.exaggeration,
                             viewer.view.camera.vertical_fov_deg);
    if (!keys.ok()) return tell(viewer, keys.error());
    tell(viewer, "follows " + name + "; any key stops");
    play(viewer, CameraPath(std::move(*keys)), name + " ends here");
}

// The words that draw a film of a file, after the program's name.
std::vector<std::string> film_words(const std::string& file, const View& view, const std::string& out) {
    std::vector<std::string> words{"film", file};
    for (const auto& part : {region_words(view), look_words(view)})
        words.insert(words.end(), part.begin(), part.end());
    words.insert(words.end(), {"--out", out});
    return words;
}

}  // namespace

Result<std::vector<CameraKey>> keys_of_walk(const LineAlong& line, const LineWalk& walk, const Region& region,
                                            double exaggeration, double vertical_fov_deg) {
    ORO_CHECK(within("speed", walk.speed_m_s, walk_speed_m_s));
    ORO_CHECK(within("height over the ground", walk.above_m, walk_above_m));
    ORO_CHECK(within("way ahead", walk.ahead_m, walk_ahead_m));
    TrackFlight flight;
    flight.above_m = walk.above_m;
    flight.smoothing_m = walk_smoothing_m;
    flight.look_ahead_m = walk.ahead_m;
    flight.duration_s = line.distances_m.back() / walk.speed_m_s;
    flight.vertical_fov_deg = vertical_fov_deg;
    return keys_along_track(line, flight, region, exaggeration);
}

std::string film_command(const std::string& file, const View& view) {
    std::vector<std::string> words =
        film_words(file, view, std::filesystem::path(file).stem().string() + "-frames");
    words.insert(words.begin(), "orograph");
    return shell_line(words) + "\n";
}

void add_shown_view(Viewer& viewer) {
    add_key(viewer.film.keys, viewer.view.camera, viewer.film.gap_s);
}

void play_film(Viewer& viewer, std::size_t from) {
    const std::vector<CameraKey>& keys = viewer.film.keys;
    if (from >= keys.size()) return;
    play(viewer, CameraPath({keys.begin() + static_cast<std::ptrdiff_t>(from), keys.end()}),
         "the film ends here");
}

void open_film(Viewer& viewer) {
    Film& film = viewer.film;
    FilmOptions options;
    options.path = film.file;
    options.view.vertical_fov_deg = viewer.view.camera.vertical_fov_deg;
    // Of a track.
    const std::string name = lower_case(film.file);
    if (!name.ends_with(".json") && !name.ends_with(".kml")) options.line = film.line;
    const Result<WrittenPath> path = read_path(options);
    // It may be saved again.
    forget_file_read(film.file);
    if (!path.ok()) return tell(viewer, path.error());
    auto keys = keys_of(*path, options, viewer.region, viewer.view.exaggeration);
    if (!keys.ok()) return tell(viewer, keys.error());
    film.keys = std::move(*keys);
    // A track is no film: saving must not take its place.
    film.own_file = path->track ? "" : film.file;
    tell(viewer, "opened " + counted(film.keys.size(), "key", "keys") + " of " + film.file);
}

void save_film(Viewer& viewer) {
    Film& film = viewer.film;
    if (film.keys.empty()) return tell(viewer, "there are no keys to save", true);
    const auto N_m = [&](double lat_deg, double lon_deg) {
        return grid_at(viewer.region, lat_deg, lon_deg).field.undulation.at_m(lat_deg, lon_deg);
    };
    const bool is_kml = lower_case(film.file).ends_with(".kml");
    const std::string text =
        is_kml ? keys_to_kml(film.keys, std::filesystem::path(film.file).stem().string(), N_m)
               : keys_to_json(film.keys);
    const Result<void> written = write_whole_file(film.file, text, film.file == film.own_file);
    if (written.ok()) film.own_file = film.file;
    tell_written(viewer, film.file, written);
}

void draw_film(Viewer& viewer) {
    const Film& film = viewer.film;
    if (film.keys.size() < 2) return tell(viewer, "a film needs two views at least: add another one", true);
    const std::string keys = free_picture_name(time_now_s(), "-film.json");
    const std::string stem = keys.substr(0, keys.size() - std::string_view(".json").size());
    const Result<void> written = write_whole_file(keys, keys_to_json(film.keys), false);
    if (!written.ok()) return tell_written(viewer, keys, written);
    CommandToBegin command;
    command.what = "the film";
    const bool is_movie = ffmpeg_in_path(stem + ".mp4").ok();
    command.out = stem + (is_movie ? ".mp4" : "-frames");
    command.folder_of_frames = is_movie ? command.out + ".frames" : command.out;
    const double length_s = film.keys.back().time_s - film.keys.front().time_s;
    command.frames = static_cast<std::size_t>(std::floor(length_s * film.fps + 1e-6)) + 1;
    command.words = film_words(keys, viewer.view, command.out);
    command.words.insert(command.words.end(), {"--fps", all_digits(film.fps), "--quiet"});
    begin_command(viewer, std::move(command));
}

void follow_file(Viewer& viewer, const std::string& file, int line) {
    const Result<LineAlong> read = line_of_file("--overlay", file, line);
    if (!read.ok()) return tell(viewer, read.error());
    follow(viewer, *read, std::filesystem::path(file).filename().string());
}

void follow_measured_line(Viewer& viewer) {
    if (viewer.measuring.found.profile)
        follow(viewer, viewer.measuring.found.profile->line, "the measured line");
}

}  // namespace oro
