// Which place of a triangle is nearest to a point. Within core.
#pragma once

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace oro {

inline glm::dvec3 nearest_place_on_side(const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& at) {
    const glm::dvec3 along = to - from;
    const double length2 = glm::dot(along, along);
    if (length2 == 0.0) return from;
    return from + std::clamp(glm::dot(at - from, along) / length2, 0.0, 1.0) * along;
}

// Below the point, where that is inside; else on the nearest of its sides, and so of one without an area.
inline glm::dvec3 nearest_place(const std::array<glm::dvec3, 3>& triangle, const glm::dvec3& at) {
    const auto& [a, b, c] = triangle;
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    if (const double length2 = glm::dot(normal, normal); length2 > 0.0) {
        const glm::dvec3 foot = at - glm::dot(at - a, normal) / length2 * normal;
        const auto is_inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
            return glm::dot(glm::cross(to - from, foot - from), normal) >= 0.0;
        };
        if (is_inside(a, b) && is_inside(b, c) && is_inside(c, a)) return foot;
    }
    glm::dvec3 nearest = nearest_place_on_side(a, b, at);
    for (const auto& [from, to] : {std::array{b, c}, std::array{c, a}}) {
        const glm::dvec3 place = nearest_place_on_side(from, to, at);
        if (glm::distance(place, at) < glm::distance(nearest, at)) nearest = place;
    }
    return nearest;
}

// How far a point is from a box; 0 inside.
inline double box_away_m(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& at) {
    return glm::length(glm::max(glm::max(low - at, at - high), glm::dvec3(0.0)));
}

}  // namespace oro
