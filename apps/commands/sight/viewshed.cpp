// orograph viewshed: what is seen from one place or several, as a GeoTIFF.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/sight/raster_styles.h"
#include "apps/commands/sight/seen_probability.h"
#include "apps/commands/sight/sight_ground.h"
#include "apps/commands/sight/table_observers.h"
#include "apps/commands/sight/viewshed_question.h"
#include "apps/commands/sight/viewshed_report.h"
#include "apps/cover/canopy_words.h"
#include "apps/options/observers_options.h"
#include "apps/options/region_option_table.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/figures.h"
#include "apps/report/json_fields.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/model_names.h"
#include "apps/view/view.h"
#include "geo/files/letter_case.h"
#include "geo/files/whole_file.h"
#include "geo/places/geodesic.h"
#include "geo/rasters/post_raster.h"

namespace oro {
namespace {

Result<void> check_words(const ViewshedOptions& options, const ObserversOptions& observers) {
    if (options.at.empty() && observers.file.empty())
        return refused("--at", "", "is missing: name the place, e.g. --at 46.67,8.06");
    ORO_CHECK(check_viewshed(options));
    ORO_CHECK(check_observers(observers, options));
    if (options.out.empty()) return refused("--out", "", "is missing: name the file to write (.tif)");
    const std::string name = lower_case(options.out);
    if (!name.ends_with(".tif") && !name.ends_with(".tiff"))
        return refused("--out", options.out, "the file's name must end in .tif");
    return check_may_write(options.out, options.overwrite);
}

void say_canopy_notes(const SightGround& ground, bool quiet) {
    if (!ground.canopy) return;
    for (const std::string& note : ground.canopy->map->notes()) say(quiet, "note: " + note);
    for (const std::string& note : notes_of_canopy(ground.canopy->region)) say(quiet, "note: " + note);
}

// Observers of a table, where there is one.
struct ReportedObservers {
    const ObserversOptions* options;
    std::vector<TableObserver> all;
    ObserverColumns columns;
    std::vector<std::string> notes;
};

void tell_observers(const ReportedObservers& observers, const ViewshedReport& report,
                    nlohmann::ordered_json& json) {
    json["observers_of"] = path_json(observers.options->file);
    if (!observers.options->table.empty()) json["table"] = path_json(observers.options->table);
    json["above_column"] = observers.columns.above;
    json["columns_not_used"] = observers.columns.unused;
    json["left_out"] = nlohmann::ordered_json::array();
    std::size_t i = 0;
    for (const TableObserver& observer : observers.all) {
        if (!observer.has_ground) {
            json["left_out"].push_back(observer.number);
            continue;
        }
        auto& one = json["observers"][i];
        one["number"] = observer.number;
        if (!observer.name.empty()) one["name"] = observer.name;
        one["cells"] = report.each[i].cells;
        one["seen"] = report.each[i].seen;
        ++i;
    }
}

void print_observers(const ReportedObservers& observers, const ViewshedOptions& options) {
    std::printf("Observers: %s\n", observers_words(observers.options->file, observers.all).c_str());
    const std::string unused = unused_words(observers.columns);
    std::printf("Eyes: %s%s\n", eyes_words(observers.columns, options).c_str(),
                unused.empty() ? "" : ("; not used: " + unused).c_str());
}

void tell(const ViewshedOptions& options, const ViewshedReport& report, const Standpoints& stood,
          const SightGround& ground, const std::optional<SeenProbability>& probability,
          const ReportedObservers& observers) {
    const ViewshedQuestion& question = report.question;
    const std::string light = light_words(question.air, question.eyes.front().h_m);
    if (options.json) {
        const double share =
            static_cast<double>(report.seen) / static_cast<double>(std::max<std::size_t>(1, report.cells));
        nlohmann::ordered_json json =
            json_object("file", options.out, "cells", report.cells, "seen", report.seen, "seen_share", share);
        json["observers"] = nlohmann::ordered_json::array();
        for (const Geodetic& eye : question.eyes) json["observers"].push_back(point_json(ground, eye));
        for (std::size_t i = 0; i < stood.moved.size(); ++i)
            json["observers"][i]["on_summit"] = summit_json(stood.moved[i]);
        if (!observers.all.empty()) tell_observers(observers, report, json);
        json["target_m"] = question.target_m;
        json["radius_km"] = question.radius_km;
        json["columns"] = report.window.columns;
        json["rows"] = report.window.rows;
        json["posts_of"] = source_of_posts(report, *ground.grids);
        json["asked_of_the_oracle"] = report.asked;
        json["looking_s"] = report.looking_s;
        json["light"] = light_json(question.air, question.eyes.front().h_m);
        if (probability) json["realisations"] = probability_json(*probability);
        if (ground.canopy) {
            json["canopy"] = canopy_json(*ground.canopy->map, ground.canopy->region);
            json["target_on"] = options.target_on.value_or("ground");
        }
        json["notes"] = all_notes(ground.region);
        for (const std::string& note : observers.notes) json["notes"].push_back(note);
        std::printf("%s\n", json_text(json, true).c_str());
        return;
    }
    std::printf("%s\n", seen_words(report).c_str());
    if (probability) std::printf("%s\n", probable_words(*probability, report.cells).c_str());
    if (!observers.all.empty()) print_observers(observers, options);
    for (std::size_t i = 0; question.are_recorded_one_by_one && i < question.eyes.size(); ++i) {
        std::printf("From: %s\n", eye_text(question.eyes[i], ground.ground()).c_str());
        if (!stood.moved.empty())
            std::printf("Summit: %s\n", summit_words("the observer stands", stood.moved[i]).c_str());
    }
    std::printf("Light: %s\n", light.c_str());
    if (ground.canopy)
        std::printf("%s; targets stand on the %s\n",
                    canopy_words(*ground.canopy->map, ground.canopy->region).c_str(),
                    options.target_on.value_or("ground").c_str());
}

// The raster, and the table where one is asked for: both, or none.
Result<void> write_files(const ViewshedOptions& options, const PostRaster& raster,
                         const ReportedObservers& observers, const ViewshedReport& report,
                         const SightGround& ground) {
    ORO_TRY(WholeFile shed, written_post_raster(options.out, options.overwrite, raster));
    ORO_TRY(std::optional<WholeFile> style_of_qgis,
            style_beside(options.out, raster.bands.size(), viewshed_qml));
    std::vector<WholeFile*> files;
    if (style_of_qgis) files.push_back(&*style_of_qgis);
    if (observers.options->table.empty()) {
        files.push_back(&shed);
        return commit_together(files);
    }
    ORO_TRY(WholeFile table, WholeFile::create(observers.options->table, options.overwrite));
    const std::string text = observers_csv(observers.all, report, ground);
    ORO_CHECK(table.write(text.data(), text.size()));
    files.insert(files.end(), {&table, &shed});
    return commit_together(files);
}

// The sides on which a circle leaves the box of the data.
std::string sides_beyond(const ViewshedReport& report, const PostGrid& grid) {
    constexpr std::array<const char*, 4> names{"north", "east", "south", "west"};
    std::array<bool, 4> beyond{};
    const double middle_deg = 0.5 * (grid.west_deg() + grid.east_deg());
    for (const Geodetic& eye : report.question.eyes) {
        const double eye_deg = middle_deg + std::remainder(eye.lon_deg - middle_deg, 360.0);
        const auto rim = [&](double bearing_deg) {
            return geodesic_towards(eye.lat_deg, eye.lon_deg, bearing_deg,
                                    report.question.radius_km * 1000.0);
        };
        if (grid.net) {
            for (std::size_t side = 0; side < names.size(); ++side) {
                const auto there = rim(90.0 * static_cast<double>(side));
                const PostNumber post = grid.post_at(there.lat_deg, there.lon_deg);
                beyond[side] |= !(post.row >= 0.0 && post.row <= grid.rows() - 1.0 && post.column >= 0.0 &&
                                  post.column <= grid.columns() - 1.0);
            }
            continue;
        }
        beyond[0] |= rim(0.0).lat_deg > grid.north_deg();
        beyond[2] |= rim(180.0).lat_deg < grid.south_deg();
        if (grid.wraps_longitude()) continue;
        beyond[1] |= eye_deg + std::remainder(rim(90.0).lon_deg - eye.lon_deg, 360.0) > grid.east_deg();
        beyond[3] |= eye_deg + std::remainder(rim(270.0).lon_deg - eye.lon_deg, 360.0) < grid.west_deg();
    }
    std::string said;
    for (std::size_t side = 0; side < names.size(); ++side)
        if (beyond[side]) said += (said.empty() ? "" : ", ") + std::string(names[side]);
    return said;
}

void say_walls(const Standpoints& standpoints, const ViewshedQuestion& question, bool quiet) {
    if (!question.are_recorded_one_by_one) {
        if (!standpoints.walls.empty())
            say(quiet, "note: " + counted(standpoints.walls.size(), "observer has", "observers have") +
                           " a summit before the eye; --on-summit stands there");
        return;
    }
    const std::size_t eyes = question.eyes.size();
    for (const auto& [at, wall] : standpoints.walls) {
        if (eyes == 1)
            say_wall(wall, quiet);
        else
            say(quiet, "note: --at " + at + ": " + wall_words(wall) + "; --on-summit stands there");
    }
}

// Which posts the file has, where it is not plain.
void say_posts(const ViewshedReport& report, const SightGround& ground, bool quiet) {
    if (ground.ground().grids() > 1)
        say(quiet, "note: the file has the posts of " + source_of_posts(report, *ground.grids) +
                       "; where other grids are the ground, it is their ground that is looked at");
    const PostGrid& grid = ground.ground().surface(report.grid).field().grid;
    if (const std::string sides = sides_beyond(report, grid); !sides.empty())
        say(quiet, "note: the circle reaches beyond the data (" + sides +
                       "): what is seen there is not in the file");
}

}  // namespace

Result<void> run_viewshed(const ViewshedOptions& options, const RealisationOptions& realisations,
                          const ObserversOptions& of_table) {
    ORO_CHECK(check_words(options, of_table));
    ORO_CHECK(check_realisations(realisations));
    ORO_CHECK(check_target_on(options));
    ReportedObservers observers{&of_table, {}, {}, {}};
    if (!of_table.file.empty()) {
        ORO_TRY(ObserversOfFile read, read_observers(of_table, options));
        observers = {&of_table, std::move(read.all), std::move(read.columns), std::move(read.notes)};
    }
    ViewshedQuestion question;
    ORO_CHECK(begin_question(options, question));
    question.are_recorded_one_by_one = of_table.file.empty();
    ORO_TRY(const SightCover cover, open_sight_cover(options.view));
    ProgressBar bar(options.quiet);
    ORO_TRY(const auto ground, open_sight_ground(options.region, bar.progress(), cover));
    std::vector<FilesToSpare> inputs{files_of_ground(options.region.paths, ground->region),
                                     {files_of_cover(cover), "which is land cover or a canopy"}};
    if (!of_table.file.empty()) inputs.push_back({{of_table.file}, "which the observers are in"});
    ORO_CHECK(spare_inputs({options.out}, inputs));
    if (!of_table.table.empty()) ORO_CHECK(spare_inputs({of_table.table}, inputs, "--table"));
    Standpoints standpoints;
    ORO_CHECK(find_ground(of_table.file, *ground, observers.all));
    ORO_CHECK(check_above_ground(of_table.file, observers.columns, *ground, observers.all));
    const std::vector<Standing> standings =
        of_table.file.empty() ? asked_eyes(options) : standings_of(observers.all);
    ORO_CHECK(
        place_eyes(standings, options.target_on.value_or("") == "canopy", *ground, question, standpoints));
    std::optional<MeshRoofs> roofs;
    if (options.target_on == "top" && !ground->region.meshes)
        return refused("--target-on", "top", "needs a mesh: --mesh-file FILE");
    if (options.target_on == "top")
        question.roofs = &roofs.emplace(ground->region, ground->ground().exaggeration());
    const RegionGround& hiding = ground->canopy ? *ground->canopy->grids : *ground->grids;
    ORO_TRY(ViewshedReport report,
            viewshed_report(question, hiding, [&](double share) { bar.show(share, "looking around"); }));
    std::optional<SeenProbability> probability;
    if (realisations.count) {
        ORO_TRY(probability, seen_probability(realisations, report, *ground, standings, [&](double share) {
                    bar.show(share, "looking around in realisations");
                }));
    }
    bar.show(1.0, "writing");
    PostRaster raster = raster_of(report, *ground->grids);
    add_canopy_tags(*ground, options.target_on.value_or("ground"), raster);
    if (probability) add_probability(*probability, raster);
    ORO_CHECK(write_files(options, raster, observers, report, *ground));
    bar.clear();
    say_notes(ground->region, options.quiet);
    for (const std::string& note : observers.notes) say(options.quiet, "note: " + note);
    say_canopy_notes(*ground, options.quiet);
    say_walls(standpoints, question, options.quiet);
    say_posts(report, *ground, options.quiet);
    tell(options, report, standpoints, *ground, probability, observers);
    return {};
}

}  // namespace oro
