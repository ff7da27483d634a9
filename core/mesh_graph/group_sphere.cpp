#include "core/mesh_graph/group_sphere.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace oro {

void set_sphere(const ClusterGraph& graph, std::span<const VertexTriangle> triangles,
                std::span<const glm::dvec3> vertices, const glm::dvec3& origin_ecef_m, ClusterGroup& group) {
    const auto triangles_of = [&](const Cluster& cluster) {
        return triangles.subspan(cluster.first_triangle, cluster.triangles);
    };
    constexpr double endless = std::numeric_limits<double>::infinity();
    glm::dvec3 low(endless), high(-endless);
    std::vector<std::uint32_t> below;
    for (const std::uint32_t member : graph.members_of(group)) {
        const Cluster& cluster = graph.clusters[member];
        for (const VertexTriangle& triangle : triangles_of(cluster))
            for (const std::uint32_t corner : triangle)
                low = glm::min(low, vertices[corner]), high = glm::max(high, vertices[corner]);
        if (cluster.made_by != no_group && (below.empty() || below.back() != cluster.made_by))
            below.push_back(cluster.made_by);
    }
    for (const std::uint32_t one : below) {
        const ClusterGroup& other = graph.groups[one];
        low = glm::min(low, other.centre.m - origin_ecef_m - other.radius_m);
        high = glm::max(high, other.centre.m - origin_ecef_m + other.radius_m);
    }
    const glm::dvec3 middle = 0.5 * (low + high);
    double radius = 0.0;
    for (const std::uint32_t member : graph.members_of(group))
        for (const VertexTriangle& triangle : triangles_of(graph.clusters[member]))
            for (const std::uint32_t corner : triangle)
                radius = std::max(radius, glm::distance(middle, vertices[corner]));
    group.centre = Ecef{origin_ecef_m + middle};
    for (const std::uint32_t one : below) {
        const ClusterGroup& other = graph.groups[one];
        radius = std::max(radius, glm::distance(group.centre.m, other.centre.m) + other.radius_m);
    }
    // Of places as far from the Earth's middle as it is wide, double rounds 1 nm.
    group.radius_m = radius + 1.0e-6;
}

}  // namespace oro
