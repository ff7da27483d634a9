// From options to a view: numbers checked, the clock asked, nothing opened.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/command_line/whole_text.h"
#include "apps/options/view_limits.h"
#include "apps/report/json_text.h"
#include "apps/view/accuracy.h"
#include "apps/view/model_names.h"
#include "apps/view/view.h"
#include "geo/sources/told_of_files.h"

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

Result<double> within(const char* option, double value, const Limits& limits) {
    if (limits.hold(value)) return value;
    char text[40];
    std::snprintf(text, sizeof text, "%.15g", value);
    return refused(option, text, between_words(limits.low, limits.high));
}

Result<void> apply_models(View& view, const ViewOptions& options) {
    if (options.accuracy) {
        ORO_TRY(const AccuracyBundle bundle, accuracy_bundle(*options.accuracy));
        apply_bundle(bundle, view);
    }
    if (options.earth) {
        ORO_TRY(view.model.earth, earth_named(*options.earth));
    }
    ORO_TRY(view.model.air, air_asked_for(options.refraction_k, options.air, view.model.air));
    if (options.precision) {
        ORO_TRY(view.model.precision, precision_named(*options.precision));
    }
    if (options.geoid) {
        ORO_TRY(view.has_geoid, geoid_named(*options.geoid));
    }
    if (options.heights) {
        ORO_TRY(view.heights, heights_named(*options.heights));
    }
    return {};
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

Result<void> apply_drape(View& view, const ViewOptions& options) {
    if (!options.drape.empty()) view.drape = options.drape;
    if (view.drape.empty() && (options.drape_opacity || options.drape_values))
        return refused(options.drape_opacity ? "--drape-opacity" : "--drape-values", "",
                       "says nothing without --drape FILE");
    if (options.drape_opacity) {
        ORO_TRY(view.drape_opacity,
                within("--drape-opacity", *options.drape_opacity, view_limits::drape_opacity));
    }
    if (options.drape_values) {
        ORO_TRY(view.drape_values, drape_values_named(*options.drape_values));
    }
    return {};
}

Result<bool> switch_named(const std::string& option, const std::string& word) {
    if (word != "on" && word != "off")
        return Error{ErrorKind::usage, option, "'" + word + "' is neither on nor off"};
    return word == "on";
}

// What the ground and the air look like.
Result<void> apply_colours(View& view, const ViewOptions& options) {
    if (options.style) view.style = *options.style;
    if (options.visibility_km) {
        ORO_TRY(view.visibility_km,
                within("--visibility", *options.visibility_km, view_limits::visibility_km));
    }
    if (options.sea) {
        ORO_TRY(view.sea, sea_named(*options.sea));
        view.sea_asked = true;
    }
    if (options.rim) {
        ORO_TRY(view.rim, rim_named(*options.rim));
        view.rim_asked = true;
    }
    if (options.shadows) {
        ORO_TRY(view.shadows, switch_named("--shadows", *options.shadows));
    }
    if (options.sky_openness) {
        ORO_TRY(view.sky_openness, switch_named("--sky-openness", *options.sky_openness));
    }
    if (options.labels) {
        ORO_TRY(view.labels, switch_named("--labels", *options.labels));
    }
    if (options.show) {
        ORO_TRY(view.show, show_named(*options.show));
    }
    if (options.edges) {
        ORO_TRY(view.edges, edges_named(*options.edges));
    }
    ORO_CHECK(choose_vectors(options, view.vectors));
    return apply_drape(view, options);
}

// A level of the graph and an error in pixels ask for different clusters: what an option says takes the place
// of what a view's file has.
Result<void> apply_mesh(View& view, const ViewOptions& options) {
    if (options.mesh) view.mesh = *options.mesh;
    for (const auto& [option, is_given] : {std::pair{"--tau", options.tau_px.has_value()},
                                           {"--accuracy", options.accuracy.has_value()},
                                           {"--tolerance", options.tolerance.has_value()},
                                           {"--mesh grid", options.mesh == "grid"}}) {
        if (!is_given) continue;
        if (options.mesh_level) return refused("--mesh-level", "", either_words("--mesh-level", option));
        view.mesh_level.reset();
    }
    if (options.mesh_level) {
        ORO_TRY(const double level, within("--mesh-level", *options.mesh_level, view_limits::mesh_level));
        view.mesh_level = static_cast<int>(level);
    }
    return {};
}

// The options that a view from a file can be changed by.
Result<void> apply_look(View& view, const ViewOptions& options) {
    if (options.legend) view.legend = true;
    if (options.size) ORO_CHECK(set_size(*options.size, view.camera));
    if (options.exaggeration) {
        ORO_TRY(view.exaggeration,
                within("--exaggeration", *options.exaggeration, view_limits::exaggeration));
    }
    if (options.samples) {
        ORO_TRY(const double samples, within("--samples", *options.samples, view_limits::samples));
        view.samples = static_cast<int>(samples);
    }
    ORO_CHECK(apply_colours(view, options));
    if (view.show && view.samples > 1)
        return refused("--show", "", "is for pictures of one sample, not together with --samples");
    if (options.pipeline) view.pipeline = *options.pipeline;
    ORO_CHECK(apply_mesh(view, options));
    ORO_CHECK(apply_models(view, options));
    if (options.tau_px) {
        ORO_TRY(view.tau_px, within("--tau", *options.tau_px, view_limits::tau_px));
    }
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
    return air ? air_named(*air) : Result<Air>(usual);
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
    request.paths = options.paths;
    request.strict_datum = options.strict_datum;
    request.fill_voids = options.fill_voids;
    request.resample = options.resample;
    request.grids_apart = true;
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
    if (options.vertical_fov_deg) {
        ORO_TRY(view.camera.vertical_fov_deg,
                within("--fov", *options.vertical_fov_deg, view_limits::fov_deg));
    }
    Attitude& attitude = view.camera.attitude;
    if (options.heading_deg) {
        ORO_TRY(attitude.heading_deg, within("--heading", *options.heading_deg, view_limits::heading_deg));
        attitude.heading_deg = std::fmod(attitude.heading_deg + 360.0, 360.0);
    }
    if (options.pitch_deg) {
        ORO_TRY(attitude.pitch_deg, within("--pitch", *options.pitch_deg, view_limits::pitch_deg));
    }
    if (options.roll_deg) {
        ORO_TRY(attitude.roll_deg, within("--roll", *options.roll_deg, view_limits::roll_deg));
    }
    if (options.look_at && (options.heading_deg || options.pitch_deg))
        return refused("--look-at", "", either_words("--look-at", "--heading and --pitch"));
    if (options.altitude_m) ORO_CHECK(within("--altitude", *options.altitude_m, view_limits::altitude_m));
    if (options.above_m) ORO_CHECK(within("--above", *options.above_m, view_limits::above_m));
    if (!options.at && (options.above_m || options.altitude_m || options.on_summit || options.look_at))
        return refused(options.above_m      ? "--above"
                       : options.altitude_m ? "--altitude"
                       : options.on_summit  ? "--on-summit"
                                            : "--look-at",
                       "", "says nothing without --at PLACE");
    return view;
}

Result<void> change_view(View& view, const ViewOptions& options) {
    for (const auto& [option, is_given] : {std::pair{"--at", options.at.has_value()},
                                           {"--above", options.above_m.has_value()},
                                           {"--altitude", options.altitude_m.has_value()},
                                           {"--heading", options.heading_deg.has_value()},
                                           {"--pitch", options.pitch_deg.has_value()},
                                           {"--roll", options.roll_deg.has_value()},
                                           {"--fov", options.vertical_fov_deg.has_value()},
                                           {"--on-summit", options.on_summit},
                                           {"--look-at", options.look_at.has_value()}}) {
        if (is_given) return refused(option, "", "not together with --view, which has an eye of its own");
    }
    return apply_look(view, options);
}

Result<void> change_region(View& view, const RegionOptions& options) {
    for (const auto& [option, is_given] : {std::pair{"--bbox", !options.bbox.empty()},
                                           {"--tile", !options.tile.empty()},
                                           {"--height-unit", !options.height_unit.empty()},
                                           {"--source-crs", !options.source_crs.empty()},
                                           {"--source-vertical", !options.source_vertical.empty()},
                                           {"--strict-datum", options.strict_datum},
                                           {"--resample", options.resample},
                                           {"--order", !options.order.empty()},
                                           {"--feather", options.feather_m.has_value()},
                                           {"--fill-voids", options.fill_voids}}) {
        if (is_given) return refused(option, "", "not together with a picture's view, which says it itself");
    }
    if (!options.paths.empty()) view.region.paths = options.paths;
    return {};
}

}  // namespace oro
