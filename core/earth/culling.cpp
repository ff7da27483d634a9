#include "core/earth/culling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace oro {
namespace gpu {
namespace {
using glm::dot;
using std::abs;
#define ORO_FUNCTION inline
#include "shaders/choose/select.glsl"
#undef ORO_FUNCTION
}  // namespace

bool sphere_beyond_plane_cpu(const vec3& centre, float radius, const vec4& plane) {
    return sphere_beyond_plane(centre, radius, plane);
}
bool beyond_horizon_cpu(const vec3& eye_offset, float eye_angle_rad, float horizon_angle_rad) {
    return beyond_horizon(eye_offset, eye_angle_rad, horizon_angle_rad);
}
}  // namespace gpu

namespace {

// Angles are tested with this much to spare: above the rounding of doubles, 60 um of ground.
constexpr double angle_slack_rad = 1.0e-11;

// acos(1 / r), exact also for r just above 1, and 0 below it.
double horizon_angle_rad(double r) {
    return r > 1.0 ? std::atan(std::sqrt((r - 1.0) * (r + 1.0))) : 0.0;
}

// Exact also for directions that are almost the same.
double angle_between_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

HorizonOccluder occluder_below(double lowest_h_m, double cell_diagonal_m) {
    // The smallest radius of curvature: the meridian's at the equator. A cell's triangles are nearly
    // right-angled, so their deepest place is near the diagonal's middle; a tenth more covers those that are
    // not, near the poles of coarse grids.
    const double smallest_radius_m = wgs84_b_m * wgs84_b_m / wgs84_a_m;
    const double sag_m = 1.1 * cell_diagonal_m * cell_diagonal_m / (8.0 * smallest_radius_m);
    // Shorter axes do not give the surface at one depth: it lies up to depth * f^2 / 2 above that.
    const double depth_m = (std::max(0.0, -lowest_h_m) + sag_m) * (1.0 + 1.0e-5) + 0.01;
    return {glm::dvec3(wgs84_a_m - depth_m, wgs84_a_m - depth_m, wgs84_b_m - depth_m)};
}

HorizonPoint horizon_point(const glm::dvec3& scaled) {
    const double r = std::sqrt(glm::dot(scaled, scaled));
    return {scaled, r > 1.0 ? std::sqrt((r - 1.0) * (r + 1.0)) : 0.0, 1.0 / (r * std::max(1.0, r))};
}

HorizonCone horizon_cone(std::span<const HorizonPoint> points) {
    HorizonCone cone;
    glm::dvec3 sum(0.0);
    for (const HorizonPoint& point : points) sum += point.position;
    const double length = glm::length(sum);
    if (!(length > 1.0e-9 * static_cast<double>(points.size()))) {
        cone.angle_rad = std::numbers::pi;  // all round the Earth
        return cone;
    }
    cone.direction = sum / length;
    // Sine and cosine of a point's angle acos(1 / r) + angle(point, direction), without a call to either. Up
    // to a quarter turn the sines have the order of the angles, so one arc is enough; beyond it (a region as
    // wide as a continent) each point is asked.
    double largest_sine = 0.0;
    double its_cosine = 1.0;
    double smallest_cosine = 1.0;
    for (const HorizonPoint& point : points) {
        const double along = glm::dot(point.position, cone.direction);
        const glm::dvec3 across_point = glm::cross(point.position, cone.direction);
        const double across = std::sqrt(glm::dot(across_point, across_point));
        const double sine = (point.tangent * along + across) * point.scale;
        const double cosine = (along - point.tangent * across) * point.scale;
        its_cosine = sine > largest_sine ? cosine : its_cosine;
        largest_sine = std::max(largest_sine, sine);
        smallest_cosine = std::min(smallest_cosine, cosine);
    }
    if (smallest_cosine > 0.0) {
        cone.angle_rad = std::atan2(largest_sine, its_cosine);
        return cone;
    }
    for (const HorizonPoint& point : points) {
        cone.angle_rad = std::max(cone.angle_rad, horizon_angle_rad(glm::length(point.position)) +
                                                      angle_between_rad(point.position, cone.direction));
    }
    return cone;
}

HorizonCone horizon_cone(const HorizonOccluder& occluder, std::span<const glm::dvec3> points_ecef_m) {
    std::vector<HorizonPoint> points;
    points.reserve(points_ecef_m.size());
    for (const glm::dvec3& point : points_ecef_m)
        points.push_back(horizon_point(occluder.scaled(Ecef{point})));
    return horizon_cone(points);
}

HorizonEye horizon_eye(const HorizonOccluder& occluder, const Ecef& eye) {
    const glm::dvec3 scaled = occluder.scaled(eye);
    const double distance = glm::length(scaled);
    if (!(distance > 1.0)) {
        return {distance > 0.0 ? scaled / distance : glm::dvec3(0.0, 0.0, 1.0), std::numbers::pi};
    }
    return {scaled / distance, horizon_angle_rad(distance)};
}

bool beyond_horizon(const HorizonEye& eye, const HorizonCone& cone) {
    const double reach_rad = eye.angle_rad + cone.angle_rad + angle_slack_rad;
    if (!(reach_rad < std::numbers::pi)) return false;
    // Most answers are far from the limit. An angle is at least its chord c, and up to c = 1 at most
    // c + c^3 / 20; the slack is more than directions that were rounded make of it.
    constexpr double chord_slack = 1.0e-5;
    const glm::dvec3 apart = eye.direction - cone.direction;
    const double chord = std::sqrt(glm::dot(apart, apart));
    const bool are_units = std::abs(glm::dot(cone.direction, cone.direction) - 1.0) < chord_slack / 10.0;
    if (!are_units) return angle_between_rad(eye.direction, cone.direction) > reach_rad;
    if (chord <= 1.0 && chord * (1.0 + chord * chord / 20.0) < reach_rad - chord_slack) return false;
    if (chord > reach_rad + chord_slack) return true;
    return angle_between_rad(eye.direction, cone.direction) > reach_rad;
}

bool beyond_frustum(std::span<const Plane> planes, const glm::dvec3& centre_m, double radius_m) {
    return std::any_of(planes.begin(), planes.end(), [&](const Plane& plane) {
        return glm::dot(glm::dvec3(plane), centre_m) + plane.w < -radius_m;
    });
}

}  // namespace oro
