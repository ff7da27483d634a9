#include "apps/navigation/zoom.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "apps/navigation/flight_step.h"

namespace oro {
namespace {

Holding at_distance(const Camera& camera, const Ecef& place, glm::dvec2 point_px, double distance_m,
                    const GroundHeightAt& ground_h_m, const Air& air) {
    const glm::dvec3 towards_eye = glm::normalize(camera.eye_ecef().m - place.m);
    const Camera on_line = carried_to(camera, geodetic_from_ecef({place.m + towards_eye * distance_m}));
    const Camera there = above_ground(on_line, ground_h_m);
    Holding holding = turned_to_hold(there, seen_direction(there, place, air), point_px);
    if (holding.exact || holding.camera.attitude.pitch_deg > -90.0) return holding;
    // Straight down: what cannot be turned is moved.
    holding = moved_to_hold(holding.camera, place, point_px, air);
    const Camera lifted = above_ground(holding.camera, ground_h_m);
    holding.exact = holding.exact && lifted.eye.h_m == holding.camera.eye.h_m;
    return holding;
}

}  // namespace

Camera zoomed(const Camera& camera, const Ecef& place, double factor, const GroundHeightAt& ground_h_m,
              const Air& air) {
    const auto point_px = pixel_of(camera, place, air);
    const double now_m = glm::distance(camera.eye_ecef().m, place.m);
    if (!point_px || !(factor > 0.0) || now_m == 0.0) return camera;
    const double asked_m =
        std::clamp(factor * now_m, std::min(least_zoom_m, now_m), std::max(most_zoom_m, now_m));
    double share = asked_m / now_m;
    constexpr int most_trials = 12;
    for (int i = 0; i < most_trials && share != 1.0; ++i, share = std::sqrt(share)) {
        const Holding holding = at_distance(camera, place, *point_px, share * now_m, ground_h_m, air);
        if (holding.exact) return holding.camera;
    }
    return camera;
}

}  // namespace oro
