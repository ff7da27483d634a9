// From options to a view: numbers checked, the clock asked, nothing opened.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/options/region_option_table.h"
#include "apps/report/json_text.h"
#include "apps/view/accuracy.h"
#include "apps/view/mesh_request.h"
#include "apps/view/model_names.h"
#include "apps/view/style.h"
#include "apps/view/view.h"
#include "apps/view/view_option_table.h"
#include "geo/sources/source_overrides.h"

namespace oro {
namespace {

Result<void> set_size(const std::string& text, Camera& camera) {
    const std::size_t cross = text.find_first_of("xX");
    long long width = 0, height = 0;
    if (cross == std::string::npos || !read_whole(std::string_view(text).substr(0, cross), width) ||
        !read_whole(std::string_view(text).substr(cross + 1), height))
        return refused("--size", text, "must be WIDTHxHEIGHT in pixels, e.g. 1920x1080");
    constexpr Limits side_px = view_limits::side_px;
    if (!side_px.hold(static_cast<double>(width)) || !side_px.hold(static_cast<double>(height)))
        return refused("--size", text, "each side " + between_words(side_px.low, side_px.high) + " pixels");
    camera.width_px = static_cast<int>(width);
    camera.height_px = static_cast<int>(height);
    return {};
}

// Of a picture without --time.
Result<std::int64_t> picture_time_s() {
    const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
    std::int64_t fixed = 0;
    if (epoch && (!read_whole(std::string_view(epoch), fixed) ||
                  !view_limits::time_utc_s.hold(static_cast<double>(fixed))))
        return refused("SOURCE_DATE_EPOCH", epoch, "is no number of seconds within the years 0 to 9999");
    return time_now_s();
}

// After the picture's time, which the sun may go by.
Result<void> apply_sun(View& view, const ViewOptions& options) {
    if (options.sun) {
        ORO_TRY(view.sun, parse_sun(*options.sun));
    }
    if (options.sun_time) {
        const bool pictures = *options.sun_time == "view";
        ORO_TRY(const SunTime time,
                parse_time("--sun-time", pictures ? time_text(view.time_utc_s) : *options.sun_time));
        view.sun = SunDirection{0.0, 0.0, time};
    }
    return {};
}

// The images and what is said of them.
Result<void> check_drape(const View& view, const ViewOptions& options) {
    const char* const option =
        first_given_of(view_option_table(), options, {"--drape-opacity", "--drape-values"});
    if (view.drape.empty() && option) return refused(option, "", "says nothing without --drape FILE");
    return {};
}

// A level of the graph and an error in pixels ask for different clusters: what an option says takes the place
// of what a view's file has.
Result<void> choose_mesh_level(View& view, const ViewOptions& options) {
    for (const auto& [option, is_given] : {std::pair{"--tau", options.tau_px.has_value()},
                                           {"--accuracy", options.accuracy.has_value()},
                                           {"--tolerance", options.tolerance.has_value()},
                                           {"--mesh grid", options.mesh == "grid"}}) {
        if (!is_given) continue;
        if (options.mesh_level) return refused("--mesh-level", "", either_words("--mesh-level", option));
        view.mesh_level.reset();
    }
    return {};
}

// Who wants no trees wants none that a view has from files, either.
void leave_canopy_out(View& view, const ViewOptions& options) {
    if (options.trees == "off" && options.canopy.empty()) view.canopy_choice = {};
}

// The options that a view from a file can be changed by.
Result<void> apply_look(View& view, const ViewOptions& options) {
    if (options.legend) view.legend = true;
    if (options.size) ORO_CHECK(set_size(*options.size, view.camera));
    if (options.accuracy) {
        ORO_TRY(const AccuracyBundle bundle, accuracy_bundle(*options.accuracy));
        apply_bundle(bundle, view);
    }
    for (const ViewOption& option : view_option_table())
        if (option.apply && !is_of_eye(option)) ORO_CHECK(option.apply(options, view));
    view.style = present_name(view.style);
    view.sea_asked |= options.sea.has_value();
    view.rim_asked |= options.rim.has_value();
    ORO_CHECK(check_vectors(options, view.vectors));
    ORO_CHECK(check_drape(view, options));
    if (!options.landcover.empty()) {
        ORO_TRY(view.cover_choice, cover_choice_from(options.landcover));
    }
    if (!options.canopy.empty() || options.canopy_held) {
        const std::vector<std::string> words =
            options.canopy.empty() ? words_of(view.canopy_choice) : options.canopy;
        ORO_TRY(view.canopy_choice,
                canopy_choice_from(words, options.canopy_held, !view.cover_choice.files.empty()));
    }
    leave_canopy_out(view, options);
    if (options.detail) {
        ORO_TRY(view.detail, detail_choice_from(*options.detail));
    }
    if (view.show && view.samples > 1)
        return refused("--show", "", "is for pictures of one sample, not together with --samples");
    ORO_CHECK(choose_mesh_level(view, options));
    ORO_TRY(view.model.air, air_asked_for(options.refraction_k, options.air, view.model.air));
    forget_other_bundle(view);
    if (options.time) {
        ORO_TRY(const SunTime time, parse_time("--time", *options.time));
        view.time_utc_s = time.utc_s;
    }
    return apply_sun(view, options);
}

}  // namespace

Result<Air> air_asked_for(const std::optional<double>& refraction_k, const std::optional<std::string>& air,
                          const Air& usual) {
    if (refraction_k) {
        ORO_TRY(const double k, within("--refraction", *refraction_k, view_limits::refraction_k));
        return Air{k, AirLaw::constant};
    }
    return air ? choice_named("--air", air_names, *air) : Result<Air>(usual);
}

std::int64_t time_now_s() {
    std::int64_t fixed = 0;
    if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
        epoch && read_whole(std::string_view(epoch), fixed))
        return fixed;
    return std::chrono::duration_cast<std::chrono::seconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

Result<RegionRequest> region_request(const RegionOptions& options) {
    if (options.paths.empty())
        return refused("PATH", "", "is missing: name a file or a folder of elevation data");
    RegionRequest request;
    request.paths = terrain_paths(options);
    if (request.paths.empty())
        return refused("PATH", options.paths.front(),
                       "is a mesh: name elevation data as well, the terrain that it lies on");
    request.strict_datum = options.strict_datum;
    request.fill_voids = options.fill_voids;
    request.resample = options.resample;
    request.allow_multiple_grids = true;
    request.listed_first = options.order == "listed";
    if (options.feather_m) {
        ORO_TRY(request.feather_m, within("--feather", *options.feather_m, view_limits::feather_m));
    }
    request.height_unit = options.height_unit;
    request.source_crs = options.source_crs;
    request.source_vertical = options.source_vertical;
    if (const auto fault = fault_of_source_crs(options.source_crs))
        return refused("--source-crs", options.source_crs, *fault);
    if (const auto fault = fault_of_source_vertical(options.source_vertical))
        return refused("--source-vertical", options.source_vertical, *fault);
    ORO_TRY(request.meshes, mesh_request(options));
    if (!options.bbox.empty()) {
        const Result<BoundingBox> box = parse_bounding_box(options.bbox);
        if (!box.ok()) return refused("--bbox", options.bbox, box.error().what);
        request.box = *box;
    } else if (!options.tile.empty()) {
        const Result<BoundingBox> box = parse_tile_range(options.tile);
        if (!box.ok()) return refused("--tile", options.tile, box.error().what);
        request.box = *box;
    }
    return request;
}

Result<View> view_without_eye(const ViewOptions& options, RegionRequest region) {
    View view;
    view.region = std::move(region);
    view.camera.width_px = 1280;
    view.camera.height_px = 720;
    if (!options.time) {
        ORO_TRY(view.time_utc_s, picture_time_s());
    }
    ORO_CHECK(apply_look(view, options));
    for (const ViewOption& option : view_option_table())
        if (option.apply && is_of_eye(option)) ORO_CHECK(option.apply(options, view));
    double& heading_deg = view.camera.attitude.heading_deg;
    heading_deg = std::fmod(heading_deg + 360.0, 360.0);
    if (options.look_at && (options.heading_deg || options.pitch_deg))
        return refused("--look-at", "", either_words("--look-at", "--heading and --pitch"));
    if (options.altitude_m) ORO_CHECK(within("--altitude", *options.altitude_m, view_limits::altitude_m));
    if (options.above_m) ORO_CHECK(within("--above", *options.above_m, view_limits::above_m));
    const char* const of_place = first_given_of(
        view_option_table(), options, {"--above", "--altitude", "--on-summit", "--stand-on", "--look-at"});
    if (!options.at && of_place) return refused(of_place, "", "says nothing without --at PLACE");
    return view;
}

Result<void> change_view(View& view, const ViewOptions& options) {
    if (const char* const option = first_given(view_option_table(), options, is_of_eye))
        return refused(option, "", "not together with --view, which has an eye of its own");
    return apply_look(view, options);
}

Result<void> change_region(View& view, const RegionOptions& options) {
    RegionOptions but_files = options;
    but_files.mesh_files.clear();
    if (const char* const option = first_given_of_region(but_files))
        return refused(option, "", "not together with a picture's view, which says it itself");
    std::vector<std::string> terrain = terrain_paths(options), meshes = mesh_files_of(options);
    if (!meshes.empty() && view.region.meshes.files.empty())
        return refused(options.mesh_files.empty() ? "PATH" : "--mesh-file", meshes.front(),
                       "is a mesh, and the view has none");
    if (!terrain.empty()) view.region.paths = std::move(terrain);
    if (!meshes.empty()) view.region.meshes.files = std::move(meshes);
    return {};
}

}  // namespace oro
