// orograph film: the numbered pictures of a camera's path, or a movie of them.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/film/film_frames.h"
#include "apps/commands/film/film_path.h"
#include "apps/commands/film/movie.h"
#include "apps/drawing/kept_drawing.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/eye/standpoint.h"
#include "apps/film/frame_range.h"
#include "apps/legend/legend.h"
#include "apps/options/option_table.h"
#include "apps/output/overwrite_guard.h"
#include "apps/output/pose_files.h"
#include "apps/report/figures.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "core/base/elapsed.h"
#include "core/base/file_there.h"
#include "core/base/files_read.h"
#include "geo/files/letter_case.h"
#include "geo/files/network_paths.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

constexpr Limits frames_a_second{0.01, 1000.0};

// Where the frames go, and the movie that is made of them.
struct FilmFiles {
    std::string folder;
    std::string ending;  // of frames: ".png"
    std::string movie;   // "": none
    std::string ffmpeg;

    [[nodiscard]] std::string frame(std::int64_t number) const {
        return (fs::path(folder) / frame_name(number, ending)).string();
    }
};

// A frame that is to be drawn, or is there already.
struct FilmFrame {
    std::int64_t number{};
    CameraKey key;
    std::int64_t time_utc_s{};
    bool is_there{};
    int legend_px{};  // of one that is there
};

struct FilmReport {
    std::int64_t frames{};  // of the whole film
    std::int64_t drawn{};
    std::int64_t kept{};
    std::size_t scenes{};
    std::size_t labels{};  // names on all that were drawn
    double read_s{};
    double draw_s{};
};

// What can be refused before anything is read.
Result<FilmFiles> film_files(const FilmOptions& options) {
    FilmFiles files;
    files.ending = "." + options.format;
    if (options.out.empty()) {
        if (!options.write_path.empty()) return files;
        return refused("--out", "", "is missing: name a folder for the frames, or an .mp4");
    }
    files.folder = options.out;
    const std::string ending = lower_case(fs::path(options.out).extension().string());
    if (ending == ".mp4") {
        if (const char* const part = !options.frames.empty()  ? "--frames"
                                     : !options.shard.empty() ? "--shard"
                                                              : nullptr)
            return refused(part, "", "draws a part of the frames: name a folder in --out, not an .mp4");
        if (options.kml || options.geopose || options.stac)
            return refused(options.kml       ? "--kml"
                           : options.geopose ? "--geopose"
                                             : "--stac",
                           "", "is written beside frames: name a folder in --out, not an .mp4");
        ORO_TRY(files.ffmpeg, ffmpeg_in_path(options.out));
        files.movie = options.out;
        files.folder = options.out + ".frames";
        ORO_TRY(const bool there, is_there(files.movie));
        if (there && !options.overwrite)
            return Error{ErrorKind::failed, files.movie, "is there already (--overwrite replaces it)"};
    } else if (picture_format(options.out).ok()) {
        return refused("--out", options.out, "is a picture: name a folder for the frames, or an .mp4");
    }
    return files;
}

Result<void> check_words(const FilmOptions& options) {
    ORO_CHECK(within("--fps", options.fps, frames_a_second));
    if (options.view.tolerance)
        return refused("--tolerance", "", "is for shot: give --accuracy or --tau to a film");
    return {};
}

// The second at which a film begins whose path tells none: the one that is asked for; else that of frames
// that are there, so that a film goes on as it began; else now.
Result<std::int64_t> first_second(const FilmOptions& options, const FilmFiles& files, const View& view,
                                  std::int64_t frames) {
    if (options.view.time || std::getenv("SOURCE_DATE_EPOCH")) return view.time_utc_s;
    for (std::int64_t number = 1; number <= frames; ++number) {
        const std::string file = files.frame(number);
        ORO_TRY(const bool there, is_there(file));
        if (!there) continue;
        const auto text = read_view_json(file);
        forget_file_read(file);
        const auto read = text.ok() ? view_from_json(*text, file) : Result<View>(text.error());
        if (!read.ok()) continue;
        const double since_s = static_cast<double>(number - 1) / options.fps;
        return read->time_utc_s - static_cast<std::int64_t>(std::floor(since_s + 1e-6));
    }
    if (!options.shard.empty() || !options.frames.empty())
        return refused("--time", "",
                       "is missing: the parts of a film must agree on their time, and its path tells none");
    return view.time_utc_s;
}

Result<void> open_film(const FilmOptions& options, ProgressBar& bar, View& view, Region& region) {
    ORO_CHECK(open_view("", options.view, options.region, bar.progress(), view, region));
    if (options.no_legend) view.legend = false;
    if (!options.no_legend && !options.view.legend) view.legend = has_own_legend(view);
    if (options.no_paths) view.tells_paths = false;
    // view.mesh tells what is drawn from then on.
    if (const auto drawn = draws_terrain_clusters(region, view); !drawn.ok()) return drawn.error();
    bar.clear();
    say_notes(region, options.quiet);
    if (const std::string note = note_of_year(view.sun); !note.empty()) say(options.quiet, note);
    if (view.vectors_read) say_vectors(*view.vectors_read, view.vectors, options.quiet);
    return {};
}

Result<void> write_keys(const FilmOptions& options, const View& view, const Region& region,
                        const std::vector<CameraKey>& keys) {
    if (options.write_path.empty()) return {};
    ORO_CHECK(spare_inputs({options.write_path},
                           {files_of_picture(view, region), {{options.path}, "which is the camera's path"}}));
    const std::string text = keys_to_json(keys);
    ORO_TRY(const bool there, is_there(options.write_path));
    if (there && !options.overwrite) {
        const auto now = read_own_text_file(options.write_path);
        if (now.ok() && *now == text) return {};
        return Error{ErrorKind::failed, options.write_path,
                     "is there already, and tells another path (--overwrite replaces it)"};
    }
    ORO_CHECK(write_whole_file(options.write_path, text, options.overwrite));
    say(options.quiet, "wrote " + options.write_path);
    return {};
}

// What a command tells that writes the path and draws nothing.
void tell_path(const FilmOptions& options, const CameraPath& path) {
    if (!options.json) return;
    const nlohmann::ordered_json json =
        json_object("path", options.write_path, "duration_s", path.duration_s(), "keys", path.keys().size());
    std::printf("%s\n", json_text(json, true).c_str());
}

// The frames that are asked for, with their views.
Result<std::vector<FilmFrame>> frames_of(const FilmOptions& options, const FilmFiles& files,
                                         const CameraPath& path, const View& view, FilmReport& report) {
    ORO_TRY(report.frames, frame_count(path.duration_s(), options.fps));
    ORO_TRY(const FrameRange range, frame_range(options.frames, options.shard, report.frames));
    const bool has_clock = path.at(path.keys().front().time_s).time_utc_s.has_value();
    std::int64_t begins_s = 0;
    if (!has_clock) {
        ORO_TRY(begins_s, first_second(options, files, view, report.frames));
    }
    std::vector<FilmFrame> frames;
    for (std::int64_t number = range.first; number <= range.last; ++number) {
        if (!range.holds(number)) continue;
        const double since_s = static_cast<double>(number - 1) / options.fps;
        const CameraKey key = path.at(path.keys().front().time_s + since_s);
        const std::int64_t time_s =
            key.time_utc_s.value_or(begins_s + static_cast<std::int64_t>(std::floor(since_s + 1e-6)));
        if (!view_limits::time_utc_s.hold(static_cast<double>(time_s)))
            return refused("--time", "", "the film leaves the years 0 to 9999");
        frames.push_back({number, key, time_s, false, 0});
    }
    return frames;
}

// Which frames need not be drawn. One that is there and another is an error, before anything is drawn, unless
// it may be replaced: on the way to a movie, or by --overwrite.
Result<void> look_at_files(const FilmOptions& options, const FilmFiles& files, FilmFrames& film,
                           ProgressBar& bar, std::vector<FilmFrame>& frames) {
    for (FilmFrame& frame : frames) {
        const std::string file = files.frame(frame.number);
        ORO_TRY(const bool there, is_there(file));
        if (!there) continue;
        bar.show(static_cast<double>(&frame - frames.data()) / static_cast<double>(frames.size()),
                 "reading frames that are there");
        View view = film.view_of(frame.key, frame.time_utc_s);
        ORO_TRY(frame.is_there, film.is_drawn(file, view));
        frame.legend_px = view.legend_px;
        if (frame.is_there || options.overwrite || !files.movie.empty()) continue;
        return Error{ErrorKind::failed, file,
                     "is there already, and is no whole frame of this film (--overwrite draws it anew)"};
    }
    return {};
}

// The poses of a frame that are not there yet, without names. Errors: one that is another, unless it may be
// replaced.
Result<std::vector<WholeFile>> missing_poses(const FilmOptions& options, const std::string& file,
                                             const View& view, const Region& region) {
    ORO_TRY(std::vector<PoseText> texts,
            pose_texts(file, poses_asked(options), view, pose_facts(view, region)));
    std::vector<PoseText> missing;
    for (PoseText& one : texts) {
        ORO_TRY(const bool there, is_there(one.file));
        if (there) {
            const auto text = read_own_text_file(one.file);
            if (text.ok() && *text == one.text) continue;
            if (!options.overwrite)
                return Error{ErrorKind::failed, one.file,
                             "is there already, and tells another pose (--overwrite replaces it)"};
        }
        missing.push_back(std::move(one));
    }
    return pose_files(missing, options.overwrite);
}

Result<void> draw_frames(const FilmOptions& options, const FilmFiles& files, const Region& region,
                         FilmFrames& film, ProgressBar& bar, const std::vector<FilmFrame>& frames,
                         FilmReport& report) {
    const bool overwrite = options.overwrite || !files.movie.empty();
    const auto count = static_cast<double>(frames.size());
    for (const FilmFrame& frame : frames) {
        const auto done = static_cast<double>(report.drawn + report.kept);
        const std::string file = files.frame(frame.number);
        View view = film.view_of(frame.key, frame.time_utc_s);
        view.legend_px = frame.legend_px;
        std::vector<WholeFile> together;
        std::optional<DrawnPicture> picture;
        if (!frame.is_there) {
            const std::string what = "drawing frame " + grouped(static_cast<std::uint64_t>(frame.number)) +
                                     " of " + grouped(static_cast<std::uint64_t>(report.frames));
            ORO_TRY(picture, film.draw(file, overwrite, view,
                                       [&](double share) { bar.show((done + share) / count, what); }));
        }
        ORO_TRY(together, missing_poses(options, file, view, region));
        if (picture) {
            report.labels += picture->names.labels.size();
            together.push_back(std::move(picture->file));
        }
        std::vector<WholeFile*> names;
        for (WholeFile& one : together) names.push_back(&one);
        ORO_CHECK(commit_together(names));
        ++(frame.is_there ? report.kept : report.drawn);
    }
    return {};
}

Result<void> make_folder(const std::string& folder) {
    std::error_code failed;
    fs::create_directories(folder, failed);
    if (!failed && fs::is_directory(folder, failed) && !failed) return {};
    return Error{ErrorKind::failed, folder,
                 "is no folder for frames" + (failed ? ": " + failed.message() : std::string())};
}

// The frames have done what they were for.
void remove_frames(const FilmFiles& files) {
    std::error_code ignored;
    for (fs::directory_iterator entry(files.folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored)) {
        const std::string name = entry->path().filename().string();
        std::error_code also_ignored;
        if (name.starts_with("frame-") && name.ends_with(files.ending))
            fs::remove(entry->path(), also_ignored);
    }
    fs::remove(files.folder, ignored);
}

void tell(const FilmOptions& options, const FilmFiles& files, const CameraPath& path,
          const FilmReport& report) {
    const auto of = [](std::int64_t number) { return static_cast<std::uint64_t>(number); };
    if (!options.view.names.empty() && report.drawn > 0 && report.labels == 0)
        say(options.quiet,
            "note: of the names none shows in the frames that were drawn: they are hidden behind the "
            "ground, outside of the view, or beyond the data");
    if (report.kept > 0)
        say(options.quiet, counted(of(report.kept), "frame was", "frames were") + " there already");
    if (!files.movie.empty())
        say(options.quiet, "wrote " + files.movie);
    else
        say(options.quiet, "wrote " + counted(of(report.drawn), "frame", "frames") + " into " + files.folder);
    if (!options.json) return;
    const nlohmann::ordered_json json =
        json_object("out", options.out, "frames",
                    json_object("of_the_film", report.frames, "drawn", report.drawn, "kept", report.kept),
                    "fps", options.fps, "duration_s", path.duration_s(), "keys", path.keys().size(), "scenes",
                    report.scenes, "times_s", json_object("read", report.read_s, "draw", report.draw_s));
    std::printf("%s\n", json_text(json, true).c_str());
}

Result<void> film_it(const FilmOptions& options, const FilmFiles& files, const CameraPath& path,
                     ProgressBar& bar, View& view, Region& region, FilmReport& report) {
    const auto drawing = Clock::now();
    ORO_TRY(const std::shared_ptr<const Gpu> gpu, gpu_to_draw_with());
    FilmFrames film(options, *gpu, view, region);
    ORO_TRY(std::vector<FilmFrame> frames, frames_of(options, files, path, view, report));
    std::vector<std::string> written;
    for (const FilmFrame& frame : frames) {
        written.push_back(files.frame(frame.number));
        for (const std::string& pose : pose_paths(written.back(), poses_asked(options)))
            written.push_back(pose);
    }
    if (!files.movie.empty()) written.push_back(files.movie);
    ORO_CHECK(spare_inputs(written,
                           {files_of_picture(view, region), {{options.path}, "which is the camera's path"}}));
    ORO_CHECK(make_folder(files.folder));
    ORO_CHECK(look_at_files(options, files, film, bar, frames));
    std::vector<Camera> cameras;
    for (const FilmFrame& frame : frames)
        if (!frame.is_there) cameras.push_back(film.view_of(frame.key, frame.time_utc_s).camera);
    film.set_frames(std::move(cameras));
    ORO_CHECK(draw_frames(options, files, region, film, bar, frames, report));
    report.scenes = film.scenes_made();
    if (!files.movie.empty()) {
        bar.show(1.0, "making the movie");
        ORO_CHECK(write_movie(files.ffmpeg, {files.folder, files.ending, report.frames, options.fps},
                              files.movie, options.overwrite));
        remove_frames(files);
    }
    report.draw_s = seconds_since(drawing);
    return {};
}

}  // namespace

Result<void> run_film(const FilmOptions& options) {
    ORO_CHECK(check_words(options));
    ORO_CHECK(check_on_this_machine(options.out));
    ORO_TRY(const FilmFiles files, film_files(options));
    ORO_TRY(const WrittenPath written, read_path(options));
    ProgressBar bar(options.quiet);
    FilmReport report;
    View view;
    Region region;
    const auto reading = Clock::now();
    ORO_CHECK(open_film(options, bar, view, region));
    if (written.track)
        for (const std::string& note : written.track->notes) say(options.quiet, "note: " + note);
    ORO_TRY(std::vector<CameraKey> keys, keys_of(written, options, region, view.exaggeration));
    ORO_CHECK(write_keys(options, view, region, keys));
    const CameraPath path(std::move(keys));
    report.read_s = seconds_since(reading);
    if (options.out.empty()) {
        bar.clear();
        tell_path(options, path);
        return {};
    }
    ORO_CHECK(film_it(options, files, path, bar, view, region, report));
    bar.clear();
    tell(options, files, path, report);
    return {};
}

}  // namespace oro
