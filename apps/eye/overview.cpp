#include "apps/eye/overview.h"

#include <algorithm>
#include <cstdio>

#include "apps/command_line/refusals.h"
#include "apps/eye/ground_points.h"
#include "apps/view/view_limits.h"
#include "core/earth/place_framing.h"

namespace oro {

double overview_pitch_deg(double radius_m) {
    constexpr double small_m = 1e5, large_m = 1.5e6, oblique_deg = 40.0, steep_deg = 89.9;
    const double share = std::clamp((radius_m - small_m) / (large_m - small_m), 0.0, 1.0);
    return -(oblique_deg + (steep_deg - oblique_deg) * share);
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
