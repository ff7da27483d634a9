// orograph compare: how far the picture of a view is from the truth: drawn again with depths, measured, and
// not written.
#include <cstdio>
#include <memory>

#include "apps/accuracy/pixel_check.h"
#include "apps/accuracy/verification.h"
#include "apps/command_line/refusals.h"
#include "apps/commands/commands.h"
#include "apps/drawing/drape.h"
#include "apps/drawing/kept_drawing.h"
#include "apps/drawing/known_pictures.h"
#include "apps/drawing/mesh_choice.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/legend/legend.h"
#include "apps/output/overwrite_guard.h"
#include "apps/report/json_object.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/report/resampling_words.h"
#include "apps/view/model_names.h"
#include "apps/view/style.h"
#include "apps/view/view_changes.h"
#include "core/lod/ground_means.h"
#include "geo/pictures/picture.h"

namespace oro {
namespace {

nlohmann::ordered_json compare_json(const CompareOptions& options, const View& view, const Region& region,
                                    RasterPath path, const Gpu& gpu,
                                    const std::optional<PictureDifference>& pixels,
                                    const Verification& verification, const UnseenGround& unseen) {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    json["view"] = options.view_file;
    json["error_picture"] = nullptr;
    if (!options.out.empty()) json["error_picture"] = options.out;
    json["size_px"] = json_list(view.camera.width_px, view.camera.height_px);
    json["tau_px"] = view.tau_px;
    json["mesh_level"] = nullptr;
    if (view.mesh_level) json["mesh_level"] = *view.mesh_level;
    json["pipeline"] = name_of(path);
    json["device"] = json_object("name", gpu.report().name, "driver", gpu.report().driver);
    json["data_checked"] = view.recorded->fingerprints && view.recorded->fingerprints->posts;
    json["data_changed"] = view.fingerprints->data_changed;
    json["pixels"] = nullptr;
    if (pixels) json["pixels"] = pixels_json(*pixels);
    json["error"] = verification_json(verification);
    json["error"]["resampling"] = resampling_json(region_resampling(region.grids.front()));
    json["unseen"] = unseen_json(unseen);
    json["light"] = light_json(view.model.air, true_camera(view, region).eye.h_m);
    json["notes"] = all_notes(region);
    return json;
}

// Before anything takes time: that the error picture can be written where it shall be.
Result<void> check_error_picture(const CompareOptions& options) {
    if (options.out.empty()) return {};
    const auto format = picture_format(options.out);
    if (!format.ok() || *format != PictureFormat::png)
        return refused("--out", options.out, "the picture of errors must be a .png");
    return check_may_write(options.out, options.overwrite);
}

// Of a picture: that its pixels are what its view draws. Where its data changed, and that is known, they may
// well be others.
Result<std::optional<PictureDifference>> check_pixels(const CompareOptions& options, const View& view,
                                                      const Region& region, const RegionGround& ground,
                                                      const Gpu& gpu, Scene& scene, RasterPath path,
                                                      const Style& style, ProgressBar& bar) {
    if (!is_from_picture(view)) {
        say(options.quiet, "note: " + options.view_file + ": is a view without pixels to check");
        return std::optional<PictureDifference>();
    }
    std::vector<std::uint8_t> strip;
    if (view.legend) {
        ORO_TRY(const auto middle, place_in_middle(view, ground));
        ORO_TRY(strip, legend_strip(view, region, style, middle, ground));
    }
    ORO_TRY(const PictureDifference found,
            compare_pixels(options.view_file, view, ground.ground(), gpu, scene, path, style, strip,
                           [&](double share) { bar.show(share, "drawing"); }));
    const std::optional<Fingerprints>& recorded = view.recorded->fingerprints;
    const bool same_style = !recorded || !recorded->style ||
                            recorded->program != view.fingerprints->program ||
                            *recorded->style == style_fingerprint(style);
    if (const auto fault = fault_of_pixels(view, found, same_style)) {
        const bool was_edited = recorded && recorded->pixels && found.file_fingerprint &&
                                *recorded->pixels != *found.file_fingerprint;
        if (was_edited || !options.data_changed) return Error{ErrorKind::failed, options.view_file, *fault};
        say(options.quiet, "note: " + options.view_file + ": " + *fault);
    }
    return std::optional(found);
}

Result<GridPages> pages_of_view(const Region& region, const RegionCuts& cuts, const View& view,
                                const Style& style, ProgressBar& bar) {
    return make_grid_pages(
        region, cuts, view.exaggeration, [&](double share) { bar.show(share, "measuring levels"); }, {},
        known_pictures(view, style, std::span(&view.camera, 1)));
}

}  // namespace

Result<void> run_compare(const CompareOptions& options) {
    ORO_CHECK(check_error_picture(options));
    ORO_TRY(const double ceiling_m, unseen_ceiling(options.unseen_ceiling_m));
    ProgressBar bar(options.quiet);
    View view;
    Region region;
    ORO_CHECK(open_view(options.view_file, {}, options.region, bar.progress(), view, region));
    ORO_CHECK(check_unchanged(view, region, options.data_changed, options.quiet));
    say_notes(region, options.quiet);
    if (!options.out.empty())
        ORO_CHECK(
            spare_inputs({options.out}, {files_of_picture(view, region), files_of_view(options.view_file)}));
    ORO_TRY(const Style style, load_style(view, region.grids.front().field, WorldLight::drawn));
    ORO_TRY(const std::shared_ptr<const Gpu> gpu, gpu_to_draw_with());
    ORO_TRY(const RegionCuts cuts, cut_regions(region));
    ORO_TRY(GridPages pages, pages_of_view(region, cuts, view, style, bar));
    const MemoryOptions memory = memory_of_pages(view, options.memory);
    ORO_TRY(const std::optional<DrawnMeshes> meshes, drawn_meshes(region, view, memory));
    ORO_TRY(const bool clusters, meshes ? Result<bool>(false) : draws_clusters(region, view));
    ORO_TRY(RegionScene whole,
            scene_of_region(*gpu, region, cuts, std::move(pages),
                            {view.exaggeration, memory, view.heights, asks_for_means(style.frame), clusters,
                             view.mesh_level, meshes ? meshes->cut.meshes : nullptr}));
    Scene& scene = whole.scene;
    ORO_TRY(const auto ground, RegionGround::of(region, cuts, view.exaggeration));
    if (const std::string note = note_of_missing_footprints(style.frame, scene.pages()); !note.empty())
        say(options.quiet, note);
    ORO_CHECK(lay_images(view, options.memory, *gpu, scene, options.quiet));
    ORO_TRY(const RasterPath path, choose_path(view.pipeline, *gpu));
    ORO_TRY(const std::optional<PictureDifference> pixels,
            check_pixels(options, view, region, *ground, *gpu, scene, path, style, bar));
    ORO_TRY(const std::unique_ptr<TrueScene> truth, TrueScene::of(view, region, cuts));
    bar.show(0.0, "comparing");
    ORO_TRY(Verification verification, verify_view(view, *truth, *gpu, scene, path, style.frame,
                                                   meshes ? meshes->cut.meshes.get() : nullptr));
    measure_invented(verification, view, region);
    ORO_TRY(const UnseenGround unseen, unseen_in(view, region, ceiling_m, truth.get()));
    if (verification.errors.ground.drawn == 0) {
        ORO_TRY(const std::string nothing, nothing_in_view(view, region, options.view_file));
        say(options.quiet, "note: " + nothing);
    }
    if (!options.out.empty())
        ORO_CHECK(write_error_picture(options.out, verification, view.tau_px, options.overwrite));
    bar.clear();
    if (!options.out.empty()) say(options.quiet, "wrote " + options.out);
    if (pixels && !options.quiet && is_drawn_one(*pixels)) std::fputs(pixels_text(*pixels).c_str(), stderr);
    // What was asked for: as a table, or with -q as JSON alone.
    if (!options.quiet || !options.json)
        std::fputs((verification_text(verification, view, unseen) + resampling_line(region.grids.front()) +
                    light_line(view, region))
                       .c_str(),
                   stderr);
    if (options.json) {
        const nlohmann::ordered_json json =
            compare_json(options, view, region, path, *gpu, pixels, verification, unseen);
        std::printf("%s\n", json_text(json, true).c_str());
    }
    return {};
}

}  // namespace oro
