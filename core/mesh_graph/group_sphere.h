// The ball around what a group of a mesh's graph covers.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "core/clusters/cluster_graph.h"

namespace oro {

// Sets a group's sphere: a ball around the triangles that it uses, and around the balls of those groups that
// made them, whose spheres are set. vertices: of the mesh, metres from `origin`, ECEF. The same numbers give
// the same sphere, to the bit. triangles: those of the graph, which may lie elsewhere than in it.
void set_sphere(const ClusterGraph& graph, std::span<const VertexTriangle> triangles,
                std::span<const glm::dvec3> vertices, const glm::dvec3& origin_ecef_m, ClusterGroup& group);
inline void set_sphere(const ClusterGraph& graph, std::span<const glm::dvec3> vertices,
                       const glm::dvec3& origin_ecef_m, ClusterGroup& group) {
    set_sphere(graph, graph.triangles, vertices, origin_ecef_m, group);
}

}  // namespace oro
