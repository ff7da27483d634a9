// A mesh and its cluster graph as its bytes have them, while they are written.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <type_traits>
#include <vector>

#include "core/mesh_file/stored_mesh.h"

namespace oro {

// What mesh_from_bytes() reads of `bytes`, to the bit, in arrays that may lie in scratch files.
struct WrittenMesh {
    explicit WrittenMesh(std::pmr::memory_resource* memory)
        : places(memory),
          given_vertex(memory),
          labels(memory),
          triangles(memory),
          original_of(memory),
          bytes(memory) {}

    LatticeSteps origin{};
    std::pmr::vector<LatticeSteps> places;
    std::pmr::vector<std::uint32_t> given_vertex;  // of each: its number in MeshToStore::places
    std::pmr::vector<std::uint32_t> labels;
    std::uint32_t label_count{};
    ClusterGraph clusters;                       // without triangles: these are the next
    std::pmr::vector<VertexTriangle> triangles;  // of all levels
    std::pmr::vector<std::uint32_t> original_of;
    std::uint64_t ground_fingerprint{};
    std::pmr::vector<std::byte> bytes;
};

// What a coder fills: where the arrays of the mesh's size are in either.
template <class Coder>
using CodedMesh = std::conditional_t<Coder::writes, WrittenMesh, StoredMesh>;
inline ClusterGraph& graph_of(StoredMesh& mesh) {
    return mesh.graph.clusters;
}
inline ClusterGraph& graph_of(WrittenMesh& mesh) {
    return mesh.clusters;
}
inline std::vector<VertexTriangle>& triangles_of(StoredMesh& mesh) {
    return mesh.graph.clusters.triangles;
}
inline std::pmr::vector<VertexTriangle>& triangles_of(WrittenMesh& mesh) {
    return mesh.triangles;
}
inline std::vector<std::uint32_t>& originals_of(StoredMesh& mesh) {
    return mesh.graph.original_of;
}
inline std::pmr::vector<std::uint32_t>& originals_of(WrittenMesh& mesh) {
    return mesh.original_of;
}

// Either of both, which outlives it.
struct StoredMeshView {
    StoredMeshView(const StoredMesh& mesh)
        : origin(mesh.origin),
          places(mesh.places),
          labels(mesh.labels),
          label_count(mesh.label_count),
          clusters(mesh.graph.clusters),
          triangles(mesh.graph.clusters.triangles),
          original_of(mesh.graph.original_of),
          ground_fingerprint(mesh.ground_fingerprint) {}
    StoredMeshView(const WrittenMesh& mesh)
        : origin(mesh.origin),
          places(mesh.places),
          labels(mesh.labels),
          label_count(mesh.label_count),
          clusters(mesh.clusters),
          triangles(mesh.triangles),
          original_of(mesh.original_of),
          ground_fingerprint(mesh.ground_fingerprint) {}

    LatticeSteps origin{};
    std::span<const LatticeSteps> places;
    std::span<const std::uint32_t> labels;
    std::uint32_t label_count{};
    const ClusterGraph& clusters;  // what it has of triangles is not asked
    std::span<const VertexTriangle> triangles;
    std::span<const std::uint32_t> original_of;
    std::uint64_t ground_fingerprint{};

    [[nodiscard]] std::span<const VertexTriangle> triangles_of(const Cluster& cluster) const {
        return triangles.subspan(cluster.first_triangle, cluster.triangles);
    }
};

}  // namespace oro
