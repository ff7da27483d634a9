// What the triangles of a mesh are parts of: buildings, or what hangs together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geo/meshes/placed_mesh.h"
#include "geo/meshes/triangle_looks.h"

namespace oro {

struct ThingLevels;

// A vertex that is rounded to steps of 2^-11 m along three axes moves by less, with what doubles and the
// outlines of boxes add: metres.
inline constexpr double most_rounding_m = 0.5e-3;

// A feature of a mesh, or triangles that hang together by their vertices; or a piece of one of them.
struct MeshThing {
    std::size_t mesh{};                    // its number in the region
    std::optional<std::uint32_t> feature;  // ... and that of the feature in its mesh
    std::vector<std::uint32_t> triangles;  // of the mesh
    // Metres: no two points of the whole thing are farther apart. A piece has that of its whole.
    double size_m{};
    glm::dvec3 middle_m{0.0};  // of the piece, ECEF
    // What is drawn of a large thing; null: its triangles are.
    std::shared_ptr<const ThingLevels> levels{};
    TriangleLook look{};  // of levels
};

// Vertices of a placed mesh, ECEF in metres. undulation: N of the region; empty: 0.
std::vector<glm::dvec3> vertices_of_mesh(const PlacedMesh& mesh, const UndulationField& undulation);

// All triangles of a mesh, each in one thing. number: of the mesh. vertices_m: of vertices_of_mesh(). The
// order is that of the file's triangles.
std::vector<MeshThing> things_of_mesh(const PlacedMesh& mesh, std::size_t number,
                                      std::span<const glm::dvec3> vertices_m);

// The thing, or where it has more than most_triangles, or is wider than widest_m, its pieces: it is cut in
// halves across its longest side until they are neither, or have one triangle. Its triangles are all there.
std::vector<MeshThing> pieces_of_thing(const PlacedMesh& mesh, std::span<const glm::dvec3> vertices_m,
                                       MeshThing thing, std::size_t most_triangles, double widest_m);

}  // namespace oro
