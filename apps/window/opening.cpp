#include "apps/window/opening.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/report/region_json.h"
#include "apps/settings/recent_files.h"
#include "apps/window/changes.h"
#include "apps/window/frames.h"
#include "apps/window/motion.h"
#include "apps/window/search.h"
#include "apps/window/window_start.h"
#include "core/lod/ground_means.h"
#include "core/terrain/ground.h"
#include "geo/files/letter_case.h"
#include "geo/pictures/photograph_view.h"

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

// Where a picture was taken: one of this program to the last digit, a photograph as far as it tells.
std::optional<Camera> camera_of_picture(const Viewer& viewer, const std::string& path) {
    Camera there = viewer.view.camera;
    const int width_px = there.width_px, height_px = there.height_px;
    if (const auto carried = read_view(path); carried.ok()) {
        there = carried->camera;
        there.width_px = width_px;
        there.height_px = height_px;
        return there;
    }
    const auto photograph = photograph_view(path);
    if (!photograph.ok()) return std::nullopt;
    constexpr double eye_m = 2.0;  // over the ground, of a photograph that tells no height
    const RegionGrid& grid = grid_at(viewer.region, photograph->lat_deg, photograph->lon_deg);
    const double N_m = grid.field.undulation.at_m(photograph->lat_deg, photograph->lon_deg);
    const auto ground_m =
        ground_h_m(grid.field, photograph->lat_deg, photograph->lon_deg, viewer.view.exaggeration);
    double h_m = ground_m.value_or(0.0) + eye_m;
    if (photograph->height_m) h_m = *photograph->height_m + (photograph->is_height_ellipsoidal ? 0.0 : N_m);
    there.eye = {photograph->lat_deg, photograph->lon_deg, h_m};
    there.attitude = {photograph->heading_deg.value_or(there.attitude.heading_deg),
                      photograph->pitch_deg.value_or(0.0), photograph->roll_deg.value_or(0.0)};
    if (photograph->vertical_fov_deg) there.vertical_fov_deg = *photograph->vertical_fov_deg;
    return above_ground(there, grid.field, viewer.view.exaggeration);
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
    const bool keeps_means = asks_for_means(style->frame);
    Result<OpenedScene> scene =
        open_scene(viewer.gpu, region, *cuts, view, {options.memory, true, keeps_means}, [](double) {});
    if (!scene.ok()) return refuse(scene.error());
    ORO_CHECK(finish_frames(viewer));
    forget_region(viewer);
    viewer.options = options;
    viewer.view = std::move(view);
    viewer.region = std::move(region);
    viewer.cuts = std::move(*cuts);
    viewer.style = std::move(*style);
    take_scene(viewer, std::move(*scene));
    viewer.jumps = Jumps(users_roll_deg(viewer.view.camera, std::nullopt));
    viewer.gestures.emplace(navigation_of(viewer));
    viewer.keeps_means = keeps_means;
    viewer.name = name_of_paths(paths);
    viewer.window.set_title(one_line("Orograph - " + viewer.name));
    for (const std::string& note : all_notes(viewer.region))
        viewer.log.push_back({one_line(note), Clock::now(), false, false});
    viewer.wants_picture = true;
    tell(viewer, "opened " + viewer.name);
    fill_search(viewer);
    remember_opened(viewer, paths);
    return renew_renderer(viewer);
}

}  // namespace

void remember_opened(Viewer& viewer, const std::vector<std::string>& paths) {
    const auto recent = add_recent_files(paths);
    // A user without a folder for it has no list.
    if (recent.ok()) viewer.recent = recent->all;
}

Result<void> open_paths(Viewer& viewer, const std::vector<std::string>& paths) {
    std::vector<std::string> vectors, others;
    for (const std::string& path : paths) {
        if (is_vector_path(path)) {
            vectors.push_back(path);
            continue;
        }
        const auto there = may_carry_view(path) ? camera_of_picture(viewer, path) : std::nullopt;
        if (there)
            fly_to(viewer, *there, "where " + std::filesystem::path(path).filename().string() + " was taken");
        else
            others.push_back(path);
    }
    if (!others.empty()) ORO_CHECK(open_region_of(viewer, others));
    return vectors.empty() ? Result<void>() : add_vectors(viewer, vectors);
}

}  // namespace oro
