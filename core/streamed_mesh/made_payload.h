// What a group of a mesh's graph made, told by what it uses: which vertices go to which neighbours.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/mesh_file/group_maps.h"
#include "core/streamed_mesh/mesh_payload.h"
#include "core/streamed_mesh/place_hash.h"

namespace oro {

// Triangles of several payloads in one. Vertices at one place are one, numbered as the triangles meet them.
class JoinedPayload {
  public:
    // Appends so many triangles, from that one on. No more than 4,096 in all.
    void add(const MeshPayload& payload, std::size_t first, std::size_t count);
    [[nodiscard]] const MeshPayload& payload() const { return payload_; }

  private:
    MeshPayload payload_;
    std::unordered_map<LatticeSteps, std::uint16_t, PlaceHash> numbers_;
};

// used: the triangles that a group uses, by whatever numbers of vertices, at most 65,536 of these. left: what
// it made of them (GroupMaps). The same give the same bytes; none where no map leads from the one to the
// other, which is so for no group that write_mesh() takes.
[[nodiscard]] std::vector<std::byte> made_to_bytes(std::span<const GroupMaps::Triangle> used,
                                                   std::uint32_t made, std::vector<GroupMaps::Left> left);

// The inverse: into `payload` the clusters that a group made of what it uses. clusters: how many triangles
// each has. Any bytes may be given: nothing when they are such clusters, whose triangles have areas and which
// are not too full, else what is wrong with them, in words that follow "the group".
[[nodiscard]] std::optional<std::string> made_from_bytes(std::span<const std::byte> bytes,
                                                         const MeshPayload& used,
                                                         std::span<const std::uint32_t> clusters,
                                                         MeshPayload& payload);

}  // namespace oro
