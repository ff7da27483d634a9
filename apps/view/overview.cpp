#include "apps/view/overview.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>

#include "apps/command_line/refusals.h"
#include "apps/eye/ground_points.h"
#include "apps/options/view_limits.h"
#include "core/earth/place_framing.h"
#include "core/terrain/drawn_heights.h"
#include "geo/together/cut_regions.h"

namespace oro {

double overview_pitch_deg(double radius_m) {
    constexpr double small_m = 1e5, large_m = 1.5e6, oblique_deg = 40.0, steep_deg = 89.9;
    const double share = std::clamp((radius_m - small_m) / (large_m - small_m), 0.0, 1.0);
    return -(oblique_deg + (steep_deg - oblique_deg) * share);
}

namespace {

// Whether a camera's picture shows a point.
bool is_in_frame(const Camera& camera, const glm::dmat3& view_from_ecef, const glm::dvec3& eye_m,
                 const Ecef& point) {
    const glm::dvec3 seen = view_from_ecef * (point.m - eye_m);
    const glm::dvec2 tangent = camera.half_fov_tangent();
    return seen.z < 0.0 && std::abs(seen.x) <= -seen.z * tangent.x && std::abs(seen.y) <= -seen.z * tangent.y;
}

// Few posts that tell most pictures of a place from one of all at once.
std::vector<Ecef> corner_points(const HeightField& field, double exaggeration) {
    std::vector<Ecef> points;
    const int last_row = field.grid.rows() - 1, last_column = field.grid.columns() - 1;
    for (const int row : {0, last_row})
        for (const int column : {0, last_column})
            if (!is_void(field.H_at_post_m(row, column)))
                points.push_back(post_ecef(field, row, column, exaggeration));
    return points;
}

}  // namespace

bool is_whole_in_view(const View& view, const Region& region) {
    if (view.map || view.panorama) return false;
    const Camera& camera = view.camera;
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const glm::dvec3 eye_m = ecef_from_geodetic(camera.eye).m;
    const auto shows = [&](const std::vector<Ecef>& points) {
        return std::ranges::all_of(
            points, [&](const Ecef& point) { return is_in_frame(camera, view_from_ecef, eye_m, point); });
    };
    for (const RegionGrid& grid : region.grids)
        if (!shows(corner_points(grid.field, view.exaggeration))) return false;
    const std::vector<Ecef> rim = rim_points(region, view.exaggeration);
    return !rim.empty() && shows(rim);
}

Result<void> see_whole_region(View& view, const ViewOptions& options, const Region& region) {
    const GroundPoints ground = ground_points(region, view.exaggeration);
    if (ground.all.empty()) return Error{ErrorKind::no_data, "region", "every post is void"};
    if (!options.vertical_fov_deg) view.camera.vertical_fov_deg = overview_fov_deg;
    view.camera = camera_on_points(
        view.camera, ground.middle, ground.radius_m,
        {options.heading_deg.value_or(0.0), options.pitch_deg.value_or(overview_pitch_deg(ground.radius_m))},
        ground.all, overview_margin);
    const double h_m = view.camera.eye.h_m;
    if (view_limits::eye_h_m.hold(h_m)) return {};
    char text[120];
    std::snprintf(text, sizeof text, "the whole region would be seen from h %g m, not between %g and %g", h_m,
                  view_limits::eye_h_m.low, view_limits::eye_h_m.high);
    char fov[40];
    std::snprintf(fov, sizeof fov, "%.15g", view.camera.vertical_fov_deg);
    return refused("--fov", fov, text);
}

}  // namespace oro
