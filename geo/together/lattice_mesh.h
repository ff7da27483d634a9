// Triangles on the lattice that is drawn, as a cluster graph is built over them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory_resource>
#include <span>
#include <vector>

#include "core/base/scratch_memory.h"
#include "geo/meshes/source_mesh.h"

namespace oro {

// Vertices at one place of the lattice are one vertex, and each has an area.
struct LatticeMesh {
    explicit LatticeMesh(std::pmr::memory_resource* memory)
        : vertices(memory), triangles(memory), vertex_of(memory), triangle_of(memory) {}

    glm::dvec3 origin_m{};  // ECEF: a place of the mesh
    std::pmr::vector<glm::dvec3>
        vertices;  // metres from the origin, in the order in which triangles meet them
    std::pmr::vector<std::array<std::uint32_t, 3>> triangles;
    std::pmr::vector<std::uint32_t> vertex_of;    // of the places given, for each vertex
    std::pmr::vector<std::uint32_t> triangle_of;  // of the triangles given, for each triangle
};

// places_m: ECEF, on the lattice (drawn_places_m()). triangles: at least one, of places. Those without an
// area are left out, which may be all. scratch: where its arrays lie, which it outlives; null: in memory.
[[nodiscard]] LatticeMesh lattice_mesh(std::span<const glm::dvec3> places_m,
                                       std::span<const SourceTriangle> triangles,
                                       ScratchMemory* scratch = nullptr);

}  // namespace oro
