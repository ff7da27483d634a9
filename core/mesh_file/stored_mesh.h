// A mesh and its cluster graph as they lie in a file.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "core/mesh_graph/mesh_graph.h"

namespace oro {

// A place in whole steps of 2^-11 m along the axes of ECEF (core/terrain/page_on_net.h, lattice_point()).
using LatticeSteps = std::array<std::int64_t, 3>;
inline constexpr double lattice_steps_per_m = 2048.0;

// A mesh with its graph. The mesh's triangles are those of the graph's leaves, in their order, and its
// vertices are numbered as these meet them. Triangles of a group lie in the order in which it uses them.
struct StoredMesh {
    LatticeSteps origin{};             // the graph's spheres were reckoned from there
    std::vector<LatticeSteps> places;  // of the vertices
    // A number of each triangle of the mesh, below label_count: what it is of is the program's business.
    // Empty where label_count is 0.
    std::vector<std::uint32_t> labels;
    std::uint32_t label_count{};
    MeshGraph graph;
    // Of the ground that the graph was built over; 0: of none. It tells whether ground is the same.
    std::uint64_t ground_fingerprint{};

    // Where a vertex is, metres from the origin: exact.
    [[nodiscard]] glm::dvec3 from_origin_m(std::uint32_t vertex) const {
        const LatticeSteps& at = places[vertex];
        return {static_cast<double>(at[0] - origin[0]) / lattice_steps_per_m,
                static_cast<double>(at[1] - origin[1]) / lattice_steps_per_m,
                static_cast<double>(at[2] - origin[2]) / lattice_steps_per_m};
    }
    [[nodiscard]] glm::dvec3 origin_ecef_m() const {
        return {static_cast<double>(origin[0]) / lattice_steps_per_m,
                static_cast<double>(origin[1]) / lattice_steps_per_m,
                static_cast<double>(origin[2]) / lattice_steps_per_m};
    }
};

}  // namespace oro
