// Meshes on the ground (surveys, towns) as parts of a model.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/tilesets/mesh_palette.h"

namespace oro {

struct ModelMesh {
    std::string name;  // of its file
    // East, up and south of the model's origin, metres, rounded to float.
    std::vector<glm::vec3> positions_m;
    std::vector<glm::vec3> normals;              // on the side that a triangle is anticlockwise on
    std::vector<std::array<double, 3>> colours;  // linear light, 0 .. 1
    std::vector<std::uint32_t> indices;          // three a triangle
};

// All triangles of a mesh, each with the colour of its material (colours_of_triangles()). undulation: N of
// the region; empty: 0.
ModelMesh model_mesh(const PlacedMesh& mesh, const UndulationField& undulation, const Geodetic& origin,
                     const MeshPalette& palette);

}  // namespace oro
