// A mesh's cluster graph where it grew.
#pragma once

#include <cstdint>
#include <memory_resource>
#include <vector>

#include "core/mesh_graph/mesh_graph.h"

namespace oro {

// A MeshGraph whose arrays of the mesh's size lie in MeshGraphOptions::scratch, which outlives it.
struct GrownMeshGraph {
    ClusterGraph clusters;  // without triangles: these are the next
    std::pmr::vector<VertexTriangle> triangles;
    std::pmr::vector<std::uint32_t> original_of;
};

// As build_mesh_graph(), without a copy of the graph in memory.
[[nodiscard]] GrownMeshGraph grow_mesh_graph(std::span<const glm::dvec3> vertices,
                                             std::span<const std::array<std::uint32_t, 3>> triangles,
                                             const glm::dvec3& origin_ecef_m,
                                             const MeshGraphOptions& options = {});

}  // namespace oro
