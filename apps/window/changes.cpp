#include "apps/window/changes.h"

#include <utility>

#include "apps/drawing/mesh_cut.h"
#include "apps/navigation/flight_step.h"
#include "apps/view/mesh_parts.h"
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

// A choice of clusters that the window made is made anew; the user's own stays.
void forget_mesh(const Viewer& viewer, View& view) {
    if (!viewer.options.view.mesh) view.mesh = "auto";
}

Result<void> take_renderer(Viewer& viewer, FrameRenderer renderer) {
    ORO_CHECK(finish_frames(viewer));
    if (viewer.has_picture) viewer.kept = viewer.renderer.release_picture();
    viewer.renderer = std::move(renderer);
    viewer.has_picture = false;
    return {};
}

// Takes a view whose style or light differ from what is shown; told and left where it cannot be drawn so.
Result<void> take_look(Viewer& viewer, View view) {
    const HeightField& field = viewer.region.grids.front().field;
    forget_mesh(viewer, view);
    settle_mesh_parts(viewer.region, view);
    Result<Style> style = load_style(view, field);
    if (!style.ok()) {
        tell(viewer, style.error());
        return field.health();
    }
    const Result<bool> clusters = draws_terrain_clusters(viewer.region, view);
    if (!clusters.ok()) {
        tell(viewer, clusters.error());
        return {};
    }
    const bool other_mesh = view.mesh != viewer.view.mesh;
    const bool other_renderer =
        style->frame.smooth_edges != viewer.style.frame.smooth_edges || view.show != viewer.view.show;
    // Means are kept for who asks for them: from then on they are there.
    const bool lacks_means = asks_for_means(style->frame) && !viewer.keeps_means;
    if (other_renderer) {
        // A device may lack what explains a frame.
        Result<FrameRenderer> renderer =
            renderer_for(viewer.gpu, view, *style, viewer.path, viewer.renderer.extent());
        if (!renderer.ok()) {
            tell(viewer, renderer.error());
            return {};
        }
        ORO_CHECK(take_renderer(viewer, std::move(*renderer)));
    }
    viewer.view = std::move(view);
    viewer.style = std::move(*style);
    viewer.keeps_means = viewer.keeps_means || lacks_means;
    if (lacks_means || other_mesh) ORO_CHECK(renew_scene(viewer));
    viewer.wants_picture = true;
    return follow_first_view(viewer);
}

// Says the notes of files that were read.
void tell_notes(Viewer& viewer, const VectorsRead& vectors) {
    for (const auto* const files : {&vectors.names, &vectors.overlay})
        for (const VectorFile& file : *files)
            for (const std::string& note : file.notes) tell(viewer, note);
}

}  // namespace

Result<void> renew_scene(Viewer& viewer) {
    ORO_CHECK(finish_frames(viewer));
    forget_mesh(viewer, viewer.view);
    ORO_TRY(OpenedScene opened,
            open_scene(viewer.gpu, viewer.region, viewer.cuts, viewer.view,
                       {memory_of_first(viewer), true, viewer.keeps_means}, [](double) {}));
    take_scene(viewer, std::move(opened));
    return is_tinted(viewer) ? lay_over_ground(viewer) : Result<void>();
}

Result<void> renew_renderer(Viewer& viewer) {
    ORO_TRY(FrameRenderer renderer,
            renderer_for(viewer.gpu, viewer.view, viewer.style, viewer.path, viewer.renderer.extent()));
    return take_renderer(viewer, std::move(renderer));
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

Result<void> choose_graticule(Viewer& viewer, std::optional<Graticule> graticule) {
    const auto before = std::exchange(viewer.view.graticule, graticule);
    if (const auto found = find_graticule_crs(viewer.view, viewer.region); !found.ok()) {
        tell(viewer, found.error());
        viewer.view.graticule = before;
        return find_graticule_crs(viewer.view, viewer.region);
    }
    viewer.wants_picture = true;
    return follow_first_view(viewer);
}

Result<void> choose_exaggeration(Viewer& viewer, double factor) {
    if (factor == viewer.view.exaggeration) return {};
    const double before = std::exchange(viewer.view.exaggeration, factor);
    forget_ground(viewer);
    viewer.way_home = {};
    viewer.under_pointer.reset();
    viewer.picked.reset();
    viewer.jumped_to.reset();
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
    return renewed.ok() ? follow_first_view(viewer) : renewed;
}

Result<bool> choose_vectors(Viewer& viewer, const VectorChoices& choices) {
    std::vector<Fingerprints::OfSource> fingerprints;
    Result<std::shared_ptr<const VectorsRead>> read = open_vectors(choices, viewer.region, fingerprints);
    if (!read.ok()) {
        tell(viewer, read.error());
        return false;
    }
    viewer.view.vectors = choices;
    viewer.view.vectors_read = std::move(*read);
    if (viewer.view.vectors_read) tell_notes(viewer, *viewer.view.vectors_read);
    if (viewer.view.fingerprints) viewer.view.fingerprints->vectors = std::move(fingerprints);
    index_points(viewer);
    viewer.wants_picture = true;
    ORO_CHECK(follow_first_view(viewer));
    return true;
}

Result<void> choose_drape(Viewer& viewer, const std::vector<std::string>& files, double opacity) {
    std::vector<Fingerprints::OfSource> fingerprints;
    Result<std::vector<ImageSource>> images = open_images(files, viewer.view.drape_values, fingerprints);
    if (!images.ok()) {
        tell(viewer, images.error());
        return {};
    }
    viewer.view.drape = files;
    viewer.view.drape_opacity = opacity;
    viewer.view.images = std::move(*images);
    if (viewer.view.fingerprints) viewer.view.fingerprints->images = std::move(fingerprints);
    viewer.wants_picture = true;
    ORO_CHECK(lay_over_ground(viewer));
    return follow_first_view(viewer);
}

Result<void> choose_cover(Viewer& viewer, const std::vector<std::string>& files) {
    CoverChoice choice{files, files.empty() ? "" : viewer.view.cover_choice.table};
    std::vector<Fingerprints::OfSource> fingerprints;
    Result<std::shared_ptr<const CoverMap>> cover = open_cover(choice, fingerprints);
    if (!cover.ok()) {
        tell(viewer, cover.error());
        return {};
    }
    viewer.view.cover_choice = std::move(choice);
    viewer.view.cover = std::move(*cover);
    if (viewer.view.fingerprints) viewer.view.fingerprints->cover = std::move(fingerprints);
    viewer.under_pointer.reset();
    viewer.wants_picture = true;
    ORO_CHECK(lay_over_ground(viewer));
    return follow_first_view(viewer);
}

}  // namespace oro
