// Whether a box of 3D Tiles holds every point of triangles, and is no deeper than they are; by sampling.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "core/earth/ellipsoid.h"

namespace oro::test {

// boundingVolume.region: west, south, east, north in radians, lowest and highest h in metres.
using BoxRegion = std::array<double, 6>;

inline bool is_in_region(const BoxRegion& region, const glm::dvec3& at_m) {
    const auto& [west, south, east, north, lowest_m, highest_m] = region;
    const Geodetic at = geodetic_from_ecef({at_m});
    const double lat = radians_from_deg(at.lat_deg).rad, lon = radians_from_deg(at.lon_deg).rad;
    const bool is_whole_turn = west == -std::numbers::pi && east == std::numbers::pi;
    const bool is_between = west <= east ? lon >= west && lon <= east : lon >= west || lon <= east;
    return (is_whole_turn || is_between) && lat >= south && lat <= north && at.h_m >= lowest_m &&
           at.h_m <= highest_m;
}

// Points of a triangle, so many along each side, that are outside of a region.
inline int points_outside(const BoxRegion& region, const std::array<glm::dvec3, 3>& corners_m, int points) {
    int outside = 0;
    for (int i = 0; i <= points; ++i)
        for (int j = 0; i + j <= points; ++j) {
            const double a = static_cast<double>(i) / points, b = static_cast<double>(j) / points;
            const glm::dvec3 at_m = a * corners_m[0] + b * corners_m[1] + (1.0 - a - b) * corners_m[2];
            outside += is_in_region(region, at_m) ? 0 : 1;
        }
    return outside;
}

// How far the middle of a triangle's smallest enclosing circle lies below a sphere through its corners, whose
// radius is the smallest radius of curvature of the ellipsoid, 6,335,439 m (Torge & Mueller, Geodesy, 4.13,
// at the equator), and the height of the lowest corner. Of a triangle with an obtuse angle this is the
// sagitta of its longest side.
inline double sagitta_m(const std::array<glm::dvec3, 3>& corners_m, double lowest_h_m) {
    constexpr double meridian_at_equator_m = 6335439.0;
    const double a = glm::distance(corners_m[1], corners_m[2]), b = glm::distance(corners_m[2], corners_m[0]),
                 c = glm::distance(corners_m[0], corners_m[1]);
    const auto is_obtuse = [](double side, double one, double other) {
        return side * side >= one * one + other * other;
    };
    double of_circle_m = a * b * c /
                         std::sqrt((a + b + c) * std::max(1e-300, b + c - a) * std::max(1e-300, c + a - b) *
                                   std::max(1e-300, a + b - c));
    if (is_obtuse(a, b, c) || is_obtuse(b, c, a) || is_obtuse(c, a, b))
        of_circle_m = 0.5 * std::max({a, b, c});
    const double sphere_m = meridian_at_equator_m + lowest_h_m;
    return sphere_m - std::sqrt(sphere_m * sphere_m - of_circle_m * of_circle_m);
}

}  // namespace oro::test
