// orograph panorama: all around a place, with rulers and the names of what is seen.
#include <algorithm>
#include <cstdio>
#include <string_view>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/commands/commands.h"
#include "apps/commands/panorama/panorama_asked.h"
#include "apps/commands/panorama/panorama_drawing.h"
#include "apps/commands/panorama/panorama_json.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/names/names_in_view.h"
#include "apps/options/view_limits.h"
#include "apps/output/overwrite_guard.h"
#include "apps/output/pose_files.h"
#include "apps/report/figures.h"
#include "apps/report/json_text.h"
#include "apps/report/near_trees_words.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/summit_words.h"
#include "apps/view/view_changes.h"
#include "apps/view/view_option_table.h"
#include "core/base/elapsed.h"
#include "geo/pictures/picture.h"

namespace oro {
namespace {

Result<void> check_out(const PanoramaOptions& options) {
    if (options.out.empty())
        return refused("--out", "", "is missing: name the file to write (.png, .jpg, .tif or .svg)");
    if (!is_svg(options.out) && !picture_format(options.out).ok())
        return refused("--out", options.out,
                       "the file's name must end in .png, .jpg, .jpeg, .tif, .tiff or .svg");
    if (options.kml && is_svg(options.out))
        return refused("--kml", "", "shows a picture, not a drawing: name a .png, .jpg or .tif in --out");
    ORO_CHECK(check_may_write(options.out, options.overwrite));
    for (const std::string& pose : pose_paths(options.out, poses_asked(options)))
        ORO_CHECK(check_may_write(pose, options.overwrite));
    return {};
}

Result<void> check_words(const PanoramaOptions& options) {
    ORO_CHECK(check_out(options));
    return check_panorama_view(options);
}

// Data are lower than a summit is, and its place in them is another: an eye may come to stand beside it.
std::string note_of_skyline(bool is_on_summit) {
    const std::string note =
        "ground within 250 m of the eye stands higher than is shown: --elevation shows it, ";
    if (is_on_summit) return note + "and a larger --above looks over it";
    return note + "a larger --above looks over it, and --on-summit stands on the highest post nearby";
}

void say_notes_of(const PanoramaOptions& options, const PanoramaReport& report) {
    say_notes(report.region, options.quiet);
    say_summit(report.on_summit, options.quiet);
    if (const std::string note = note_of_year(report.view.sun); !note.empty()) say(options.quiet, note);
    if (report.view.vectors_read) say_vectors(*report.view.vectors_read, report.view.vectors, options.quiet);
}

void tell(const PanoramaOptions& options, const Style& style, const PanoramaReport& report) {
    say(options.quiet, "wrote " + options.out);
    for (const std::string& pose : pose_paths(options.out, poses_asked(options)))
        say(options.quiet, "wrote " + pose);
    const PanoramaNames& names = report.laid.names;
    if (names.without_letters > 0)
        say(options.quiet,
            "note: " + counted(static_cast<std::uint64_t>(names.without_letters), "name is", "names are") +
                " left out: the font has not all of their letters");
    if (!names.without_room.empty())
        say(options.quiet, "note: " + counted(names.without_room.size(), "name is", "names are") +
                               " left out: more important names take the room (a larger --width has more)");
    const std::string none = note_of_no_name(names.counts, static_cast<std::size_t>(names.without_letters),
                                             names.without_room.size());
    if (!report.view.vectors.names.empty() && names.named.empty() && !none.empty())
        say(options.quiet, "note: " + none);
    if (!options.json) return;
    nlohmann::ordered_json json = panorama_json(report, options.out, style);
    json["notes"] = all_notes(report.region);
    std::printf("%s\n", json_text(json, true).c_str());
}

// The files beside the panorama, without names yet. The view's camera has the whole sheet's size.
Result<std::vector<WholeFile>> poses_of(const PanoramaOptions& options, const PanoramaReport& report) {
    PoseFacts facts = pose_facts(report.view, report.region);
    facts.above_level_px = report.laid.sheet.scene_top_px + report.laid.around.above_px;
    ORO_TRY(const std::vector<PoseText> texts,
            pose_texts(options.out, poses_asked(options), report.view, facts));
    return pose_files(texts, options.overwrite);
}

}  // namespace

Result<void> run_panorama(const PanoramaOptions& options) {
    ORO_CHECK(check_words(options));
    ORO_TRY(const AskedFrame asked, asked_frame(options));
    ProgressBar bar(options.quiet);
    PanoramaReport report;
    View& view = report.view;
    const auto reading = Clock::now();
    ORO_CHECK(open_view(options.view_file, view_options_of(options), options.region, bar.progress(), view,
                        report.region, PictureKind::panorama));
    ORO_CHECK(check_unchanged(view, report.region, options.data_changed, options.quiet));
    report.on_summit = view.stood.summit;
    if (options.no_paths) view.tells_paths = false;
    say_edited(view, options.quiet);
    std::vector<std::string> outputs = pose_paths(options.out, poses_asked(options));
    outputs.push_back(options.out);
    ORO_CHECK(spare_inputs(
        outputs, {files_of_picture(view, report.region), {{options.view_file}, "which is the view"}}));
    // view.mesh tells what is drawn from then on.
    if (const auto drawn = draws_terrain_clusters(report.region, view); !drawn.ok()) return drawn.error();
    report.read_s = seconds_since(reading);
    bar.show(0.0, "looking around");
    const auto looking = Clock::now();
    ORO_TRY(const RegionCuts cuts, cut_regions(report.region));
    ORO_TRY(const auto ground, RegionGround::of(report.region, cuts, view.exaggeration));
    ORO_TRY(const bool leaves_out_near, set_frame(asked, ground->ground(), view));
    ORO_TRY(const Style style, style_of_panorama(view, report.region));
    bar.clear();
    say_notes_of(options, report);
    if (leaves_out_near) say(options.quiet, "note: " + note_of_skyline(report.on_summit.has_value()));
    ORO_TRY(report.laid, lay_out(view, report.region, ground->ground()));
    report.layout_s = seconds_since(looking);
    const auto drawing = Clock::now();
    ORO_TRY(report.scene, draw_panorama(view, report.region, cuts, ground->ground(), style,
                                        report.laid.around, {options.memory, options.quiet}, bar.progress()));
    report.draw_s = seconds_since(drawing);
    if (report.scene.report.ground_px == 0) {
        ORO_TRY(const std::string nothing, nothing_in_view(view, report.region, options.view_file));
        say(options.quiet, "note: " + nothing);
    }
    if (const std::string note = near_trees_note(report.scene.near_trees_share); !note.empty())
        say(options.quiet, "note: " + note);
    bar.show(1.0, "writing");
    ORO_TRY(PanoramaFile written, write_panorama(options.out, options.overwrite, view, report.region, style,
                                                 report.laid, report.scene));
    view.camera.height_px = report.laid.sheet.height_px;
    view.fingerprints = written.fingerprints;
    ORO_TRY(std::vector<WholeFile> together, poses_of(options, report));
    together.push_back(std::move(written.file));
    std::vector<WholeFile*> files;
    for (WholeFile& file : together) files.push_back(&file);
    ORO_CHECK(commit_together(files));
    bar.clear();
    tell(options, style, report);
    return {};
}

}  // namespace oro
