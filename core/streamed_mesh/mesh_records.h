// What is known of a mesh's graph without its triangles: what a cut is chosen by, and where its groups lie.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/scratch_memory.h"
#include "core/mesh_file/stored_mesh.h"
#include "core/mesh_file/written_mesh.h"
#include "core/seam/vertex_colour.h"
#include "core/streamed_mesh/ground_cells.h"
#include "core/streamed_mesh/mesh_payload.h"

namespace oro {

// How the payloads of groups are told.
enum class PayloadForm : std::uint8_t {
    alone,      // each by itself
    from_below  // of every third level, and of leaves, by themselves; the others by what their groups use
};

// Groups' payloads lie in a chunk one right after the other: first the leaves that each group of level 1
// uses, then what each group made, in the order of the graph.
struct MeshRecords {
    LatticeSteps origin{}, least{};  // as StoredMesh and PayloadShape have them
    std::uint32_t triangles{};       // of the mesh
    std::uint32_t label_count{};
    bool has_colours{};
    std::uint64_t ground_fingerprint{};  // as of StoredMesh
    PayloadForm form{PayloadForm::from_below};
    // Where the ground lies that this is the fingerprint of. Without grids: it is 0, or they are not known.
    GroundCells ground_cells;
    // Whether its graph was built over ground, which has small parts: its payloads are a town's.
    [[nodiscard]] bool is_town() const { return !ground_cells.grids.empty(); }
    // Without triangles and vertices; first_triangle numbers them as StoredMesh does.
    MeshGraph graph;

    struct Payload {
        std::uint64_t offset{};  // in its chunk
        std::uint32_t bytes{};
        std::uint64_t checksum{};  // xxh64(), its number the seed
    };
    std::vector<Payload> payloads;

    // Of the leaves that a group of level 1 uses, and of what any group made.
    [[nodiscard]] std::uint32_t payload_of_leaves(std::uint32_t group) const { return group; }
    [[nodiscard]] std::uint32_t payload_of_made(std::uint32_t group) const { return leaf_payloads() + group; }
    [[nodiscard]] std::uint32_t leaf_payloads() const {
        return static_cast<std::uint32_t>(payloads.size() - graph.clusters.groups.size());
    }
    // The payload that a cluster lies in.
    [[nodiscard]] std::uint32_t payload_of(const Cluster& cluster) const {
        return cluster.made_by == no_group ? payload_of_leaves(cluster.used_by)
                                           : payload_of_made(cluster.made_by);
    }
    // The clusters of a payload, in its order.
    [[nodiscard]] std::vector<std::uint32_t> clusters_of(std::uint32_t payload) const;
    // Which of its payload's triangles is the first of a cluster.
    [[nodiscard]] std::size_t first_in_payload(std::uint32_t cluster) const;
    // The payloads that must be known to read one, in order: those that hold what its group uses. None where
    // it is told by itself.
    [[nodiscard]] std::vector<std::uint32_t> sources_of(std::uint32_t payload) const;
    // How many levels of payloads must be known first: 0 where it is told by itself.
    [[nodiscard]] std::uint32_t levels_below(std::uint32_t payload) const {
        constexpr std::uint32_t alone_every = 3;
        const bool is_alone = form == PayloadForm::alone || payload < leaf_payloads();
        return is_alone ? 0 : group_around(payload).level % alone_every;
    }
    // The sphere that holds all vertices of a payload, and that the rule goes by.
    [[nodiscard]] const ClusterGroup& group_around(std::uint32_t payload) const {
        return graph.clusters.groups[payload < leaf_payloads() ? payload : payload - leaf_payloads()];
    }
};

// A stored mesh as records and payloads. colours: of its vertices; empty: none. cells: of the ground that its
// graph was built over; null: it was built over none. The same mesh gives the same bytes by any number of
// threads. No group uses more triangles than StoredMesh's bytes may tell. scratch: where payloads lie, which
// it outlives, and the mesh; null: in memory. form: `alone` is as older programs wrote them.
struct StreamedBytes {
    std::vector<std::byte> records;
    std::pmr::vector<std::byte> payloads;
};
[[nodiscard]] StreamedBytes streamed_bytes_of(const StoredMeshView& mesh,
                                              std::span<const VertexColour> colours, int threads,
                                              const GroundCells* cells = nullptr,
                                              ScratchMemory* scratch = nullptr,
                                              PayloadForm form = PayloadForm::from_below);

// Of any bytes: nothing when they are records of groups that are a graph, whose payloads have so many bytes
// together; else what is wrong with them, in words that follow "the mesh". Errors and spheres grow from each
// group to those above it. That errors are bounds, and that spheres hold what a group stands for, is the
// writer's word; payload_of_records() holds spheres against what is drawn.
[[nodiscard]] std::optional<std::string> records_from_bytes(std::span<const std::byte> bytes,
                                                            std::uint64_t payload_bytes,
                                                            MeshRecords& records);

// Of any bytes of the payload of that number: nothing when they are one of these records', and lie in the
// sphere of its group; else what is wrong with it, in words. sources: as sources_of() has them.
[[nodiscard]] std::optional<std::string> payload_of_records(std::span<const std::byte> bytes,
                                                            const MeshRecords& records, std::uint32_t number,
                                                            std::span<const MeshPayload* const> sources,
                                                            MeshPayload& payload);

}  // namespace oro
