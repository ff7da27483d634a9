// Where the eye of a view is: on a place, or so that a place or the whole region can be seen.
#include <cmath>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/eye/standpoint.h"
#include "apps/options/view_limits.h"
#include "apps/view/overview.h"
#include "apps/view/place_camera.h"
#include "apps/view/view.h"
#include "core/terrain/ground.h"

namespace oro {
namespace {

Result<Standpoint> standpoint_of(const ViewOptions& options, const Region& region, double exaggeration) {
    Standing standing{"--at", *options.at, "--above", options.above_m, 2.0, options.altitude_m};
    standing.on_summit = options.on_summit;
    standing.on_top = options.stand_on.value_or("ground") == "top";
    ORO_TRY(Standpoint stood, stand(standing, region, exaggeration));
    ORO_CHECK(lift_onto_top(standing, region, exaggeration, stood.eye));
    return stood;
}

Result<void> stand_at(View& view, const ViewOptions& options, const Region& region) {
    ORO_TRY(const Standpoint stood, standpoint_of(options, region, view.exaggeration));
    view.camera.eye = stood.eye;
    view.stood = {stood.moved, stood.wall};
    return {};
}

// Whether somebody says how high over the place, or towards what, the eye is: it is then there.
bool stands(const ViewOptions& options, const Place& place) {
    return options.stands_at_place || options.above_m || options.altitude_m || options.look_at ||
           options.on_summit || options.stand_on || place.height_m;
}

Result<void> show_place(View& view, const ViewOptions& options, const Place& place, const Region& region) {
    AskedLine asked;
    if (options.heading_deg) asked.heading_deg = view.camera.attitude.heading_deg;
    if (options.pitch_deg) asked.pitch_deg = view.camera.attitude.pitch_deg;
    if (is_framed(place, region) && !options.vertical_fov_deg)
        view.camera.vertical_fov_deg = overview_fov_deg;
    ORO_TRY(view.camera,
            camera_showing(view.camera, place, asked, region, view.exaggeration,
                           "--at " + (place.cell ? *options.at : place_name(place.lat_deg, place.lon_deg))));
    return {};
}

Result<void> turn_to(View& view, const std::string& text, const Region& region) {
    ORO_TRY(const Place place, place_at("--look-at", text));
    const HeightField& field = grid_at(region, place.lat_deg, place.lon_deg).field;
    const std::optional<double> ground =
        standing_h_m(region, field, view.exaggeration, place.lat_deg, place.lon_deg);
    if (!ground && !place.height_m)
        return Error{ErrorKind::no_data, "--look-at " + place_name(place.lat_deg, place.lon_deg),
                     "no elevation data there; give a heading and pitch, or geo:LAT,LON,HEIGHT" +
                         where_data_are(field.grid, place.lat_deg, place.lon_deg)};
    const double h_m = place.height_m.value_or(ground.value_or(0.0));
    const double roll_deg = view.camera.attitude.roll_deg;
    view.camera.attitude = attitude_towards(view.camera.eye, {place.lat_deg, place.lon_deg, h_m});
    view.camera.attitude.roll_deg = roll_deg;
    return {};
}

// A view's file holds no more than these; --at alone says where the eye is.
Result<void> check_eye(const ViewOptions& options, const Geodetic& eye) {
    if (view_limits::eye_h_m.hold(eye.h_m)) return {};
    char text[120];
    std::snprintf(text, sizeof text, "the eye would be at h %g m, not between %g and %g", eye.h_m,
                  view_limits::eye_h_m.low, view_limits::eye_h_m.high);
    return refused("--at", options.at.value_or(""), text);
}

}  // namespace

Result<void> place_eye(View& view, const ViewOptions& options, const Region& region) {
    if (!options.at) return see_whole_region(view, options, region);
    ORO_TRY(const Place place, place_at("--at", *options.at));
    ORO_CHECK(stands(options, place) ? stand_at(view, options, region)
                                     : show_place(view, options, place, region));
    ORO_CHECK(check_eye(options, view.camera.eye));
    if (options.look_at) ORO_CHECK(turn_to(view, *options.look_at, region));
    return {};
}

Result<std::string> nothing_in_view(const View& view, const Region& region, const std::string& view_file) {
    const Geodetic& eye = view.camera.eye;
    const PostGrid& grid = grid_at(region, eye.lat_deg, eye.lon_deg).field.grid;
    const std::string what = "nothing of the region is in view";
    if (holds(grid, eye.lat_deg, eye.lon_deg)) return what + ": the eye is over the data and looks past them";
    return Error{ErrorKind::no_data, view_file.empty() ? "" : "--view " + view_file,
                 what + " from " + place_name(eye.lat_deg, eye.lon_deg) +
                     where_data_are(grid, eye.lat_deg, eye.lon_deg)};
}

}  // namespace oro
