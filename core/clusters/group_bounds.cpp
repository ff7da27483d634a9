#include "core/clusters/group_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// Above the rounding of places and distances.
constexpr double growth = 1.0 + 1.0e-9;
constexpr double rounding_m = 1.0e-6;

struct Sphere {
    glm::dvec3 centre_m;
    double radius_m;
};

// Around the middle of the box that holds them all.
Sphere around(std::span<const Sphere> spheres) {
    glm::dvec3 lowest = spheres.front().centre_m, highest = lowest;
    for (const Sphere& sphere : spheres) {
        lowest = glm::min(lowest, sphere.centre_m - sphere.radius_m);
        highest = glm::max(highest, sphere.centre_m + sphere.radius_m);
    }
    Sphere all{0.5 * (lowest + highest), 0.0};
    for (const Sphere& sphere : spheres)
        all.radius_m = std::max(all.radius_m, glm::distance(all.centre_m, sphere.centre_m) + sphere.radius_m);
    all.radius_m = all.radius_m * growth + rounding_m;
    return all;
}

void widen(VertexRange& range, const SurfaceVertex& vertex) {
    range.lowest = {std::min(range.lowest.row, vertex.row), std::min(range.lowest.column, vertex.column),
                    std::min(range.lowest.steps, vertex.steps)};
    range.highest = {std::max(range.highest.row, vertex.row), std::max(range.highest.column, vertex.column),
                     std::max(range.highest.steps, vertex.steps)};
}

double flat_m(const OriginalSurface& surface, const GroundBounds& ground,
              std::span<const VertexTriangle> made, double difference) {
    const SurfaceVertex first = surface.vertex(made.front()[0]);
    VertexRange group{first, first};
    VertexRange largest{};  // of triangles, from 0 on
    for (const VertexTriangle& triangle : made) {
        const SurfaceVertex corner = surface.vertex(triangle[0]);
        VertexRange range{corner, corner};
        for (const VertexNumber number : triangle) widen(range, surface.vertex(number));
        widen(group, range.lowest);
        widen(group, range.highest);
        largest.highest.row = std::max(largest.highest.row, range.highest.row - range.lowest.row);
        largest.highest.column = std::max(largest.highest.column, range.highest.column - range.lowest.column);
        largest.highest.steps = std::max(largest.highest.steps, range.highest.steps - range.lowest.steps);
    }
    // The original may be that much lower and higher.
    const auto beyond = static_cast<std::int32_t>(std::ceil(difference));
    group.lowest.steps -= beyond;
    group.highest.steps += beyond;
    return ground.flat_m(largest, group);
}

}  // namespace

GroupBounds group_bounds(const OriginalSurface& surface, const GroundBounds& ground,
                         const ClusterGraph& graph, std::uint32_t group, std::span<const VertexTriangle> made,
                         double difference) {
    double error_m = 0.0;
    std::vector<Sphere> below;
    std::vector<VertexNumber> vertices;
    std::uint32_t last = no_group;
    for (const std::uint32_t member : graph.members_of(graph.groups[group])) {
        const Cluster& cluster = graph.clusters[member];
        if (cluster.made_by == no_group) {
            for (const VertexTriangle& triangle : graph.triangles_of(cluster))
                vertices.insert(vertices.end(), triangle.begin(), triangle.end());
        } else if (cluster.made_by != last) {
            const ClusterGroup& maker = graph.groups[cluster.made_by];
            last = cluster.made_by;
            error_m = std::max(error_m, maker.error_m);
            below.push_back({maker.centre.m, maker.radius_m});
        }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const VertexNumber number : vertices) below.push_back({ground.ecef(surface.vertex(number)).m, 0.0});
    const Sphere sphere = around(below);
    error_m = std::max(error_m, difference * height_step_m + flat_m(surface, ground, made, difference));
    return {error_m, {sphere.centre_m}, sphere.radius_m};
}

}  // namespace oro
