#include "apps/window/kept_view.h"

#include <utility>

#include "apps/view/style.h"
#include "apps/window/window_start.h"

namespace oro {

WindowOptions options_for_other_region(const WindowOptions& options, const View& shown,
                                       const std::vector<std::string>& paths) {
    WindowOptions other = options;
    other.view_file.clear();
    other.region = {};
    other.region.paths = paths;
    other.region.fill_voids = options.region.fill_voids;
    other.region.strict_datum = options.region.strict_datum;
    other.view = {};
    other.view.size = std::to_string(shown.camera.width_px) + "x" + std::to_string(shown.camera.height_px);
    other.view.vertical_fov_deg = shown.camera.vertical_fov_deg;
    other.view.roll_deg = options.view.roll_deg;
    other.view.exaggeration = shown.exaggeration;
    other.view.geoid = options.view.geoid;
    other.view.mesh = options.view.mesh;
    other.view.tau_px = shown.tau_px;
    if (shown.canopy_choice.asked()) {
        other.view.canopy = words_of(shown.canopy_choice);
        other.view.canopy_held = shown.canopy_choice.held;
        // The classes that it takes heights of.
        if (shown.canopy_choice.by_class) other.view.landcover = words_of(shown.cover_choice);
    }
    return other;
}

Result<void> open_other_region(WindowOptions& options, const Progress& progress, View& view, Region& region) {
    const Result<void> opened = open_flight(options, progress, view, region);
    if (opened.ok() || options.view.canopy.empty() || opened.error().kind != ErrorKind::no_data)
        return opened;
    WindowOptions bare = options;
    bare.view.canopy.clear();
    bare.view.canopy_held.reset();
    view = {};
    region = {};
    // What is wrong without it, too, is no fault of the canopy's.
    ORO_CHECK(open_flight(bare, progress, view, region));
    options = std::move(bare);
    return {};
}

void keep_choices(const View& shown, View& view) {
    const double exaggeration = view.exaggeration;
    static_cast<ViewSettings<OfView>&>(view) = shown;
    view.exaggeration = exaggeration;
    // What draws it, and whether by clusters, is chosen anew.
    view.mesh = shown.mesh == "grid" ? "grid" : "auto";
    view.mesh_level.reset();
    if (is_of_clusters(view.show)) view.show.reset();
    view.style_text = shown.style_text;
    view.sea_asked = shown.sea_asked;
    view.rim_asked = shown.rim_asked;
    view.model.air = shown.model.air;
    view.accuracy = shown.accuracy;
    view.vectors = shown.vectors;
    view.vectors_read = shown.vectors_read;
    view.images = shown.images;
    view.cover_choice = shown.cover_choice;
    view.cover = shown.cover;
    if (view.fingerprints && shown.fingerprints) {
        view.fingerprints->images = shown.fingerprints->images;
        view.fingerprints->cover = shown.fingerprints->cover;
        view.fingerprints->vectors = shown.fingerprints->vectors;
    }
    if (shown.sun && !shown.sun->is_usual)
        view.sun = shown.sun;
    else if (has_sun_by_place(view))
        view.sun = usual_sun();
    else
        view.sun.reset();
    aim_sun(view.sun, view.camera.eye);
}

}  // namespace oro
