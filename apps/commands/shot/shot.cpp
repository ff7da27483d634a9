// orograph shot: from files to a picture that knows where it was taken from.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "apps/accuracy/verification.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/commands/shot/shot_files.h"
#include "apps/commands/shot/shot_json.h"
#include "apps/commands/shot/shot_scene.h"
#include "apps/commands/shot/shot_views.h"
#include "apps/drawing/drape.h"
#include "apps/drawing/kept_drawing.h"
#include "apps/drawing/mesh_choice.h"
#include "apps/drawing/near_mesh_words.h"
#include "apps/drawing/picking.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/eye/standpoint.h"
#include "apps/layers/picture_layers.h"
#include "apps/legend/legend.h"
#include "apps/maps/ortho_map.h"
#include "apps/options/region_option_table.h"
#include "apps/output/overwrite_guard.h"
#include "apps/output/picture_file.h"
#include "apps/output/pose_files.h"
#include "apps/report/figures.h"
#include "apps/report/json_text.h"
#include "apps/report/near_trees_words.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/resampling_words.h"
#include "apps/report/summit_words.h"
#include "apps/view/accuracy.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "apps/view/view_changes.h"
#include "core/base/elapsed.h"
#include "core/base/files_read.h"
#include "core/lod/ground_means.h"
#include "core/terrain/ground.h"
#include "geo/places/bounding_box.h"
#include "geo/refined/refined_region.h"
#include "geo/together/rim_diagonals.h"

namespace oro {
namespace {

// What was printed with a picture of several views before, and is not printed again.
using ReportedNotes = std::set<std::string>;

void say_notes(const ShotOptions& options, const ShotResult& shot, ReportedNotes& reported_notes) {
    for (const std::string& note : all_notes(shot.region))
        if (reported_notes.insert(note).second) say(options.quiet, "note: " + note);
    say_summit(shot.on_summit, options.quiet);
    say_wall(shot.view.stood.wall, options.quiet);
    if (const std::string note = note_of_year(shot.view.sun); !note.empty()) say(options.quiet, note);
    if (shot.view.vectors_read) say_vectors(*shot.view.vectors_read, shot.view.vectors, options.quiet);
    const Geodetic& eye = shot.view.camera.eye;
    if (shot.view.map && options.crs) {
        const std::string note = note_of_map_area(*shot.view.map, {eye.lat_deg, eye.lon_deg});
        if (!note.empty()) say(options.quiet, "note: " + note);
    }
    const auto ground = ground_h_m(grid_at(shot.region, eye.lat_deg, eye.lon_deg).field, eye.lat_deg,
                                   eye.lon_deg, shot.view.exaggeration);
    if (ground && eye.h_m < *ground) {
        char text[80];
        std::snprintf(text, sizeof text, "note: the eye is %.1f m below the ground", *ground - eye.h_m);
        say(options.quiet, text);
    }
}

// What lies over the coarsest ground: files, or what --detail has invented.
const char* ground_over_others(const Region& region) {
    if (detail_of(region) == nullptr) return "finer ground";
    return region.grids.size() == 2 ? "invented ground (--detail)" : "finer or invented ground";
}

// Where finer ground changes what coarser ground is beside it.
void say_rims(const Region& region, const RegionCuts& cuts, bool quiet) {
    const std::vector<RegionGrid>& grids = region.grids;
    for (std::size_t i = 0; i < grids.size(); ++i) {
        const auto found = rim_diagonals(grids[i].field, cuts.grids[i]);
        if (!found) continue;
        char text[240];
        std::snprintf(text, sizeof text,
                      ", within two posts of %s, is split along other diagonals than by itself: %s, up "
                      "to %.1f m apart (at %.6f %.6f)",
                      ground_over_others(region), counted(found->cells, "cell", "cells").c_str(),
                      found->most_m, found->place.lat_deg, found->place.lon_deg);
        const auto& sources = grids[i].sources;
        say(quiet, "note: the ground of " +
                       (sources.empty() ? std::string("a grid")
                                        : std::filesystem::path(sources.front().path).filename().string()) +
                       (sources.size() > 1 ? " and others" : "") + text);
    }
}

// Measures what was drawn, the same way, and makes the picture of its errors, which has no name yet.
Result<WholeFile> verify_shot(const ShotOptions& options, const PictureFiles& files, const ShotGround& ground,
                              const Gpu& gpu, Scene& scene, const Style& style, ShotResult& shot) {
    const auto start = Clock::now();
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(shot.view, shot.region, ground.cuts));
    ORO_TRY(shot.verification, verify_view(shot.view, *truth, gpu, scene, shot.picture.path, style.frame,
                                           shot.meshes ? shot.meshes->cut.meshes.get() : nullptr));
    measure_invented(*shot.verification, shot.view, shot.region);
    ORO_TRY(const std::vector<std::uint8_t> png,
            error_picture_png(*shot.verification, shot.view.tau_px, ErrorPanels::four));
    ORO_TRY(WholeFile file, WholeFile::create(files.error, options.overwrite));
    ORO_CHECK(file.write(png.data(), png.size()));
    shot.times.verify_s = seconds_since(start);
    return file;
}

// The layers of what was drawn, the same way; files without names yet.
Result<std::vector<WholeFile>> layers_of(const ShotOptions& options, const PictureFiles& files,
                                         const ShotGround& ground, const Gpu& gpu, Scene& scene,
                                         const Style& style, ProgressBar& bar, ShotResult& shot) {
    const auto start = Clock::now();
    ORO_TRY(const RasterPath path, choose_path(shot.view.pipeline, gpu));
    ORO_TRY(const PictureLayers layers,
            picture_layers(gpu, scene, shot.view, *ground.grids, style, path,
                           [&](double share) { bar.show(share, "measuring layers"); }));
    shot.layers = LayersReport{layers.ground_px, layers.missed_px};
    ORO_TRY(std::vector<WholeFile> written,
            layer_files(files.picture, options.overwrite, shot.view, shot.region, layers));
    shot.times.layers_s = seconds_since(start);
    return written;
}

// Where the data end: of several views once, unless a later one looks over cells that no other does.
void say_unseen(const ShotOptions& options, const UnseenGround& unseen, ReportedNotes& reported_notes) {
    const std::string note = unseen_note(unseen);
    if (note.empty()) return;
    bool is_new = unseen.missing.empty();
    for (const UnseenCell& one : unseen.missing)
        is_new |= reported_notes.insert(tile_name(one.cell.lat_deg, one.cell.lon_deg)).second;
    if (is_new) say(options.quiet, "note: " + note);
}

// What was drawn and measured.
void tell(const ShotOptions& options, const PictureFiles& files, bool checks, const ShotResult& shot,
          const Gpu& gpu, const Style& style, ReportedNotes& reported_notes) {
    if (!checks) say(options.quiet, "wrote " + files.picture);
    if (!checks && shot.view.map) say(options.quiet, "wrote " + world_file_path(files.picture));
    for (const std::string& pose : pose_paths(files.picture, poses_asked(options)))
        say(options.quiet, "wrote " + pose);
    if (shot.layers)
        for (const char* layer :
             layers_of_view(shot.view.cover != nullptr, has_meshes(shot.view, shot.region)))
            say(options.quiet, "wrote " + layer_path(files.picture, layer));
    // Measurements say it themselves.
    if (!shot.verification) say_unseen(options, shot.unseen, reported_notes);
    if (shot.verification) {
        say(options.quiet, "wrote " + files.error);
        // What was asked for: as a table, or with -q as JSON alone.
        if (!options.quiet || !options.json)
            std::fputs((verification_text(*shot.verification, shot.view, shot.unseen) +
                        resampling_line(shot.region.grids.front()) + light_line(shot.view, shot.region))
                           .c_str(),
                       stderr);
    }
    if (options.json) std::printf("%s\n", json_text(shot_json(shot, files, gpu, style), true).c_str());
}

// Plans and draws; nothing is written when nothing of the region can be in view.
Result<DrawnPicture> draw_shot(const ShotOptions& options, const PictureFiles& files,
                               const RegionGround& ground, const Gpu& gpu, Scene& scene, const Style& style,
                               ProgressBar& bar, ShotResult& shot) {
    const auto drawing = Clock::now();
    // Before anything is written. A page that may be in view, and then is not, is told of when it is drawn.
    const auto nothing = nothing_in_view(shot.view, shot.region, options.view_file);
    ORO_CHECK(check_in_view(shot, options.view_file, scene));
    ORO_TRY(shot.middle, place_in_middle(shot.view, ground));
    ORO_TRY(const std::vector<std::uint8_t> strip,
            strip_of(shot.view, shot.region, style, shot.middle, ground));
    const bool checks = is_check(options, files);
    RepeatedPicture repeated(checks ? files.picture : "", shot.view);
    ORO_TRY(DrawnPicture picture,
            draw_picture(
                checks ? unnamed(files) : files, options.overwrite || checks, shot.view, shot.region, ground,
                shot.middle, gpu, scene, style, strip, [&](double share) { bar.show(share, "drawing"); },
                [&](std::span<const std::uint8_t> row) { return repeated.take(row), Result<void>(); }));
    shot.difference = repeated.found();
    shot.picture = picture.report;
    shot.labels = picture.labels;
    shot.names = picture.names;
    shot.overlay = picture.overlay;
    for (const std::string& note : notes_of(shot.names, !shot.view.vectors.names.empty()))
        say(options.quiet, "note: " + note);
    shot.view.fingerprints = picture.fingerprints;
    shot.times.draw_s = seconds_since(drawing);
    if (const std::string note = near_trees_note(near_trees_share(shot.picture, shot.view.camera));
        !note.empty())
        say(options.quiet, "note: " + note);
    if (const std::string note = near_mesh_note(shot.middle); !note.empty())
        say(options.quiet, "note: " + note);
    if (shot.picture.ground_px == 0)
        say(options.quiet, "note: " + (nothing.ok() ? *nothing : nothing.error().what));
    for (const GridScene& grid : scene.grids()) {
        shot.pages_on_gpu += grid.store().size();
        shot.page_bytes += grid.store().bytes();
        if (const auto& drawn = grid.clusters())
            shot.clusters = ClustersHeld{drawn->store().size(), drawn->store().bytes(),
                                         drawn->groups().size(), drawn->groups().bytes()};
    }
    shot.height_step_m = scene.height_step_m();
    return picture;
}

// The files that tell where a picture was taken from, or where a map lies, without names yet. `shot` is
// drawn.
Result<std::vector<WholeFile>> poses_of(const ShotOptions& options, const PictureFiles& files,
                                        const ShotResult& shot) {
    PoseFacts facts = pose_facts(shot.view, shot.region);
    facts.ground_h_m = shot.middle ? shot.middle->h_m : 0.0;
    ORO_TRY(const std::vector<PoseText> texts,
            pose_texts(files.picture, poses_asked(options), shot.view, facts));
    for (const PoseText& text : texts)
        if (!text.note.empty()) say(options.quiet, "note: " + text.note);
    return pose_files(texts, options.overwrite);
}

// A picture that goes back to where it came from is not spared; what is written beside it is no view.
Result<void> spare_files_of(const ShotOptions& options, const PictureFiles& files, const ShotResult& shot) {
    if (options.out.empty()) let_replace(files.picture);
    std::vector<FilesToSpare> inputs{files_of_picture(shot.view, shot.region)};
    if (!options.out.empty())
        inputs.push_back({{options.view_file}, "which is the view (without --out it is drawn again)"});
    return spare_inputs(written_files(options, files), inputs);
}

// What goes on from one of several views to the next: the region, with the view that it was opened for, and
// the GPU.
struct ShotSeries {
    std::optional<View> opened;
    Region region;
    std::shared_ptr<const Gpu> gpu;
    ReportedNotes reported_notes;
};

// The view of a shot, and its region. listed: the view itself, of several; null: it is in its file, or in
// options.
Result<void> open_view_of(const ShotOptions& options, const View* listed, ProgressBar& bar,
                          ShotSeries& series, ShotResult& shot) {
    const Progress progress = bar.progress();
    if (listed == nullptr)
        return open_view(options.view_file, options.view, options.region, progress, shot.view, shot.region);
    shot.view = *listed;
    shot.region = std::move(series.region);
    ORO_CHECK(open_recorded_view(options.view_file, options.view, options.region, progress, shot.view,
                                 shot.region, PictureKind::plane, series.opened ? &*series.opened : nullptr));
    series.opened = shot.view;
    return {};
}

// All that can be refused before a GPU is asked for: options, data, files to be written. Gives the style.
Result<Style> open_shot(const ShotOptions& options, const PictureFiles& files, const View* listed,
                        ProgressBar& bar, ShotSeries& series, ShotResult& shot) {
    ORO_CHECK(check_out(options, files));
    if (options.view.tolerance) {
        if (options.view.accuracy)
            return refused("--tolerance", "", either_words("--tolerance", "--accuracy"));
        ORO_CHECK(parse_tolerance(*options.view.tolerance));
    }
    const auto reading = Clock::now();
    ORO_CHECK(open_view_of(options, listed, bar, series, shot));
    shot.on_summit = shot.view.stood.summit;
    if (options.ortho && options.view_file.empty()) ORO_CHECK(make_map(shot.view, options, shot.region));
    choose_legend(options, shot.view);
    // A map may lie where no overlay can.
    ORO_CHECK(pose_texts(files.picture, poses_asked(options), shot.view, {}));
    ORO_CHECK(check_unchanged(shot.view, shot.region, options.data_changed, options.quiet));
    if (options.no_paths) shot.view.tells_paths = false;
    if (!is_check(options, files)) say_edited(shot.view, options.quiet);
    shot.times.read_s = seconds_since(reading);
    ORO_CHECK(spare_files_of(options, files, shot));
    if (options.layers) ORO_CHECK(check_layers(shot.view.camera));
    return load_style(shot.view, shot.region.grids.front().field, WorldLight::drawn);
}

// The files beside the picture, as they are asked for: without names yet.
Result<std::vector<WholeFile>> companion_files(const ShotOptions& options, const PictureFiles& files,
                                               const ShotGround& ground, const Gpu& gpu, Scene& scene,
                                               const Style& style, ProgressBar& bar, ShotResult& shot) {
    std::vector<WholeFile> companions;
    if (shot.view.map && !is_check(options, files)) {
        ORO_TRY(WholeFile world, WholeFile::create(world_file_path(files.picture), options.overwrite));
        const std::string text = world_file(*shot.view.map);
        ORO_CHECK(world.write(text.data(), text.size()));
        companions.push_back(std::move(world));
    }
    if (options.layers) {
        ORO_TRY(companions, layers_of(options, files, ground, gpu, scene, style, bar, shot));
    }
    ORO_TRY(std::vector<WholeFile> poses, poses_of(options, files, shot));
    for (WholeFile& pose : poses) companions.push_back(std::move(pose));
    if (options.verify) {
        bar.show(1.0, "measuring errors");
        ORO_TRY(WholeFile errors, verify_shot(options, files, ground, gpu, scene, style, shot));
        companions.push_back(std::move(errors));
    }
    return companions;
}

Result<void> take_shot(const ShotOptions& options, const PictureFiles& files, const View* listed,
                       ShotSeries& series) {
    ORO_TRY(const double ceiling_m, unseen_ceiling(options.unseen_ceiling_m));
    ProgressBar bar(options.quiet);
    ShotResult shot;
    ORO_TRY(const Style style, open_shot(options, files, listed, bar, series, shot));
    bar.clear();
    say_notes(options, shot, series.reported_notes);
    if (!series.gpu) {
        ORO_TRY(series.gpu, gpu_to_draw_with());
    }
    const Gpu* const gpu = series.gpu.get();
    ORO_TRY(const ShotGround ground, ground_of_shot(shot));
    say_rims(shot.region, ground.cuts, options.quiet);
    ORO_TRY(ShotScene drawn, scene_of_shot(options, ceiling_m, *gpu, style, ground, bar.progress(), shot));
    Scene& scene = drawn.whole.scene;
    ORO_TRY(DrawnPicture picture, draw_shot(options, files, *ground.grids, *gpu, scene, style, bar, shot));
    const bool checks = is_check(options, files);
    ORO_TRY(std::vector<WholeFile> companions,
            companion_files(options, files, ground, *gpu, scene, style, bar, shot));
    bar.clear();
    const Result<void> finished =
        finish_shot(options, files, shot, std::move(picture.file), std::move(companions));
    if (finished.ok() || checks) tell(options, files, checks, shot, *gpu, style, series.reported_notes);
    if (finished.ok() && checks)
        say(options.quiet, files.picture + " is there already, and its view draws the same " +
                               (shot.same_bytes ? "bytes" : "pixels"));
    // The next view may look at the same region.
    if (!drawn.key.empty()) leave_scene(drawn.key, std::move(drawn.whole));
    series.region = std::move(shot.region);
    return finished;
}

// What is asked for of a view that is not known before its file is read.
Result<void> check_view_of_file(const View& recorded, ShotOptions& options) {
    options.ortho = recorded.map.has_value();
    options.covers = options.covers || !recorded.cover_choice.files.empty();
    options.has_meshes = options.has_meshes || !recorded.region.meshes.files.empty();
    if (options.ortho && (options.verify || options.layers))
        return refused(options.verify ? "--verify" : "--layers", "",
                       "is for pictures from an eye; " + options.view_file + " is a map");
    return {};
}

// One picture of each view, by numbers. All files are looked at before the first is drawn.
Result<void> take_shots(const ShotOptions& options, const std::vector<ListedView>& views) {
    std::vector<ShotOptions> shots;
    std::vector<std::string> written;
    std::vector<FilesToSpare> inputs;
    for (const ListedView& listed : views) {
        ShotOptions& one = shots.emplace_back(options);
        one.view_file = listed.file;
        ORO_TRY(one.out, numbered_name(options.out, views.size(), shots.size()));
        ORO_CHECK(check_view_of_file(listed.view, one));
        ORO_TRY(const PictureFiles files, shot_files(one));
        ORO_CHECK(check_out(one, files));
        for (std::string& file : written_files(one, files)) written.push_back(std::move(file));
        inputs.push_back(files_of_picture(listed.view, Region{}));
    }
    // A picture must not replace what a later view is made from.
    ORO_CHECK(spare_inputs(written, inputs));
    ShotSeries series;
    for (std::size_t i = 0; i < shots.size(); ++i) {
        ORO_TRY(const PictureFiles files, shot_files(shots[i]));
        ORO_CHECK(take_shot(shots[i], files, &views[i].view, series));
    }
    return {};
}

}  // namespace

Result<void> run_shot(const ShotOptions& asked) {
    ShotOptions options = asked;
    options.covers = !options.view.landcover.empty();
    options.has_meshes = names_any_mesh(options.region);
    if (!options.view_files.empty()) options.view_file = options.view_files.front();
    ORO_CHECK(check_map_options(options));
    ORO_TRY(const PictureFiles files, shot_files(options));
    options.view.takes_maps = true;
    ORO_TRY(const std::vector<ListedView> views, listed_views(options.view_files));
    if (!views.empty()) return take_shots(options, views);
    ShotSeries series;
    if (options.view_file.empty()) return take_shot(options, files, nullptr, series);
    ORO_TRY(const View recorded, read_view(options.view_file));
    ORO_CHECK(check_view_of_file(recorded, options));
    return take_shot(options, files, &recorded, series);
}

}  // namespace oro
