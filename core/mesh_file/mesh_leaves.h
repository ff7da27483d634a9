// The triangles of a mesh without its graph.
#pragma once

#include <cstdint>
#include <vector>

#include "core/mesh_file/stored_mesh.h"

namespace oro {

// As StoredMesh has them, but for colours, leaf by leaf, with vertices as the triangles meet them.
struct MeshLeaves {
    std::vector<LatticeSteps> places;
    std::vector<VertexTriangle> triangles;
    std::vector<std::uint32_t> labels;  // of these; or empty
};

}  // namespace oro
