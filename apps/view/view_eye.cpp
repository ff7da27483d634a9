// Where the eye of a view is: on a place, or so that the whole region can be seen.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <limits>

#include "apps/command_line/refusals.h"
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

// Points all over the drawn surface, at most some 64 x 64 of them.
std::vector<Ecef> surface_points(const HeightField& field, double exaggeration) {
    std::vector<Ecef> points;
    const int row_step = std::max(1, field.grid.rows() / 64),
              column_step = std::max(1, field.grid.columns() / 64);
    for (int row = 0; row < field.grid.rows(); row += row_step) {
        for (int column = 0; column < field.grid.columns(); column += column_step) {
            if (!is_void(field.H_at_post_m(row, column)))
                points.push_back(post_ecef(field, row, column, exaggeration));
        }
    }
    return points;
}

// True when all points are inside the middle of the picture (a margin of 4 % on each side).
bool holds_all(const Camera& camera, const std::vector<Ecef>& points) {
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const glm::dvec3 eye = camera.eye_ecef().m;
    const glm::dvec2 reach = camera.half_fov_tangent() * 0.92;
    return std::all_of(points.begin(), points.end(), [&](const Ecef& point) {
        const glm::dvec3 view = view_from_ecef * (point.m - eye);
        return view.z < 0.0 && std::abs(view.x) <= -view.z * reach.x && std::abs(view.y) <= -view.z * reach.y;
    });
}

// An eye that looks at `centre` from a distance; oblique for parts of the Earth, from above for most of it.
void stand_off(Camera& camera, const Geodetic& centre, double heading_deg, double pitch_deg,
               double distance_m) {
    const double heading = radians_from_deg(heading_deg).rad, pitch = radians_from_deg(pitch_deg).rad;
    const glm::dvec3 forward(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch),
                             std::sin(pitch));
    const glm::dvec3 forward_ecef = ecef_from_enu(centre.lat_deg, centre.lon_deg) * forward;
    camera.eye = geodetic_from_ecef({ecef_from_geodetic(centre).m - distance_m * forward_ecef});
    const double roll_deg = camera.attitude.roll_deg;
    if (camera.eye.h_m > 3e6) {
        // Far out, north is up: heading and pitch towards the centre are those of the line of sight.
        camera.attitude = attitude_towards(camera.eye, centre);
    } else {
        camera.attitude = attitude_of_direction(camera.eye, forward_ecef);
    }
    camera.attitude.roll_deg = roll_deg;
}

Result<void> see_whole_region(View& view, const ViewOptions& options, const Region& region) {
    const std::vector<Ecef> points = surface_points(region.field, view.exaggeration);
    if (points.empty()) return Error{ErrorKind::no_data, "region", "every post is void"};
    glm::dvec3 mean(0.0);
    for (const Ecef& point : points) mean += point.m / static_cast<double>(points.size());
    double radius_m = 0.0;
    for (const Ecef& point : points) radius_m = std::max(radius_m, glm::length(point.m - mean));
    Geodetic centre = glm::length(mean) > 1e6 ? geodetic_from_ecef({mean}) : Geodetic{0.0, 0.0, 0.0};
    const bool wide = radius_m > 1.5e6;  // so curved that an oblique view would hide its far side
    if (wide) centre.h_m = 0.0;
    const double heading_deg = options.heading_deg.value_or(0.0);
    const double pitch_deg = options.pitch_deg.value_or(wide ? -89.9 : -32.0);
    double near_m = 0.0, far_m = std::max(1.0, radius_m);
    while (stand_off(view.camera, centre, heading_deg, pitch_deg, far_m),
           !holds_all(view.camera, points) && far_m < 1e9) {
        near_m = far_m;
        far_m *= 1.5;
    }
    for (int i = 0; i < 40; ++i) {
        const double middle_m = 0.5 * (near_m + far_m);
        stand_off(view.camera, centre, heading_deg, pitch_deg, middle_m);
        (holds_all(view.camera, points) ? far_m : near_m) = middle_m;
    }
    stand_off(view.camera, centre, heading_deg, pitch_deg, far_m);
    return {};
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
