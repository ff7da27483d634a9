// What the triangles of a mesh are parts of: buildings, or what hangs together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "geo/meshes/placed_mesh.h"

namespace oro {

// A feature of a mesh, or triangles that hang together by their vertices; or a piece of one of them.
struct MeshThing {
    std::size_t mesh{};                    // its number in the region
    std::optional<std::uint32_t> feature;  // ... and that of the feature in its mesh
    std::vector<std::uint32_t> triangles;  // of the mesh
    // Metres: no two points of the whole thing are farther apart. A piece has that of its whole.
    double size_m{};
    glm::dvec3 middle_m{0.0};  // of the piece, ECEF
};

// Vertices of a placed mesh, ECEF in metres. undulation: N of the region; empty: 0.
std::vector<glm::dvec3> vertices_of_mesh(const PlacedMesh& mesh, const UndulationField& undulation);

// All triangles of a mesh, each in one thing. Things of more than most_triangles, or wider than widest_m, are
// cut in halves across their longest side until they are neither, or have one triangle. vertices_m: of
// vertices_of_mesh(). number: of the mesh. The order is that of the file's triangles.
std::vector<MeshThing> things_of_mesh(const PlacedMesh& mesh, std::size_t number,
                                      std::span<const glm::dvec3> vertices_m, std::size_t most_triangles,
                                      double widest_m);

}  // namespace oro
