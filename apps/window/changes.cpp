#include "apps/window/changes.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "apps/drawing/drape.h"
#include "apps/drawing/mesh_choice.h"
#include "apps/navigation/flight_step.h"
#include "apps/styles/data_folder.h"
#include "apps/window/frames.h"
#include "apps/window/pictures.h"
#include "apps/window/search.h"
#include "core/lod/ground_means.h"

namespace oro {
namespace {

// The sun of a view for which nobody asks for one.
std::optional<SunDirection> sun_of_style(View& view) {
    if (!has_sun_by_place(view)) return std::nullopt;
    std::optional<SunDirection> sun = usual_sun();
    aim_sun(sun, view.camera.eye);
    return sun;
}

// Whether the view is drawn by clusters: a choice that the window made is made anew. Errors: as
// draws_clusters().
Result<bool> choose_clusters_of(const Viewer& viewer, View& view) {
    if (!viewer.options.view.mesh) view.mesh = "auto";
    return draws_clusters(viewer.region, view);
}

// Levels as the view asks for, from the region anew: in the background where that takes long, in the place of
// the scene that is shown else.
Result<void> renew_scene(Viewer& viewer) {
    viewer.coming.reset();
    viewer.finer.reset();
    if (measures_long(viewer.region)) {
        viewer.finer = std::make_unique<BackgroundPyramidBuild>(viewer.region, viewer.view.exaggeration);
        return {};
    }
    View& view = viewer.view;
    ORO_TRY(GridPages pages, make_grid_pages(viewer.region, viewer.cuts, view.exaggeration));
    ORO_TRY(const bool clusters, choose_clusters_of(viewer, view));
    ORO_TRY(RegionScene whole,
            scene_of_region(
                viewer.gpu, viewer.region, viewer.cuts, std::move(pages),
                {view.exaggeration, memory_of_pages(view, viewer.options.memory), view.heights,
                 viewer.keeps_means || asks_for_means(viewer.style.frame), clusters, view.mesh_level}));
    ORO_CHECK(lay_images(view, viewer.options.memory, viewer.gpu, whole.scene, true));
    viewer.scene = std::make_unique<Scene>(std::move(whole.scene));
    return {};
}

void take_renderer(Viewer& viewer, FrameRenderer renderer) {
    if (viewer.has_picture) viewer.kept = viewer.renderer.release_picture();
    viewer.renderer = std::move(renderer);
    viewer.has_picture = false;
}

// Takes a view whose style or light differ from what is shown; told and left where it cannot be drawn so.
Result<void> take_look(Viewer& viewer, View view) {
    const HeightField& field = viewer.region.grids.front().field;
    Result<Style> style = load_style(view, field);
    if (!style.ok()) {
        tell(viewer, style.error());
        return field.health();
    }
    const Result<bool> clusters = choose_clusters_of(viewer, view);
    if (!clusters.ok()) {
        tell(viewer, clusters.error());
        return {};
    }
    const bool other_mesh = view.mesh != viewer.view.mesh;
    const bool other_renderer =
        style->frame.smooth_edges != viewer.style.frame.smooth_edges || view.show != viewer.view.show;
    const bool other_scene = asks_for_means(style->frame) && !asks_for_means(viewer.style.frame);
    if (other_renderer) {
        // A device may lack what explains a frame.
        Result<FrameRenderer> renderer =
            renderer_for(viewer.gpu, view, *style, viewer.path, viewer.renderer.extent());
        if (!renderer.ok()) {
            tell(viewer, renderer.error());
            return {};
        }
        take_renderer(viewer, std::move(renderer).value());
    }
    viewer.view = std::move(view);
    viewer.style = *std::move(style);
    // Means are kept for who asks for them: from then on they are there.
    const bool lacks_means = other_scene && !viewer.keeps_means;
    viewer.keeps_means = viewer.keeps_means || lacks_means;
    if (lacks_means || other_mesh) ORO_CHECK(renew_scene(viewer));
    viewer.wants_picture = true;
    return {};
}

}  // namespace

Result<void> renew_renderer(Viewer& viewer) {
    ORO_TRY(FrameRenderer renderer,
            renderer_for(viewer.gpu, viewer.view, viewer.style, viewer.path, viewer.renderer.extent()));
    take_renderer(viewer, std::move(renderer));
    return {};
}

Result<void> choose_style(Viewer& viewer, const std::string& style) {
    View view = viewer.view;
    view.style = style;
    view.style_text.reset();
    if (!view.sun || view.sun->is_usual) view.sun = sun_of_style(view);
    return take_look(viewer, std::move(view));
}

Result<void> choose_show(Viewer& viewer, std::optional<Show> show) {
    View view = viewer.view;
    view.show = show;
    return take_look(viewer, std::move(view));
}

Result<void> choose_sun(Viewer& viewer, const std::string& time) {
    View view = viewer.view;
    if (time.empty()) {
        view.sun = sun_of_style(view);
        return take_look(viewer, std::move(view));
    }
    const Result<SunTime> read = parse_time("--sun-time", time);
    if (!read.ok()) {
        tell(viewer, read.error());
        return {};
    }
    view.sun = SunDirection{0.0, 0.0, *read};
    aim_sun(view.sun, view.camera.eye);
    return take_look(viewer, std::move(view));
}

Result<void> choose_light(Viewer& viewer, std::optional<bool> shadows, std::optional<bool> sky_openness) {
    View view = viewer.view;
    view.shadows = shadows;
    view.sky_openness = sky_openness;
    return take_look(viewer, std::move(view));
}

Result<void> choose_exaggeration(Viewer& viewer, double factor) {
    if (factor == viewer.view.exaggeration) return {};
    const double before = std::exchange(viewer.view.exaggeration, factor);
    viewer.ground.reset();
    viewer.under_pointer.reset();
    viewer.picked.reset();
    viewer.wants_picture = true;
    const Result<void> renewed = renew_scene(viewer);
    if (!renewed.ok() && renewed.error().kind == ErrorKind::usage) {
        tell(viewer, renewed.error());
        viewer.view.exaggeration = before;
        return {};
    }
    const Geodetic& eye = viewer.view.camera.eye;
    viewer.view.camera =
        above_ground(viewer.view.camera, grid_at(viewer.region, eye.lat_deg, eye.lon_deg).field, factor);
    return renewed;
}

Result<bool> choose_vectors(Viewer& viewer, const VectorChoices& choices) {
    std::vector<Fingerprints::OfSource> fingerprints;
    Result<std::shared_ptr<const VectorsRead>> read = open_vectors(choices, fingerprints);
    if (!read.ok()) {
        tell(viewer, read.error());
        return false;
    }
    viewer.view.vectors = choices;
    viewer.view.vectors_read = *std::move(read);
    if (viewer.view.fingerprints) viewer.view.fingerprints->vectors = std::move(fingerprints);
    index_points(viewer);
    viewer.wants_picture = true;
    return true;
}

Result<void> choose_drape(Viewer& viewer, const std::vector<std::string>& files, double opacity) {
    std::vector<ImageSource> images;
    std::vector<Fingerprints::OfSource> fingerprints;
    for (const std::string& file : files) {
        Result<ImageSource> image = open_image(file, viewer.view.drape_values);
        if (!image.ok()) {
            tell(viewer, image.error());
            return {};
        }
        fingerprints.push_back({std::filesystem::path(file).filename().string(), image->fingerprint});
        images.push_back(*std::move(image));
    }
    viewer.view.drape = files;
    viewer.view.drape_opacity = opacity;
    viewer.view.images = std::move(images);
    if (viewer.view.fingerprints) viewer.view.fingerprints->images = std::move(fingerprints);
    for (Scene* const scene : {viewer.scene.get(), viewer.coming.get()}) {
        if (scene == nullptr) continue;
        for (std::size_t grid = 0; grid < scene->grids().size(); ++grid) scene->set_drape(nullptr, grid);
        ORO_CHECK(lay_images(viewer.view, viewer.options.memory, viewer.gpu, *scene, true));
    }
    viewer.wants_picture = true;
    return {};
}

std::vector<std::string> names_of_styles() {
    std::vector<std::string> names;
    std::error_code failed;
    std::filesystem::directory_iterator entry(data_folder() / "styles", failed);
    for (; !failed && entry != std::filesystem::directory_iterator(); entry.increment(failed))
        if (entry->path().extension() == ".json") names.push_back(entry->path().stem().string());
    std::ranges::sort(names, {}, [](const std::string& name) { return std::pair(name != "natural", name); });
    return names;
}

}  // namespace oro
