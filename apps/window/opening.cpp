#include "apps/window/opening.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "apps/eye/standpoint.h"
#include "apps/report/region_json.h"
#include "apps/settings/recent_files.h"
#include "apps/view/mesh_parts.h"
#include "apps/window/changes.h"
#include "apps/window/frames.h"
#include "apps/window/kept_view.h"
#include "apps/window/motion.h"
#include "apps/window/pictures.h"
#include "apps/window/projects.h"
#include "apps/window/search.h"
#include "apps/window/window_start.h"
#include "core/lod/ground_means.h"
#include "core/terrain/ground.h"
#include "geo/drape/image_source.h"
#include "geo/files/letter_case.h"
#include "geo/pictures/photograph_view.h"

namespace oro {
namespace {

bool ends_in_one_of(const std::string& path, std::initializer_list<const char*> endings) {
    const std::string name = lower_case(path);
    return std::ranges::any_of(endings, [&](const char* ending) { return name.ends_with(ending); });
}

bool is_vector_path(const std::string& path) {
    return ends_in_one_of(path,
                          {".gpx", ".kml", ".kmz", ".geojson", ".topojson", ".csv", ".gpkg", ".shp", ".fgb"});
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

// Whether a raster is there to be looked at: it has colours, or the few values of a picture, or is of a
// format that keeps no elevation.
bool is_image(const std::string& path) {
    const auto of_pictures = {".jp2", ".j2k", ".jpg", ".jpeg", ".png", ".webp"};
    if (!ends_in_one_of(path, of_pictures) && !ends_in_one_of(path, {".tif", ".tiff", ".vrt"})) return false;
    const auto image = open_image(path);
    if (!image.ok()) return false;
    const bool is_of_bytes = !image->is_light && image->black == 0.0 && image->white == 255.0;
    return image->bands.size() > 1 || image->palette || is_of_bytes || ends_in_one_of(path, of_pictures);
}

// Whether the values of what would else be an image are codes of one of the tables of land cover.
bool is_cover(const std::string& path) {
    CoverChoice choice{{path}, ""};
    std::vector<Fingerprints::OfSource> fingerprints;
    return open_cover(choice, fingerprints).ok();
}

// Colours the ground by files of land cover, over those that do.
Result<void> add_cover(Viewer& viewer, const std::vector<std::string>& files) {
    std::vector<std::string> all = viewer.view.cover_choice.files;
    for (const std::string& file : files)
        if (std::ranges::find(all, file) == all.end()) all.push_back(file);
    ORO_CHECK(choose_cover(viewer, all));
    if (viewer.view.cover_choice.files != all) return {};
    if (viewer.style.frame.materials.on == 0) ORO_CHECK(choose_style(viewer, "natural"));
    tell(viewer, name_of_paths(files) + " colours the ground: Layers shows and hides it");
    return {};
}

// Lays images over the ground that is shown, over those that lie there.
Result<void> add_images(Viewer& viewer, const std::vector<std::string>& images) {
    std::vector<std::string> all = viewer.view.drape;
    for (const std::string& image : images)
        if (std::ranges::find(all, image) == all.end()) all.push_back(image);
    const double opacity = viewer.view.drape_opacity > 0.0 ? viewer.view.drape_opacity : 1.0;
    ORO_CHECK(choose_drape(viewer, all, opacity));
    if (viewer.view.drape == all)
        tell(viewer, "laid " + name_of_paths(images) + " over the ground: Layers shows and hides it");
    return {};
}

// All that is known of the region from before means nothing any more.
void forget_region(Viewer& viewer) {
    viewer.coming.reset();
    viewer.finer.reset();
    viewer.world = {};
    viewer.meshes = {};
    viewer.certificates.forget();
    viewer.scene.reset();
    viewer.way_home = {};
    forget_ground(viewer);
    viewer.under_pointer.reset();
    viewer.in_middle.reset();
    viewer.picked.reset();
    viewer.jumped_to.reset();
    viewer.measuring = {};
    viewer.looking = {};
    viewer.panorama = {};
    viewer.two = {};
    viewer.comparing = {};
    viewer.panels.viewshed = viewer.panels.panorama = false;
    viewer.flies = false;
    viewer.playing.reset();
    viewer.panels.place = false;
}

// Begins to read what is shown next; what is shown stays until it is there.
void begin_opening(Viewer& viewer, WindowOptions options, std::optional<Project> project) {
    if (viewer.opening) return tell(viewer, viewer.opening->name() + " is still being opened", true);
    viewer.opening = std::make_unique<RegionOpening>(std::move(options), std::move(project));
    tell(viewer, "opening " + viewer.opening->name());
}

// A project as it was saved: of the window it keeps the size alone.
void begin_opening_project(Viewer& viewer, const std::string& file) {
    WindowOptions options = viewer.options;
    options.view_file.clear();
    options.region = {};
    options.region.paths = {file};
    options.view = {};
    const Camera shown = view_alone(viewer).camera;
    options.view.size = std::to_string(shown.width_px) + "x" + std::to_string(shown.height_px);
    options.gazetteers.clear();
    options.no_paths = false;
    auto project = project_named_by(options);
    if (!project.ok()) return tell(viewer, project.error());
    if (*project) begin_opening(viewer, std::move(options), std::move(*project));
}

// A scene of the region that was read, with all that its user chose. Errors: as they are told to the user.
Result<OpenedScene> scene_of(Viewer& viewer, OpenedRegion& opened, Style& style) {
    if (!opened.project) keep_choices(viewer.view, opened.view);
    // Data in no projected CRS have the other graticule.
    if (!find_graticule_crs(opened.view, opened.region).ok()) opened.view.graticule = Graticule::geographic;
    settle_mesh_parts(opened.region, opened.view);
    ORO_TRY(style, load_style(opened.view, opened.region.grids.front().field));
    const bool keeps_means = viewer.keeps_means || asks_for_means(style.frame);
    ORO_TRY(OpenedScene scene, first_scene(viewer.gpu, opened.region, opened.cuts, std::move(opened.pages),
                                           opened.view, {viewer.options.memory, true, keeps_means}));
    viewer.keeps_means = keeps_means;
    return scene;
}

// Shows it in the place of the one that was shown.
Result<void> show_region(Viewer& viewer, OpenedRegion opened, OpenedScene scene, Style style) {
    ORO_CHECK(finish_frames(viewer));
    const std::vector<std::string> paths = opened.paths();
    forget_region(viewer);
    viewer.options = std::move(opened.options);
    viewer.view = std::move(opened.view);
    viewer.region = std::move(opened.region);
    viewer.cuts = std::move(opened.cuts);
    viewer.style = std::move(style);
    take_scene(viewer, std::move(scene));
    viewer.jumps = Jumps(users_roll_deg(viewer.view.camera, viewer.options.view.roll_deg));
    viewer.gestures.emplace(navigation_of(viewer));
    viewer.name = name_of_paths(paths);
    viewer.window.set_title(one_line("Orograph - " + viewer.name));
    for (const std::string& note : all_notes(viewer.region))
        viewer.log.push_back({one_line(note), Clock::now(), false, false});
    viewer.wants_picture = true;
    tell(viewer, "opened " + viewer.name +
                     (opened.canopy_left_out ? ". The canopy lies elsewhere, and is left out" : ""));
    fill_search(viewer);
    remember_opened(viewer, paths);
    ORO_CHECK(renew_renderer(viewer));
    // What was shown is of another place.
    viewer.kept = {};
    viewer.is_settled = false;
    // A region that is opened is no part of the project that was shown.
    viewer.own_project.clear();
    return opened.project ? take_project(viewer, *opened.project, paths.front()) : Result<void>();
}

}  // namespace

void remember_opened(Viewer& viewer, const std::vector<std::string>& paths) {
    const auto recent = add_recent_files(paths);
    // A user without a folder for it has no list.
    if (recent.ok()) viewer.recent = recent->all;
}

Result<void> open_paths(Viewer& viewer, const std::vector<std::string>& paths) {
    std::vector<std::string> vectors, cover, images, others;
    for (const std::string& path : paths) {
        if (is_vector_path(path)) {
            vectors.push_back(path);
            continue;
        }
        if (is_project(path)) {
            begin_opening_project(viewer, path);
            continue;
        }
        if (is_camera_path(path)) {
            viewer.film.file = path;
            open_film(viewer);
            viewer.panels.open(&Panels::film);
            continue;
        }
        const auto there = may_carry_view(path) ? camera_of_picture(viewer, path) : std::nullopt;
        if (there)
            fly_to(viewer, *there, "where " + std::filesystem::path(path).filename().string() + " was taken");
        else
            (!is_image(path) ? others : is_cover(path) ? cover : images).push_back(path);
    }
    if (!cover.empty()) ORO_CHECK(add_cover(viewer, cover));
    if (!images.empty()) ORO_CHECK(add_images(viewer, images));
    if (!others.empty())
        begin_opening(viewer, options_for_other_region(viewer.options, view_alone(viewer), others), {});
    return vectors.empty() ? Result<void>() : add_vectors(viewer, vectors);
}

Result<void> take_opened(Viewer& viewer) {
    if (!viewer.opening || !viewer.opening->ready()) return {};
    Result<OpenedRegion> opened = viewer.opening->wait();
    viewer.opening.reset();
    const auto refuse = [&](const Error& why) {
        tell(viewer, why);
        return Result<void>();
    };
    if (!opened.ok()) return refuse(opened.error());
    Style style;
    Result<OpenedScene> scene = scene_of(viewer, *opened, style);
    if (!scene.ok()) return refuse(scene.error());
    return show_region(viewer, std::move(*opened), std::move(*scene), std::move(style));
}

}  // namespace oro
