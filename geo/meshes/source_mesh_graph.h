// The cluster graph of a mesh as its file has it, before it is put on the Earth.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/base/result.h"
#include "core/mesh_graph/mesh_graph.h"
#include "geo/meshes/source_mesh.h"

namespace oro {

// A mesh as its graph is built of it, metres from its first vertex.
struct MetricMesh {
    std::vector<glm::dvec3> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    glm::dvec3 first_m{};  // where that vertex is
};

// Vertices are taken in metres, by the file's unit or else that of its CRS, or as metres where it states
// neither; they are rounded to a lattice of 2^-11 m, and those at one point are one. Triangles without an
// area are left out. Errors: coordinates are degrees; no triangle is left.
Result<MetricMesh> metric_mesh(const SourceMesh& mesh);

// The graph of that.
Result<MeshGraph> graph_of_source(const SourceMesh& mesh, int threads);

}  // namespace oro
