#include "core/clusters/group_bounds.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// Above the rounding of places and distances.
constexpr double growth = 1.0 + 1.0e-9;
constexpr double rounding_m = 1.0e-6;
constexpr int sphere_steps = 24;

struct Sphere {
    glm::dvec3 centre_m;
    double radius_m;
};

// How far the farthest place of some spheres is from another, and where it is.
struct Farthest {
    double distance_m{-1.0};
    glm::dvec3 place_m{0.0};
};
Farthest farthest_from(const glm::dvec3& from_m, std::span<const Sphere> spheres) {
    Farthest farthest;
    for (const Sphere& sphere : spheres) {
        const double apart_m = glm::distance(from_m, sphere.centre_m);
        if (apart_m + sphere.radius_m <= farthest.distance_m) continue;
        const double beyond = apart_m > 0.0 ? sphere.radius_m / apart_m : 0.0;
        farthest = {apart_m + sphere.radius_m, sphere.centre_m + beyond * (sphere.centre_m - from_m)};
    }
    return farthest;
}

// A sphere around all of them, and nearly the smallest: from the middle of the box that holds them, its
// centre goes towards what is farthest, by smaller and smaller steps. Source: M. Badoiu, K. Clarkson, Smaller
// core-sets for balls, SODA 2003.
Sphere around(std::span<const Sphere> spheres) {
    glm::dvec3 lowest = spheres.front().centre_m, highest = lowest;
    for (const Sphere& sphere : spheres) {
        lowest = glm::min(lowest, sphere.centre_m - sphere.radius_m);
        highest = glm::max(highest, sphere.centre_m + sphere.radius_m);
    }
    glm::dvec3 centre_m = 0.5 * (lowest + highest);
    Sphere best{centre_m, OriginalSurface::no_limit};
    for (int step = 1; step <= sphere_steps; ++step) {
        const Farthest farthest = farthest_from(centre_m, spheres);
        if (farthest.distance_m < best.radius_m) best = {centre_m, farthest.distance_m};
        centre_m += (farthest.place_m - centre_m) / (step + 1.0);
    }
    best.radius_m = best.radius_m * growth + rounding_m;
    return best;
}

// A box in the plane and in height.
struct Box {
    SurfaceVertex lowest;  // row, column and height, each by itself
    SurfaceVertex highest;

    void widen(const SurfaceVertex& vertex) {
        lowest = {std::min(lowest.row, vertex.row), std::min(lowest.column, vertex.column),
                  std::min(lowest.steps, vertex.steps)};
        highest = {std::max(highest.row, vertex.row), std::max(highest.column, vertex.column),
                   std::max(highest.steps, vertex.steps)};
    }
    [[nodiscard]] GroundExtent extent() const {
        return {lowest.row, highest.row, highest.column - lowest.column,
                height_step_m * (static_cast<double>(highest.steps) - lowest.steps)};
    }
};

double flat_m(const OriginalSurface& surface, const GroundBounds& ground,
              std::span<const VertexTriangle> made, double difference) {
    const SurfaceVertex first = surface.vertex(made.front()[0]);
    Box group{first, first};
    GroundExtent largest;
    for (const VertexTriangle& triangle : made) {
        const SurfaceVertex corner = surface.vertex(triangle[0]);
        Box box{corner, corner};
        for (const VertexNumber number : triangle) box.widen(surface.vertex(number));
        group.widen(box.lowest);
        group.widen(box.highest);
        const GroundExtent extent = box.extent();
        largest.last_row = std::max(largest.last_row, extent.last_row - extent.first_row);
        largest.columns = std::max(largest.columns, extent.columns);
        largest.rise_m = std::max(largest.rise_m, extent.rise_m);
    }
    // The original may be that much lower and higher.
    GroundExtent extent = group.extent();
    extent.rise_m += 2.0 * difference * height_step_m;
    return ground.flat_m(largest, extent);
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
