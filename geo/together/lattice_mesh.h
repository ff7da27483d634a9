// Triangles on the lattice that is drawn, as a cluster graph is built over them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "geo/meshes/source_mesh.h"

namespace oro {

// Vertices at one place of the lattice are one vertex, and each has an area.
struct LatticeMesh {
    glm::dvec3 origin_m{};             // ECEF: a place of the mesh
    std::vector<glm::dvec3> vertices;  // metres from the origin, in the order in which triangles meet them
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> vertex_of;    // of the places given, for each vertex
    std::vector<std::uint32_t> triangle_of;  // of the triangles given, for each triangle
};

// places_m: ECEF, on the lattice (drawn_places_m()). triangles: at least one, of places. Those without an
// area are left out, which may be all.
[[nodiscard]] LatticeMesh lattice_mesh(std::span<const glm::dvec3> places_m,
                                       std::span<const SourceTriangle> triangles);

}  // namespace oro
