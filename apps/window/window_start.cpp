#include "apps/window/window_start.h"

#include <filesystem>
#include <system_error>

#include "apps/command_line/refusals.h"
#include "apps/drawing/background_pyramid_build.h"
#include "apps/drawing/drape.h"
#include "apps/drawing/mesh_cut.h"
#include "apps/eye/standpoint.h"
#include "apps/navigation/flight_step.h"
#include "apps/report/json_text.h"
#include "apps/window/world_levels.h"
#include "core/base/files_read.h"
#include "core/base/parallel.h"
#include "core/lod/ground_means.h"
#include "core/lod/pyramid.h"
#include "core/made_pages/made_pages.h"

namespace oro {

Result<void> open_flight(const WindowOptions& options, const Progress& progress, View& view, Region& region) {
    ORO_CHECK(open_view(options.view_file, options.view, options.region, progress, view, region));
    if (options.no_paths) view.tells_paths = false;
    // Its pictures are those of the window.
    view.legend = false;
    view.legend_px = 0;
    // Each of two levels is within tau of the full resolution: where one takes the other's place nothing
    // moves by more than twice that.
    if (!options.view.tau_px && !options.view.accuracy && options.view_file.empty()) view.tau_px = 0.5;
    const Geodetic& eye = view.camera.eye;
    view.camera =
        above_ground(view.camera, grid_at(region, eye.lat_deg, eye.lon_deg).field, view.exaggeration);
    ORO_CHECK(region.health());
    ORO_CHECK(check_files_unchanged());
    // A window stays open while people work on: what it shows is what was there when it was opened.
    forget_files_read();
    return {};
}

std::string free_picture_name(std::int64_t time_utc_s, const std::string& ending) {
    std::string stem = "orograph-" + time_text(time_utc_s);
    std::erase_if(stem, [](char c) { return c == ':'; });
    std::error_code ignored;
    for (int i = 1;; ++i) {
        const std::string name = stem + (i > 1 ? "-" + std::to_string(i) : "") + ending;
        if (!std::filesystem::exists(name, ignored)) return name;
    }
}

Result<GridPages> first_pages(const Region& region, const RegionCuts& cuts, const View& view,
                              const RenderProgress& progress) {
    if (is_drawn_by_bounds(region, view)) {
        const HeightField& field = region.grids.front().field;
        GridPages pages;
        pages.push_back(made_posts_of(field)->pages_by_bounds(field));
        return pages;
    }
    if (!measures_long(region)) return make_grid_pages(region, cuts, view.exaggeration, progress);
    GridPages coarse;
    coarse.push_back(
        pages_in_memory(coarse_field(region.grids.front().field), view.exaggeration, thread_count()));
    return coarse;
}

Result<Scene> scene_with_images(const Gpu& gpu, const Region& region, const RegionCuts& cuts, GridPages pages,
                                const View& view, const SceneChoice& choice) {
    ORO_TRY(RegionScene whole,
            scene_of_region(gpu, region, cuts, std::move(pages),
                            {view.exaggeration, memory_of_pages(view, choice.memory), view.heights,
                             choice.keeps_means, choice.clusters, view.mesh_level, choice.meshes}));
    // A moving eye is planned anew each frame. Where a processor draws it makes the tables all the same.
    if (gpu.report().kind != VK_PHYSICAL_DEVICE_TYPE_CPU) {
        const Result<bool> on_device = whole.scene.plan_on_device(gpu);
        if (!on_device.ok()) return on_device.error();
    }
    ORO_CHECK(lay_images(view, choice.memory, gpu, whole.scene, choice.quiet));
    return std::move(whole.scene);
}

Result<OpenedScene> first_scene(const Gpu& gpu, const Region& region, const RegionCuts& cuts, GridPages pages,
                                View& view, SceneChoice choice) {
    ORO_TRY(choice.clusters, draws_terrain_clusters(region, view));
    EyeMeshes meshes;
    ORO_TRY(meshes.detail, mesh_detail_of(region, view));
    if (const auto chosen = choose_cut(meshes, view, memory_of_pages(view, choice.memory), view.camera);
        !chosen)
        return chosen.error();
    choice.meshes = meshes.cut.meshes;
    const bool keeps_means = choice.keeps_means;
    const bool lacks_means = keeps_means && measures_means_long(region);
    choice.keeps_means = keeps_means && !lacks_means;
    ORO_TRY(Scene scene, scene_with_images(gpu, region, cuts, std::move(pages), view, choice));
    const bool is_of_bounds = is_drawn_by_bounds(region, view);
    scene.wait_for_records(!is_of_bounds);
    return OpenedScene{std::move(scene), measures_long(region) || lacks_means, keeps_means, std::move(meshes),
                       is_of_bounds};
}

Result<OpenedScene> open_scene(const Gpu& gpu, const Region& region, const RegionCuts& cuts, View& view,
                               SceneChoice choice, const RenderProgress& progress) {
    ORO_TRY(GridPages pages, first_pages(region, cuts, view, progress));
    return first_scene(gpu, region, cuts, std::move(pages), view, choice);
}

std::string name_of_paths(const std::vector<std::string>& paths) {
    namespace fs = std::filesystem;
    if (paths.empty()) return "";
    const fs::path first(paths.front());
    const fs::path name = first.has_filename() ? first.filename() : first.parent_path().filename();
    return name.string() + (paths.size() > 1 ? " and " + std::to_string(paths.size() - 1) + " more" : "");
}

Result<void> check_window_size(const Camera& camera, const DeviceReport& device) {
    const auto most = static_cast<int>(device.max_picture_side_px);
    if (camera.width_px <= most && camera.height_px <= most) return {};
    return refused("--size", std::to_string(camera.width_px) + "x" + std::to_string(camera.height_px),
                   "is too large for a window: " + device.name + " draws at most " + std::to_string(most) +
                       " pixels a side");
}

}  // namespace oro
