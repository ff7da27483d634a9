// What can be seen: horizon and frustum tests that may keep what is hidden and never drop what is visible.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

#include "core/earth/camera.h"
#include "core/earth/ellipsoid.h"
#include "shaders/shared.h"

namespace oro {

// The ellipsoid that hides things: WGS84 shrunk until no point of the drawn surface lies below it. Scaled
// space divides ECEF by its radii, so that it becomes the unit sphere.
struct HorizonOccluder {
    glm::dvec3 radii_m;

    [[nodiscard]] glm::dvec3 scaled(const Ecef& point) const { return point.m / radii_m; }
};
// lowest_h_m: the lowest height above the ellipsoid of any drawn post; cell_diagonal_m: the longest diagonal
// of any drawn cell, whose sag is taken off as well (right for cells up to 40 degrees wide). Heights above 0
// count as 0.
HorizonOccluder occluder_below(double lowest_h_m, double cell_diagonal_m);

// A cone around a unit direction of scaled space that tells when a set of points is hidden: when the eye's
// direction is farther from it than the eye's horizon angle plus angle_rad. Derivation: from an eye at
// distance d the sphere hides a point at distance r when the angle between them exceeds acos(1/d) +
// acos(1/r); the cone's angle is the largest acos(1/r) + angle(point, direction). Equal in effect to the
// horizon occlusion point of P. Cozzi, K. Ring, 3D Engine Design for Virtual Globes, 2011, section 12.4.
struct HorizonCone {
    glm::dvec3 direction{0.0, 0.0, 1.0};
    double angle_rad{};  // pi or more: never hidden
};
// Cone of points on or above the occluder (ECEF). Also good for the triangles between them: the hidden part
// of space is convex.
HorizonCone horizon_cone(const HorizonOccluder& occluder, std::span<const glm::dvec3> points_ecef_m);
// A point of scaled space, in any frame turned about the Earth's axis, with what it alone gives to every cone
// that it lies in.
struct HorizonPoint {
    glm::dvec3 position;
    double tangent;  // from it to the unit sphere; 0 for points below that
    double scale;    // one over its distance from the centre and the larger of that and 1
};
HorizonPoint horizon_point(const glm::dvec3& scaled);
// The cone as horizon_cone() above has it, in the points' frame.
HorizonCone horizon_cone(std::span<const HorizonPoint> points);

// The eye as horizon tests need it. angle_rad is pi (nothing hidden) for an eye below the occluder.
struct HorizonEye {
    glm::dvec3 direction;
    double angle_rad;
};
HorizonEye horizon_eye(const HorizonOccluder& occluder, const Ecef& eye);

// True when nothing in the cone can be seen (in double, for whole pages).
bool beyond_horizon(const HorizonEye& eye, const HorizonCone& cone);

// True when the sphere lies wholly beyond one of the planes. Same frame for all.
bool beyond_frustum(std::span<const Plane> planes, const glm::dvec3& centre_m, double radius_m);

// The GPU's own tests (shaders/choose/select.glsl) compiled for the CPU, in float.
namespace gpu {
bool sphere_beyond_plane_cpu(const vec3& centre, float radius, const vec4& plane);
bool beyond_horizon_cpu(const vec3& eye_offset, float eye_angle_rad, float horizon_angle_rad);
}  // namespace gpu

}  // namespace oro
