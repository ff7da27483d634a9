#include "core/earth/framing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace oro {

Attitude attitude_of_axes(const Geodetic& place, const glm::dvec3& forward_ecef,
                          const glm::dvec3& right_ecef) {
    Attitude attitude = attitude_of_direction(place, forward_ecef);
    Camera level;
    level.eye = place;
    level.attitude = attitude;
    const glm::dvec3 view = level.view_from_ecef() * right_ecef;
    attitude.roll_deg = deg_from_radians(Radians{std::atan2(-view.y, view.x)});
    return attitude;
}

// A point p is within reach t of the middle of the picture where |p.x - eye.x| <= t (eye.z - p.z): four
// planes a point, all of four directions. Of each direction only the farthest plane counts, and two opposite
// ones meet where both of their points touch.
Ecef eye_that_frames(const Camera& camera, const glm::dmat3& view_from_ecef, std::span<const Ecef> points,
                     double margin, double nearest_m) {
    const glm::dvec2 reach = camera.half_fov_tangent() * (1.0 - 2.0 * margin);
    const glm::dvec3 origin = points.front().m;
    constexpr double lowest = -std::numeric_limits<double>::max();
    glm::dvec2 right_top(lowest), left_bottom(lowest);
    double nearest = lowest;
    for (const Ecef& point : points) {
        const glm::dvec3 at = view_from_ecef * (point.m - origin);
        const glm::dvec2 across(at);
        right_top = glm::max(right_top, across + reach * at.z);
        left_bottom = glm::max(left_bottom, reach * at.z - across);
        nearest = std::max(nearest, at.z);
    }
    const glm::dvec2 meet = (right_top + left_bottom) / (2.0 * reach);
    const glm::dvec3 eye(0.5 * (right_top - left_bottom), std::max({meet.x, meet.y, nearest + nearest_m}));
    return {origin + glm::transpose(view_from_ecef) * eye};
}

}  // namespace oro
