// How a cluster graph lies in its chunks (core/base/container.h); for what writes and what reads it.
//
//   graph    44 bytes, of ClusterOutline, and its levels, 72 bytes each: what building did, level 1 first
//   groups   records, 88 bytes a group, in the order of the graph: found without reading anything else
//   meshes   payloads (core/cluster_file/group_code.h), in the same order, one right after the other
//
// A record has its checksum at its end, and that of its payload.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/cluster_file/cluster_file.h"

namespace oro::cluster_format {

inline constexpr std::size_t outline_bytes = 44;
inline constexpr std::size_t level_bytes = 72;
inline constexpr std::size_t record_bytes = 88;
// No builder makes more (core/clusters/graph_builder.h).
inline constexpr std::size_t most_levels = 80;

[[nodiscard]] std::vector<std::byte> outline_to_bytes(const ClusterOutline& outline);
// Of at least outline_bytes; as many levels as there are bytes for.
[[nodiscard]] ClusterOutline outline_from_bytes(std::span<const std::byte> bytes);

// A group's record: the group, without its level and first_member, and where its payload is.
struct StoredGroup {
    ClusterGroup group{};
    std::uint32_t triangles{};       // of what it made
    std::uint64_t payload_offset{};  // in its chunk
    std::uint32_t payload_bytes{};
    std::uint64_t payload_checksum{};
};
// number: of the group, by which alike records are told apart.
[[nodiscard]] std::vector<std::byte> record_to_bytes(const StoredGroup& stored, std::uint32_t number);
[[nodiscard]] StoredGroup record_from_bytes(std::span<const std::byte> bytes);

// Groups that are coded, or decoded, before the next step.
inline constexpr std::uint32_t groups_at_a_time = 256;

[[nodiscard]] inline Error fault(const std::string& path, const std::string& what) {
    return {ErrorKind::failed, path, what};
}

// What no graph has, in words that follow the name of the part; nothing when all is well. Counts are held
// against each other, and against the sizes of the chunks of groups and of meshes, so that nothing is
// allocated for what cannot be there.
[[nodiscard]] std::optional<std::string> implausible(const ClusterOutline& outline,
                                                     std::uint64_t groups_bytes);
[[nodiscard]] std::optional<std::string> implausible(const StoredGroup& stored, const ClusterOutline& outline,
                                                     std::uint64_t meshes_bytes);

}  // namespace oro::cluster_format
