// What a picture shows of triangles, by asking each of them: for tests of what is drawn.
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <vector>

#include "core/earth/camera.h"

namespace oro::test {

// Corners in metres from the eye, along the axes of ECEF.
struct NearTriangle {
    glm::dvec3 a, b, c;
};
// Distance along a ray from the origin, or infinity. Source: T. Möller, B. Trumbore, Fast, minimum storage
// ray/triangle intersection, J. Graphics Tools 2(1), 1997.
inline double hit_m(const NearTriangle& triangle, const glm::dvec3& ray) {
    const glm::dvec3 ab = triangle.b - triangle.a, ac = triangle.c - triangle.a, p = glm::cross(ray, ac);
    const double determinant = glm::dot(ab, p);
    const double u = glm::dot(-triangle.a, p) / determinant;
    if (!(u >= 0.0 && u <= 1.0)) return std::numeric_limits<double>::infinity();
    const glm::dvec3 q = glm::cross(-triangle.a, ab);
    const double v = glm::dot(ray, q) / determinant;
    const double t = glm::dot(ac, q) / determinant;
    return v >= 0.0 && u + v <= 1.0 && t > 0.0 ? t : std::numeric_limits<double>::infinity();
}

// Those that rays from the origin in the plane of two of them may meet: not those wholly on one side of it,
// by more than is rounded off.
inline std::vector<NearTriangle> crossed_by_plane(const std::vector<NearTriangle>& all, const glm::dvec3& one,
                                                  const glm::dvec3& other) {
    constexpr double rounding_m = 1.0e-6;
    const glm::dvec3 normal = glm::normalize(glm::cross(one, other));
    std::vector<NearTriangle> crossed;
    for (const NearTriangle& triangle : all) {
        const double a_m = glm::dot(normal, triangle.a), b_m = glm::dot(normal, triangle.b),
                     c_m = glm::dot(normal, triangle.c);
        if (std::min({a_m, b_m, c_m}) <= rounding_m && std::max({a_m, b_m, c_m}) >= -rounding_m)
            crossed.push_back(triangle);
    }
    return crossed;
}

// Distance along each pixel's ray, in metres of depth, to the nearest triangle, or infinity; row by row.
inline std::vector<double> nearest_triangles_m(const std::vector<NearTriangle>& all, const Camera& camera) {
    const glm::dmat3 ecef_from_view = glm::transpose(camera.view_from_ecef());
    const Projection projection =
        projection_of_tile(camera, {0, 0, camera.width_px, camera.height_px, {0.5, 0.5}});
    const auto ray_of = [&](int x, int y) {
        const glm::dvec2 clip =
            (glm::dvec2(x, y) + 0.5) * 2.0 / glm::dvec2(camera.width_px, camera.height_px) - 1.0;
        return ecef_from_view *
               glm::dvec3((clip - glm::dvec2(projection.shift)) / glm::dvec2(projection.scale), -1.0);
    };
    std::vector<double> nearest_m;
    for (int y = 0; y < camera.height_px; ++y) {
        const std::vector<NearTriangle> of_row =
            crossed_by_plane(all, ray_of(0, y), ray_of(camera.width_px - 1, y));
        for (int x = 0; x < camera.width_px; ++x) {
            const glm::dvec3 ray = ray_of(x, y);
            double m = std::numeric_limits<double>::infinity();
            for (const NearTriangle& triangle : of_row) m = std::min(m, hit_m(triangle, ray));
            nearest_m.push_back(m);
        }
    }
    return nearest_m;
}

}  // namespace oro::test
