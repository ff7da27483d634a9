#include "core/measure/drawn_point.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace oro {
namespace {

using Corners = std::array<glm::dvec3, 3>;
using Shares = std::array<double, 3>;

// The point of a triangle's rim that lies nearest to a ray from the origin.
Shares nearest_on_rim(const Corners& at, const glm::dvec3& ray) {
    const glm::dvec3 along = glm::normalize(ray);
    const auto across = [&](const glm::dvec3& v) { return v - glm::dot(v, along) * along; };
    Shares nearest{1.0, 0.0, 0.0};
    double nearest_m = -1.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const glm::dvec3 from = across(at[i]), edge = across(at[j]) - from;
        const double length = glm::dot(edge, edge);
        const double share = length > 0.0 ? std::clamp(-glm::dot(from, edge) / length, 0.0, 1.0) : 0.0;
        const double away_m = glm::length(from + share * edge);
        if (nearest_m >= 0.0 && away_m >= nearest_m) continue;
        nearest_m = away_m;
        nearest = {0.0, 0.0, 0.0};
        nearest[i] = 1.0 - share;
        nearest[j] = share;
    }
    return nearest;
}

Shares shares_at(const Corners& at, const glm::dvec3& ray) {
    // Source: T. Möller, B. Trumbore, Fast, minimum storage ray/triangle intersection, J. Graphics Tools
    // 2(1), 1997.
    const glm::dvec3 b = at[1] - at[0], c = at[2] - at[0], p = glm::cross(ray, c);
    const double determinant = glm::dot(b, p);
    if (determinant != 0.0) {
        const double share_b = glm::dot(-at[0], p) / determinant;
        const double share_c = glm::dot(ray, glm::cross(-at[0], b)) / determinant;
        if (share_b >= 0.0 && share_c >= 0.0 && share_b + share_c <= 1.0)
            return {1.0 - share_b - share_c, share_b, share_c};
    }
    return nearest_on_rim(at, ray);
}

}  // namespace

DrawnPoint drawn_point(const gpu::DrawnTriangle& triangle, const glm::dvec3& ray_view) {
    if (triangle.rows[0] == gpu::no_triangle) return {};
    const Corners at{triangle.at[0], triangle.at[1], triangle.at[2]};
    const Shares shares = shares_at(at, ray_view);
    DrawnPoint point;
    for (std::size_t i = 0; i < 3; ++i) {
        point.row += shares[i] * triangle.rows[i];
        point.column += shares[i] * triangle.columns[i];
        point.z_m -= shares[i] * at[i].z;
        point.h_m += shares[i] * triangle.h_m[i];
    }
    return point;
}

DrawnPoint drawn_point(const ShownTriangle& shown, const glm::dvec3& ray_view) {
    DrawnPoint point = drawn_point(shown.triangle, ray_view);
    point.grid = shown.grid;
    return point;
}

}  // namespace oro
