// Turns by angles in degrees.
#pragma once

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "core/earth/ellipsoid.h"

namespace oro {

// An angle in degrees turned into [0, 360), exact: whole turns are taken away, and one in it already keeps
// its last digit.
inline double turned_to_circle_deg(double angle_deg) {
    const double turned = std::fmod(angle_deg, 360.0);
    const double positive = turned < 0.0 ? turned + 360.0 : turned;
    return positive >= 360.0 ? 0.0 : positive;
}

// The unit quaternion that turns by an angle in degrees about a unit axis, anticlockwise where the axis
// points at who looks. Error: that of sine_cosine_deg().
inline glm::dquat rotation_about(double angle_deg, const glm::dvec3& unit_axis) {
    const SineCosine half = sine_cosine_deg(0.5 * angle_deg);
    return {half.cosine, half.sine * unit_axis.x, half.sine * unit_axis.y, half.sine * unit_axis.z};
}

}  // namespace oro
