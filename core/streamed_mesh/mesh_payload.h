// The triangles of one group of a mesh's graph by themselves: bytes that need no other group's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/mesh_file/stored_mesh.h"
#include "core/seam/vertex_colour.h"

namespace oro {

// Clusters one after another: those that a group made, or the leaves that one uses.
struct MeshPayload {
    std::vector<LatticeSteps> places;   // of the vertices, as the triangles meet them
    std::vector<VertexColour> colours;  // of these; empty: the mesh has none
    // Numbers of places; in the order, and from the corner on, that StoredMesh has them.
    std::vector<std::array<std::uint16_t, 3>> triangles;
    std::vector<std::uint32_t> labels;  // of these, as StoredMesh has them; empty: it has none

    // While it is held.
    [[nodiscard]] std::uint64_t held_bytes() const;
    bool operator==(const MeshPayload&) const = default;
};

// What is known of a payload beside its bytes.
struct PayloadShape {
    LatticeSteps least{};  // of all places of the mesh; none is 2^32 steps and more above it
    std::uint32_t label_count{};
    bool has_colours{};
    std::span<const std::uint32_t> clusters;  // how many triangles each has
    bool is_town{};  // coded by what houses have alike (core/streamed_mesh/place_code.h)
};

// The same payload gives the same bytes.
[[nodiscard]] std::vector<std::byte> payload_to_bytes(const PayloadShape& shape, const MeshPayload& payload);
// The inverse. Any bytes may be given: nothing when they are a payload of that shape, whose triangles have
// areas and whose clusters are not too full, else what is wrong with them, in words that follow "the group".
[[nodiscard]] std::optional<std::string> payload_from_bytes(std::span<const std::byte> bytes,
                                                            const PayloadShape& shape, MeshPayload& payload);

// What is wrong with triangles that were read, in the same words: one without an area, a cluster that is too
// full. clusters: as of PayloadShape.
[[nodiscard]] std::optional<std::string> wrong_with_triangles(const MeshPayload& payload,
                                                              std::span<const std::uint32_t> clusters);

}  // namespace oro
