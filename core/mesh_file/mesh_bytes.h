// A mesh and its cluster graph as bytes: some 2 to 4 a triangle of the mesh, all levels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/mesh_file/stored_mesh.h"

namespace oro {

// No mesh that is written has more, so none that is read asks for more memory.
inline constexpr std::uint32_t most_stored_triangles = 20'000'000;
// Of all levels together.
inline constexpr std::uint32_t most_graph_triangles = 1U << 26U;

// What is written: a graph as build_mesh_graph() makes it.
struct MeshToStore {
    LatticeSteps origin{};                  // the place that the graph was built around
    std::span<const LatticeSteps> places;   // of all vertices, within 2^32 - 1 steps of each other
    std::span<const std::uint32_t> labels;  // of each triangle of the mesh, below label_count; or empty
    std::uint32_t label_count{};
    const MeshGraph& graph;
    std::uint64_t ground_fingerprint{};  // StoredMesh::ground_fingerprint
};

// The same mesh gives the same bytes. Told are the mesh's triangles and places, and of each group which of
// its vertices go to which neighbours, in which clusters the rest lies, and its error: so what is read has no
// crack between groups, whatever the bytes say. Spheres are reckoned from these. written: null, or takes what
// mesh_from_bytes() reads of these bytes. Errors, in words: a graph above the limits, or one that no builder
// makes.
[[nodiscard]] Result<std::vector<std::byte>> mesh_to_bytes(const MeshToStore& mesh,
                                                           StoredMesh* written = nullptr);

// The inverse, in one pass, a fortieth of the time that building takes. Any bytes may be given: nothing when
// they are a mesh, else what is wrong with them, in words that follow "the mesh"; `mesh` is then of no use.
// The mesh is that which was written, renumbered as StoredMesh says. Each error is at least that of the
// groups below; that it is a bound is the writer's word (core/mesh_file/mesh_check.h measures it).
[[nodiscard]] std::optional<std::string> mesh_from_bytes(std::span<const std::byte> bytes, StoredMesh& mesh);

}  // namespace oro
