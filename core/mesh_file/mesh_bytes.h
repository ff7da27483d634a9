// A mesh and its cluster graph as bytes: some 2 to 5 a triangle of the mesh, all levels; a half where leaves are elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/scratch_memory.h"
#include "core/mesh_file/mesh_leaves.h"
#include "core/mesh_file/stored_mesh.h"
#include "core/mesh_file/written_mesh.h"
#include "core/mesh_graph/grown_mesh_graph.h"

namespace oro {

// No mesh that is written has more, so none that is read asks for more memory.
inline constexpr std::uint32_t most_stored_triangles = 100'000'000;
// Of all levels together.
inline constexpr std::uint32_t most_graph_triangles = 1U << 29U;

// A graph as build_mesh_graph() or grow_mesh_graph() makes it, which outlives this.
struct GraphToStore {
    GraphToStore(const MeshGraph& graph)
        : clusters(graph.clusters), triangles(graph.clusters.triangles), original_of(graph.original_of) {}
    GraphToStore(const GrownMeshGraph& graph)
        : clusters(graph.clusters), triangles(graph.triangles), original_of(graph.original_of) {}

    const ClusterGraph& clusters;  // what it has of triangles is not asked
    std::span<const VertexTriangle> triangles;
    std::span<const std::uint32_t> original_of;
    [[nodiscard]] std::span<const VertexTriangle> triangles_of(const Cluster& cluster) const {
        return triangles.subspan(cluster.first_triangle, cluster.triangles);
    }
};

// What is written.
struct MeshToStore {
    LatticeSteps origin{};                  // the place that the graph was built around
    std::span<const LatticeSteps> places;   // of all vertices, within 2^32 - 1 steps of each other
    std::span<const std::uint32_t> labels;  // of each triangle of the mesh, below label_count; or empty
    std::uint32_t label_count{};
    GraphToStore graph;
    std::uint64_t ground_fingerprint{};  // StoredMesh::ground_fingerprint
};

// Where the triangles of the leaves are told.
enum class LeavesIn : std::uint8_t {
    bytes,    // with their graph
    payloads  // elsewhere in the file (core/streamed_mesh/mesh_records.h), once
};

// The same mesh gives the same bytes. Told are the mesh's triangles and places, and of each group which of
// its vertices go to which neighbours, in which clusters the rest lies, and its error: so what is read has no
// crack between groups, whatever the bytes say. Spheres are reckoned from these. scratch: where all that is
// of the mesh's size lies, also of what comes out, which it outlives; null: in memory. Errors, in words: a
// graph above the limits, or one that no builder makes.
[[nodiscard]] Result<WrittenMesh> write_mesh(const MeshToStore& mesh, ScratchMemory* scratch,
                                             LeavesIn leaves = LeavesIn::bytes);
// Its bytes alone.
[[nodiscard]] Result<std::vector<std::byte>> mesh_to_bytes(const MeshToStore& mesh);

// The inverse, in one pass, a fortieth of the time that building takes. Any bytes may be given: nothing when
// they are a mesh, else what is wrong with them, in words that follow "the mesh"; `mesh` is then of no use.
// The mesh is that which was written, renumbered as StoredMesh says. Each error is at least that of the
// groups below; that it is a bound is the writer's word (core/mesh_file/mesh_check.h measures it). leaves:
// what the bytes do not tell where has_leaves_elsewhere(), with corners below the number of places; of no use
// then.
[[nodiscard]] std::optional<std::string> mesh_from_bytes(std::span<const std::byte> bytes, StoredMesh& mesh,
                                                         MeshLeaves* leaves = nullptr);
// Whether bytes say that leaves are LeavesIn::payloads.
[[nodiscard]] bool has_leaves_elsewhere(std::span<const std::byte> bytes);

}  // namespace oro
