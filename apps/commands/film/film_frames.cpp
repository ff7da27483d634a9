#include "apps/commands/film/film_frames.h"

#include <utility>

#include "apps/drawing/drape.h"
#include "apps/drawing/known_pictures.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/drawing/picking.h"
#include "apps/drawing/pipeline_choice.h"
#include "apps/drawing/region_scene.h"
#include "apps/eye/standpoint.h"
#include "apps/legend/legend.h"
#include "apps/report/json_text.h"
#include "apps/report/progress_bar.h"
#include "apps/view/style.h"
#include "apps/view/view_paths.h"
#include "core/base/files_read.h"
#include "core/lod/ground_means.h"
#include "geo/pixels/picture_difference.h"
#include "render/device/raster_request.h"

namespace oro {

View FilmFrames::view_of(const CameraKey& key, std::int64_t time_utc_s) const {
    View view = view_;
    view.camera.eye = key.eye;
    view.camera.attitude = key.attitude;
    view.camera.vertical_fov_deg = key.vertical_fov_deg;
    view.time_utc_s = time_utc_s;
    if (options_.view.sun_time && *options_.view.sun_time == "view")
        view.sun = SunDirection{0.0, 0.0, SunTime{time_text(time_utc_s), time_utc_s}};
    aim_sun(view.sun, view.camera.eye);
    return view;
}

// Lets the grid stand first that stands first for an eye there.
void FilmFrames::look_from(const Geodetic& eye) {
    if (&data_grid_at(region_, eye.lat_deg, eye.lon_deg) == &region_.grids.front()) return;
    scene_.reset();
    ground_.reset();
    begin_with_grid_at(eye, view_, region_);
}

Result<bool> FilmFrames::is_drawn(const std::string& file, View& view) {
    const auto read = read_view_json(file);
    forget_file_read(file);
    if (!read.ok()) return false;
    const Result<View> there = view_from_json(*read, file);
    if (!there.ok() || !there->fingerprints) return false;
    look_from(view.camera.eye);
    ORO_TRY(const Style style, load_style(view, region_.grids.front().field));
    ORO_TRY(const RasterPath path, choose_path(view.pipeline, gpu_));
    ORO_TRY(View wanted, view_as_written_in(view, file));
    wanted.pipeline = name_of(path);
    wanted.legend_px = view.legend_px = there->legend_px;
    wanted.fingerprints->style = style_fingerprint(style);
    wanted.fingerprints->pixels = there->fingerprints->pixels;
    if (view_to_json(wanted, false) != *read) return false;
    const auto pixels =
        fingerprint_of_pixels(file, view.camera.width_px, view.camera.height_px + there->legend_px);
    forget_file_read(file);
    return pixels.ok() && (!*pixels || *pixels == there->fingerprints->pixels);
}

Result<void> FilmFrames::make_scene(const Camera& camera) {
    ORO_TRY(const Style style, load_style(view_, region_.grids.front().field));
    ORO_TRY(cuts_, cut_regions(region_));
    ORO_TRY(ground_, RegionGround::of(region_, cuts_, view_.exaggeration));
    ORO_TRY(GridPages pages, make_grid_pages(region_, cuts_, view_.exaggeration, {}, {},
                                             known_pictures(view_, style, cameras_)));
    if (!meshes_) {
        ORO_TRY(meshes_, mesh_detail_of(region_, view_));
    }
    if (meshes_) {
        ORO_TRY(mesh_cut_,
                mesh_cut_of(*meshes_, mesh_asked_by(view_, memory_of_pages(view_, options_.memory)),
                            std::span(&camera, 1)));
    }
    ORO_TRY(RegionScene whole,
            scene_of_region(gpu_, region_, cuts_, std::move(pages),
                            {view_.exaggeration, memory_of_pages(view_, options_.memory), view_.heights,
                             asks_for_means(style.frame), view_.mesh == "clusters" && !meshes_,
                             view_.mesh_level, mesh_cut_.meshes}));
    scene_.emplace(std::move(whole.scene));
    const bool is_first = scenes_made_++ == 0;
    const std::string note = note_of_missing_footprints(style.frame, scene_->pages());
    if (is_first && !note.empty()) say(options_.quiet, note);
    return lay_images(view_, options_.memory, gpu_, *scene_, options_.quiet || !is_first);
}

Result<void> FilmFrames::choose_meshes(const View& view) {
    if (!meshes_) return {};
    ORO_TRY(MeshCut cut, mesh_cut_of(*meshes_, mesh_asked_by(view_, memory_of_pages(view_, options_.memory)),
                                     std::span(&view.camera, 1), &mesh_cut_));
    const bool is_same = cut.meshes == mesh_cut_.meshes;
    mesh_cut_ = std::move(cut);
    if (is_same) return {};
    gpu_.wait_idle();
    ORO_CHECK(redraw_meshes(gpu_, region_, cuts_, view_.exaggeration, *mesh_cut_.meshes, *scene_));
    return lay_images(view_, options_.memory, gpu_, *scene_, true);
}

Result<DrawnPicture> FilmFrames::draw(const std::string& file, bool overwrite, View& view,
                                      const RenderProgress& progress) {
    look_from(view.camera.eye);
    ORO_CHECK(scene_ ? choose_meshes(view) : make_scene(view.camera));
    ORO_TRY(const Style style, load_style(view, region_.grids.front().field));
    ORO_TRY(const auto middle, place_in_middle(view, *ground_));
    ORO_TRY(const std::vector<std::uint8_t> strip, strip_of(view, region_, style, middle, *ground_));
    return draw_picture(picture_files(file), overwrite, view, region_, *ground_, middle, gpu_, *scene_, style,
                        strip, progress);
}

}  // namespace oro
