#include "apps/window/opening.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/report/progress_bar.h"
#include "apps/report/region_json.h"
#include "apps/window/changes.h"
#include "apps/window/motion.h"
#include "apps/window/window_start.h"
#include "core/lod/ground_means.h"
#include "geo/files/letter_case.h"

namespace oro {
namespace {

bool ends_in_one_of(const std::string& path, std::initializer_list<const char*> endings) {
    const std::string name = lower_case(path);
    return std::ranges::any_of(endings, [&](const char* ending) { return name.ends_with(ending); });
}

bool is_vector_path(const std::string& path) {
    return ends_in_one_of(path, {".gpx", ".kml", ".kmz", ".geojson", ".gpkg"});
}

bool may_carry_view(const std::string& path) {
    return ends_in_one_of(path, {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".json"});
}

Result<void> add_vectors(Viewer& viewer, const std::vector<std::string>& paths) {
    if (!viewer.vectors_known) viewer.vectors_known = viewer.view.vectors;
    VectorChoices chosen = viewer.view.vectors;
    for (const std::string& path : paths)
        if (std::ranges::find(chosen.overlay, path) == chosen.overlay.end()) chosen.overlay.push_back(path);
    ORO_TRY(const bool taken, choose_vectors(viewer, chosen));
    if (!taken) return {};
    for (const std::string& path : paths) {
        if (std::ranges::find(viewer.vectors_known->overlay, path) == viewer.vectors_known->overlay.end())
            viewer.vectors_known->overlay.push_back(path);
        tell(viewer, "shows " + std::filesystem::path(path).filename().string() + " over the ground");
    }
    return {};
}

// All that is known of the region from before means nothing any more.
void forget_region(Viewer& viewer) {
    viewer.coming.reset();
    viewer.finer.reset();
    viewer.scene.reset();
    viewer.ground.reset();
    viewer.under_pointer.reset();
    viewer.in_middle.reset();
    viewer.picked.reset();
    viewer.measuring = {};
    viewer.flies = false;
    viewer.panels.place = false;
    viewer.vectors_known.reset();
    viewer.images_known.clear();
}

// Another region in the same style and size.
Result<void> open_region_of(Viewer& viewer, const std::vector<std::string>& paths) {
    WindowOptions options = viewer.options;
    options.view_file.clear();
    options.region = {};
    options.region.paths = paths;
    options.view = {};
    const Camera& shown = viewer.view.camera;
    options.view.size = std::to_string(shown.width_px) + "x" + std::to_string(shown.height_px);
    options.view.style = viewer.view.style;
    View view;
    Region region;
    const auto refuse = [&](const Error& why) {
        tell(viewer, why);
        return Result<void>();
    };
    const Result<void> opened = open_flight(
        options, [](double, const std::string&) {}, view, region);
    if (!opened.ok()) return refuse(opened.error());
    Result<RegionCuts> cuts = cut_regions(region);
    if (!cuts.ok()) return refuse(cuts.error());
    Result<Style> style = load_style(view, region.grids.front().field);
    if (!style.ok()) return refuse(style.error());
    Result<OpenedScene> scene =
        open_scene(viewer.gpu, region, *cuts, view, *style, options.memory, true, [](double) {});
    if (!scene.ok()) return refuse(scene.error());
    forget_region(viewer);
    viewer.options = options;
    viewer.view = std::move(view);
    viewer.region = std::move(region);
    viewer.cuts = *std::move(cuts);
    viewer.style = *std::move(style);
    viewer.scene = std::make_unique<Scene>(std::move(scene->scene));
    viewer.jumps = Jumps(users_roll_deg(viewer.view.camera, std::nullopt));
    viewer.gestures.emplace(navigation_of(viewer));
    viewer.keeps_means = asks_for_means(viewer.style.frame);
    viewer.name = name_of_paths(paths);
    viewer.window.set_title(one_line("Orograph - " + viewer.name));
    if (scene->is_coarse)
        viewer.finer = std::make_unique<BackgroundPyramidBuild>(viewer.region, viewer.view.exaggeration);
    for (const std::string& note : all_notes(viewer.region))
        viewer.log.push_back({one_line(note), Clock::now(), false, false});
    viewer.wants_picture = true;
    tell(viewer, "opened " + viewer.name);
    return renew_renderer(viewer);
}

}  // namespace

Result<void> open_paths(Viewer& viewer, const std::vector<std::string>& paths) {
    std::vector<std::string> vectors, others;
    for (const std::string& path : paths) {
        if (is_vector_path(path)) {
            vectors.push_back(path);
            continue;
        }
        const auto carried = may_carry_view(path) ? read_view(path) : Result<View>(Error{});
        if (!carried.ok()) {
            others.push_back(path);
            continue;
        }
        Camera there = carried->camera;
        there.width_px = viewer.view.camera.width_px;
        there.height_px = viewer.view.camera.height_px;
        fly_to(viewer, there, "where " + std::filesystem::path(path).filename().string() + " was taken");
    }
    if (!others.empty()) ORO_CHECK(open_region_of(viewer, others));
    return vectors.empty() ? Result<void>() : add_vectors(viewer, vectors);
}

}  // namespace oro
