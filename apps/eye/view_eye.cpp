// Where the eye of a view is: on a place, or so that the whole region can be seen.
#include <cmath>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/eye/overview.h"
#include "apps/view/view.h"
#include "apps/view/view_limits.h"
#include "core/terrain/ground.h"
#include "geo/places/place.h"

namespace oro {
namespace {

std::string place_name(double lat_deg, double lon_deg) {
    char text[64];
    std::snprintf(text, sizeof text, "%.6f,%.6f", lat_deg, lon_deg);
    return text;
}

bool holds(const PostGrid& grid, double lat_deg, double lon_deg) {
    const double row = grid.lat.index_at(lat_deg), column = grid.column_at(lon_deg);
    return row >= 0.0 && row <= grid.rows() - 1 && column >= 0.0 && column <= grid.columns() - 1;
}

// The data's extent, for who asked for a place without any; and whether the place lies inside when its
// latitude and longitude change places.
std::string where_data_are(const PostGrid& grid, double lat_deg, double lon_deg) {
    if (holds(grid, lat_deg, lon_deg)) return " (a hole in the data)";
    char text[200];
    std::snprintf(text, sizeof text, " (the data's box is %.6g,%.6g,%.6g,%.6g: west,south,east,north)",
                  grid.west_deg(), grid.south_deg(), grid.east_deg(), grid.north_deg());
    if (std::abs(lon_deg) > 90.0 || !holds(grid, lon_deg, lat_deg)) return text;
    return text + (". " + place_name(lon_deg, lat_deg)) + " lies inside: latitude comes first";
}

Result<Place> place_of(const char* option, const std::string& text) {
    Result<Place> place = parse_place(text);
    if (!place.ok()) return refused(option, text, place.error().what);
    return place;
}

Result<void> stand_at(View& view, const ViewOptions& options, const Region& region) {
    ORO_TRY(const Place place, place_of("--at", *options.at));
    Geodetic& eye = view.camera.eye;
    eye = {place.lat_deg, place.lon_deg, 0.0};
    if (place.height_m) {
        if (options.altitude_m || options.above_m)
            return refused("--at", *options.at,
                           "gives a height of its own: leave --above and --altitude out");
        eye.h_m = *place.height_m;  // of WGS84, as geo: places are: above the ellipsoid
        return {};
    }
    if (options.altitude_m) {
        eye.h_m = *options.altitude_m + region.field.undulation.at_m(eye.lat_deg, eye.lon_deg);
        return {};
    }
    const std::optional<double> ground =
        ground_h_m(region.field, eye.lat_deg, eye.lon_deg, view.exaggeration);
    if (!ground)
        return Error{ErrorKind::no_data, "--at " + place_name(eye.lat_deg, eye.lon_deg),
                     "no elevation data there to stand on; give --altitude METRES or another place" +
                         where_data_are(region.field.grid, eye.lat_deg, eye.lon_deg)};
    eye.h_m = *ground + options.above_m.value_or(2.0);
    return {};
}

Result<void> turn_to(View& view, const std::string& text, const Region& region) {
    ORO_TRY(const Place place, place_of("--look-at", text));
    const std::optional<double> ground =
        ground_h_m(region.field, place.lat_deg, place.lon_deg, view.exaggeration);
    if (!ground && !place.height_m)
        return Error{ErrorKind::no_data, "--look-at " + place_name(place.lat_deg, place.lon_deg),
                     "no elevation data there; give a heading and pitch, or geo:LAT,LON,HEIGHT" +
                         where_data_are(region.field.grid, place.lat_deg, place.lon_deg)};
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
    ORO_CHECK(stand_at(view, options, region));
    ORO_CHECK(check_eye(options, view.camera.eye));
    if (options.look_at) ORO_CHECK(turn_to(view, *options.look_at, region));
    return {};
}

Result<std::string> nothing_in_view(const View& view, const Region& region, const std::string& view_file) {
    const Geodetic& eye = view.camera.eye;
    const PostGrid& grid = region.field.grid;
    const std::string what = "nothing of the region is in view";
    if (holds(grid, eye.lat_deg, eye.lon_deg)) return what + ": the eye is over the data and looks past them";
    return Error{ErrorKind::no_data, view_file.empty() ? "" : "--view " + view_file,
                 what + " from " + place_name(eye.lat_deg, eye.lon_deg) +
                     where_data_are(grid, eye.lat_deg, eye.lon_deg)};
}

}  // namespace oro
