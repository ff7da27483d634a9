// How a cluster file's numbers lie in its bytes; for what writes and what reads it.
//
//   byte 0      header, 88 bytes: Header between the magic, the version and a checksum
//   byte 88     levels, 72 bytes each: what building did, level 1 first
//               records, 88 bytes a group, in the order of the graph: found without reading anything else
//               payloads (core/cluster_file/group_code.h), in the same order, one right after the other, to
//               the end
//
// Numbers are little endian. Each part has its checksum, XXH64: header and records their own, at their end;
// the levels in the header, a payload in its record. No byte is without one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/cluster_file/cluster_file.h"

namespace oro::cluster_format {

// Begins with a byte that no text has, and holds both kinds of line end, which a transfer as text would
// change.
inline constexpr std::array<unsigned char, 8> magic = {0x89, 'O', 'R', 'C', '\r', '\n', 0x1a, '\n'};
inline constexpr std::uint32_t version = 1;
inline constexpr std::size_t header_bytes = 88;
inline constexpr std::size_t level_bytes = 72;
inline constexpr std::size_t record_bytes = 88;
// No builder makes more (core/clusters/graph_builder.h).
inline constexpr std::uint32_t most_levels = 80;

struct Header {
    std::uint64_t file_bytes{};  // 0: unfinished
    ClusterOutline outline;      // without its levels
    std::uint32_t levels{};
    std::uint64_t levels_checksum{};
};
using HeaderBytes = std::array<std::byte, header_bytes>;
[[nodiscard]] HeaderBytes header_to_bytes(const Header& header);
// Of bytes whose magic, version and checksum are right.
[[nodiscard]] Header header_from_bytes(const HeaderBytes& bytes);

[[nodiscard]] std::vector<std::byte> levels_to_bytes(std::span<const GraphLevel> levels);
[[nodiscard]] std::vector<GraphLevel> levels_from_bytes(std::span<const std::byte> bytes);

// Where the parts of a file lie.
struct Offsets {
    std::uint64_t records;
    std::uint64_t payloads;
};
[[nodiscard]] Offsets offsets_of(const Header& header);

// A group's record: the group, without its level and first_member, and where its payload is.
struct StoredGroup {
    ClusterGroup group{};
    std::uint32_t triangles{};  // of what it made
    std::uint64_t payload_offset{};
    std::uint32_t payload_bytes{};
    std::uint64_t payload_checksum{};
};
using RecordBytes = std::array<std::byte, record_bytes>;
// number: of the group, by which alike records are told apart.
[[nodiscard]] RecordBytes record_to_bytes(const StoredGroup& stored, std::uint32_t number);
[[nodiscard]] StoredGroup record_from_bytes(const RecordBytes& bytes);

// Groups that are coded, or decoded, before the next step.
inline constexpr std::uint32_t groups_at_a_time = 256;

[[nodiscard]] inline Error fault(const std::string& path, const std::string& what) {
    return {ErrorKind::failed, path, what};
}

// A checksum over all bytes but the last eight, which hold it. Nothing when it is right, else what is wrong.
[[nodiscard]] std::optional<std::string> wrong_checksum(std::span<const std::byte> bytes, std::uint64_t seed);

// What no graph has, in words that follow the name of the part; nothing when all is well. Counts are held
// against each other, and against the file's size, so that nothing is allocated for what cannot be there.
[[nodiscard]] std::optional<std::string> implausible(const Header& header);
[[nodiscard]] std::optional<std::string> implausible(const Header& header,
                                                     std::span<const GraphLevel> levels);
[[nodiscard]] std::optional<std::string> implausible(const StoredGroup& stored, const Header& header);

}  // namespace oro::cluster_format
