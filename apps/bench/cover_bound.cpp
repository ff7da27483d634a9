#include "apps/bench/cover_bound.h"

#include <algorithm>

#include "core/mesh_graph/distance_cover.h"

namespace oro {

std::vector<TriangleCorners> corners_of(std::span<const glm::dvec3> vertices,
                                        std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::vector<TriangleCorners> corners;
    corners.reserve(triangles.size());
    for (const auto& [a, b, c] : triangles) corners.push_back({vertices[a], vertices[b], vertices[c]});
    return corners;
}

double cover_bound_m(std::span<const TriangleCorners> triangles, const NearestTriangles& set,
                     double accepted_m, double enough_m) {
    DistanceCover cover(set, accepted_m);
    for (const TriangleCorners& corners : triangles) {
        OriginalPart polygon;
        std::copy(corners.begin(), corners.end(), polygon.corners.begin());
        polygon.count = 3;
        cover.cover(polygon);
        if (cover.bound_m() > enough_m) break;
    }
    return cover.bound_m();
}

}  // namespace oro
