#include "apps/window/pictures.h"

#include <utility>
#include <vector>

#include "apps/accuracy/beyond_data.h"
#include "apps/drawing/drape.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/legend/legend.h"
#include "apps/navigation/view_history.h"
#include "apps/output/picture_file.h"
#include "apps/output/pose_files.h"
#include "apps/report/json_text.h"
#include "apps/report/near_trees_words.h"
#include "apps/report/progress_bar.h"
#include "apps/window/frames.h"
#include "apps/window/window_start.h"
#include "core/lod/ground_means.h"

namespace oro {
namespace {

// All of that at once.
Result<void> wait_for_finer_scene(Viewer& viewer) {
    if (viewer.finer) ORO_CHECK(begin_finer_scene(viewer));
    if (viewer.coming) show_finer_scene(viewer);
    return {};
}

// The view of the picture that is asked for.
View pictured(View view, const PictureChoice& choice) {
    view.camera.width_px = choice.width_px;
    view.camera.height_px = choice.height_px;
    view.samples = choice.samples;
    view.legend = has_own_legend(view);
    return view;
}

// Draws a picture, and gives it and the files beside it their names together.
Result<PictureReport> write_with_poses(Viewer& viewer, const PictureFiles& files, const View& view,
                                       const RegionGround& ground, const std::optional<SeenPlace>& middle,
                                       std::span<const std::uint8_t> strip, PoseChoice poses, Scene& scene) {
    ORO_TRY(const std::vector<PoseText> texts,
            pose_texts(files.picture, poses, view, pose_facts(view, viewer.region)));
    ORO_TRY(std::vector<WholeFile> written, pose_files(texts, false));
    ORO_TRY(DrawnPicture picture, draw_picture(files, false, view, viewer.region, ground, middle, viewer.gpu,
                                               scene, viewer.style, strip, {}));
    written.push_back(std::move(picture.file));
    std::vector<WholeFile*> all;
    for (WholeFile& file : written) all.push_back(&file);
    ORO_CHECK(commit_together(all));
    return picture.report;
}

Result<void> write_picture_of(Viewer& viewer, const PictureChoice& choice) {
    ORO_CHECK(finish_frames(viewer));
    follow_sun(viewer);
    if (is_coarse(viewer)) {
        // A picture is what its view says, and nothing coarser.
        tell(viewer, "the picture waits for finer detail");
        trace_state(viewer);
        ORO_CHECK(wait_for_finer_scene(viewer));
    }
    viewer.view.time_utc_s = time_now_s();
    View view = pictured(viewer.view, choice);
    ORO_CHECK(choose_meshes(viewer, view.camera));
    const PictureFiles files = picture_files(free_picture_name(view.time_utc_s, choice.ending));
    ORO_TRY(const RegionGround* const ground, ground_of(viewer));
    ORO_TRY(const auto middle, place_in_middle(view, *ground));
    ORO_CHECK(fit_to_view(viewer.style, view, viewer.region.grids.front().field));
    ORO_TRY(const auto strip, strip_of(view, viewer.region, viewer.style, middle, *ground));
    ORO_TRY(const std::unique_ptr<Scene> measured, scene_of_picture(viewer, view));
    const auto written = write_with_poses(viewer, files, view, *ground, middle, strip, choice.poses,
                                          measured ? *measured : *viewer.scene);
    const std::string hidden = written.ok() ? near_trees_note(near_trees_share(*written, view.camera)) : "";
    tell(viewer,
         written.ok() ? written_words(files.picture) + (hidden.empty() ? "" : "; " + hidden)
                      : written.error().line(),
         !written.ok());
    say(viewer.options.quiet && written.ok(), viewer.message);
    if (!written.ok() || viewer.options.quiet) return {};
    ORO_TRY(const UnseenGround unseen, unseen_in(view, viewer.region, usual_unseen_ceiling_m));
    if (const std::string note = unseen_note(unseen); !note.empty()) say(false, "note: " + note);
    return {};
}

MeshTarget mesh_target_of(Viewer& viewer, const MemoryOptions& memory) {
    return {viewer.region, viewer.cuts, viewer.view, memory, viewer.gpu, *viewer.scene};
}

}  // namespace

void follow_sun(Viewer& viewer) {
    std::optional<SunDirection>& sun = viewer.view.sun;
    if (!sun || !sun->time) return;
    aim_sun(sun, viewer.view.camera.eye);
    light_by(*sun, viewer.style.frame);
}

void take_scene(Viewer& viewer, OpenedScene opened) {
    viewer.coming.reset();
    viewer.certificates.forget();
    viewer.world = {};
    viewer.world.on = opened.is_of_bounds;
    viewer.scene = std::make_unique<Scene>(std::move(opened.scene));
    viewer.meshes = std::move(opened.meshes);
    viewer.finer = opened.is_coarse ? std::make_unique<BackgroundPyramidBuild>(
                                          viewer.region, viewer.view.exaggeration, opened.keeps_means)
                                    : nullptr;
}

Result<void> choose_meshes(Viewer& viewer, const Camera& camera) {
    const MemoryOptions memory = memory_of_first(viewer);
    return draw_cut_of(viewer.meshes, mesh_target_of(viewer, memory), camera,
                       [&] { return finish_frames(viewer); });
}

Result<bool> follow_with_meshes(Viewer& viewer) {
    EyeMeshes& meshes = viewer.meshes;
    const Camera& camera = viewer.view.camera;
    if (are_chosen_for(meshes, viewer.view, camera)) return false;
    const MemoryOptions memory = memory_of_first(viewer);
    ORO_TRY(const bool are_here,
            follow_with_meshes(meshes, mesh_target_of(viewer, memory), camera, is_moving(viewer)));
    if (are_here) {
        ORO_CHECK(finish_frames(viewer));
        take_coming(meshes, *viewer.scene);
    }
    return are_here || are_chosen_for(meshes, viewer.view, camera);
}

Result<void> begin_finer_scene(Viewer& viewer) {
    GridPages pages(1);
    ORO_TRY(pages.front(), viewer.finer->wait());
    viewer.finer.reset();
    ORO_TRY(const bool clusters, draws_terrain_clusters(viewer.region, viewer.view));
    ORO_TRY(Scene scene,
            scene_with_images(
                viewer.gpu, viewer.region, viewer.cuts, std::move(pages), viewer.view,
                {memory_of_first(viewer), true, viewer.keeps_means, clusters, viewer.meshes.cut.meshes}));
    if (is_tinted(viewer)) ORO_CHECK(lay_over_ground(viewer, scene));
    viewer.coming = std::make_unique<Scene>(std::move(scene));
    viewer.coming_since = Clock::now();
    return {};
}

void show_finer_scene(Viewer& viewer) {
    viewer.certificates.forget();
    viewer.scene = std::move(viewer.coming);
    forget_drawn(viewer.meshes);  // they may have been chosen anew meanwhile
    viewer.is_missing = false;
    viewer.wants_picture = true;
}

Result<void> take_picture(Viewer& viewer) {
    PictureChoice choice;
    choice.width_px = viewer.view.camera.width_px;
    choice.height_px = viewer.view.camera.height_px;
    choice.samples = viewer.view.samples;
    choice.poses = poses_asked(viewer.options);
    return take_picture(viewer, choice);
}

Result<void> take_picture(Viewer& viewer, const PictureChoice& choice) {
    // A picture has what its view tells, which a tint is no part of.
    const bool tinted = is_tinted(viewer);
    if (tinted) ORO_CHECK(leave_tints_out(viewer, true));
    ORO_CHECK(write_picture_of(viewer, choice));
    return tinted ? leave_tints_out(viewer, false) : Result<void>();
}

std::string command_line_of(const View& shown, const PictureChoice& choice) {
    const View view = pictured(shown, choice);
    // In single quotes a shell takes everything but these as it is.
    std::string json;
    for (const char c : view_to_json(view, false)) json += c == '\'' ? "'\\''" : std::string(1, c);
    const std::string poses = std::string(choice.poses.kml ? " --kml" : "") +
                              (choice.poses.geopose ? " --geopose" : "") +
                              (choice.poses.stac ? " --stac" : "");
    return "printf '%s' '" + json + "' >view.json\norograph shot --view view.json --out picture" +
           choice.ending + poses + "\n";
}

}  // namespace oro
