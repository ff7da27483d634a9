// Normals of a mesh's triangles as viewers of glTF take them.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geo/meshes/placed_mesh.h"

namespace oro {

// At the three corners of each triangle, unit, along the axes of its vertices (corner_normals()), on the side
// from which the triangle is anticlockwise: viewers turn the normals of a triangle that is seen from behind.
// vertices_m: of the mesh.
std::vector<std::array<glm::vec3, 3>> outward_normals(const PlacedMesh& mesh,
                                                      std::span<const glm::dvec3> vertices_m);

}  // namespace oro
