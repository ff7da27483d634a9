// Where straight lines meet boxes and triangles.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

namespace oro {

// One over a line's direction, finite: for box_begin_m().
inline glm::dvec3 finite_inverse(const glm::dvec3& direction) {
    glm::dvec3 inverse;
    for (int axis = 0; axis < 3; ++axis) {
        // Along a box's side: farther away than any reach, or never left.
        constexpr double least = 1.0e-200;
        inverse[axis] = 1.0 / (std::abs(direction[axis]) < least ? least : direction[axis]);
    }
    return inverse;
}

// How far along a line a box begins, or infinity: it is not met nearer than reach_m. inverse: of the line's
// direction, finite.
inline double box_begin_m(const glm::dvec3& start, const glm::dvec3& inverse, const glm::dvec3& low,
                          const glm::dvec3& high, double reach_m) {
    const glm::dvec3 one_m = (low - start) * inverse, other_m = (high - start) * inverse;
    const glm::dvec3 from_m = glm::min(one_m, other_m), to_m = glm::max(one_m, other_m);
    const double begin_m = std::max(std::max(from_m.x, from_m.y), std::max(from_m.z, 0.0));
    const double end_m = std::min(std::min(to_m.x, to_m.y), std::min(to_m.z, reach_m));
    return begin_m <= end_m ? begin_m : std::numeric_limits<double>::infinity();
}

// How far along a line through `start` a triangle is, before its start, too; nothing where it passes beside
// it. A line through a common side of two triangles meets one of them at least.
// Source: T. Möller, B. Trumbore, Fast, Minimum Storage Ray/Triangle Intersection, 1997, eq. 6; a share may
// be below 0 by rounding.
inline std::optional<double> triangle_along_m(const std::array<glm::dvec3, 3>& triangle,
                                              const glm::dvec3& start, const glm::dvec3& direction) {
    const glm::dvec3 one = triangle[1] - triangle[0], other = triangle[2] - triangle[0];
    const glm::dvec3 across = glm::cross(direction, other);
    const double determinant = glm::dot(one, across);
    if (determinant == 0.0) return std::nullopt;
    constexpr double rounded = 1.0e-9;
    const glm::dvec3 to_start = start - triangle[0];
    const double share_1 = glm::dot(to_start, across) / determinant;
    if (share_1 < -rounded || share_1 > 1.0 + 2.0 * rounded) return std::nullopt;
    const glm::dvec3 around = glm::cross(to_start, one);
    const double share_2 = glm::dot(direction, around) / determinant;
    if (share_2 < -rounded || share_1 + share_2 > 1.0 + rounded) return std::nullopt;
    return glm::dot(other, around) / determinant;
}

}  // namespace oro
