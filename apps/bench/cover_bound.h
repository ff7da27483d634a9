// How far some triangles are from others: a bound.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "core/mesh_graph/nearest_triangles.h"

namespace oro {

using TriangleCorners = std::array<glm::dvec3, 3>;

[[nodiscard]] std::vector<TriangleCorners> corners_of(
    std::span<const glm::dvec3> vertices, std::span<const std::array<std::uint32_t, 3>> triangles);

// The largest distance of any place of triangles from a set is no larger than this. Below accepted_m it need
// not be known, and above enough_m it may be more.
[[nodiscard]] double cover_bound_m(std::span<const TriangleCorners> triangles, const NearestTriangles& set,
                                   double accepted_m, double enough_m);

}  // namespace oro
