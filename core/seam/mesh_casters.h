// Triangles of meshes as what casts shadows: a tree of boxes for the GPU.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/seam/seam.h"
#include "shaders/shared_mesh_casters.h"

namespace oro {

struct MeshCasters {
    glm::dvec3 origin_m{0.0};          // ECEF, near the middle
    std::vector<gpu::MeshNode> nodes;  // the first is the root
    std::vector<gpu::MeshTriangle> triangles;
    std::vector<std::uint8_t> looks;  // of each triangle: SeamPiece::look
};

// The tree of a seam's two-sided pieces and of its skirts beside meshes, without what these reach out by;
// without nodes where there are no such pieces.
// Places are float, from the origin: within 1 mm up to 16 km from it. At most gpu::mesh_tree_depth deep.
// Takes some 0.5 us a triangle on one thread.
MeshCasters mesh_casters_of(const Seam& seam);

}  // namespace oro
