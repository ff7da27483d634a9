// How a region file's numbers lie in its bytes; for what writes and what reads it.
//
//   byte 0      header, 256 bytes: RegionHeader between the magic, the version and a checksum
//   byte 256    description
//               undulation, 4 bytes a node
//               the net, where the posts lie on one (core/baked/net_bytes.h)
//               records, 448 bytes a page, in the order of PageOrder: found without reading anything else
//               payloads (core/baked/page_compression.h), in the same order, one right after the other, to
//               the end
//
// Numbers are little endian. Each part has its checksum, XXH64: header and records their own, at their end;
// description, undulation and net in the header, a payload in its record. No byte is without one.
//
// Versions 1 and 3 have posts on latitudes and longitudes, versions 2 and 4 on a net, 5 and 6 on a net with
// corrections. In 1, 2 and 5 all cells are split from their north-west to their south-east posts, in 3, 4 and
// 6 as the posts of their level decide (core/terrain/cell_diagonal.h); there a page in which a region round the
// Earth ends has one more column of posts. Of a net's axes only step and count mean anything: that of the
// rows has the bytes of the net where the other versions have the first post's index, that of the columns its
// checksum, and all else is 0.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/base/open_file.h"

namespace oro::region_format {

// Begins with a byte that no text has, and holds both kinds of line end, which a transfer as text would
// change.
inline constexpr std::array<unsigned char, 8> magic = {0x89, 'O', 'R', 'O', '\r', '\n', 0x1a, '\n'};
inline constexpr std::uint32_t first_version = 1, last_version = 6;
[[nodiscard]] inline std::uint32_t version_of(const PostGrid& grid) {
    const std::uint32_t by_posts = grid.split == CellSplit::by_posts ? 1 : 0;
    if (grid.net && grid.net->is_corrected()) return 5 + by_posts;
    return (grid.net ? 2 : 1) + 2 * by_posts;
}
[[nodiscard]] constexpr bool is_on_net(std::uint32_t version) {
    return version == 2 || version >= 4;
}
[[nodiscard]] constexpr bool is_on_corrected_net(std::uint32_t version) {
    return version >= 5;
}
[[nodiscard]] constexpr CellSplit split_of(std::uint32_t version) {
    return version == 3 || version == 4 || version == 6 ? CellSplit::by_posts : CellSplit::all_fall;
}
inline constexpr std::size_t header_bytes = 256;
inline constexpr std::size_t record_bytes = 448;
inline constexpr std::uint64_t longest_description = 64U << 20U;
inline constexpr std::uint64_t largest_file = (std::uint64_t{1} << 63U) - 1;

// What the header holds between version and checksum, in this order.
struct RegionHeader {
    std::uint32_t version{first_version};  // the one before the others
    std::uint32_t header_size{header_bytes};
    std::uint64_t file_bytes{};  // 0: unfinished
    std::uint64_t fingerprint{};
    PostGrid grid;  // without its net
    std::uint64_t net_bytes{};
    std::uint64_t net_checksum{};
    GridAxis undulation_lat;
    GridAxis undulation_lon;
    glm::dvec3 occluder_radii_m{};
    float lowest_H_m{};
    float highest_H_m{};
    std::uint64_t voids{};
    std::uint64_t triangles{};
    std::uint64_t description_bytes{};
    std::uint64_t undulation_nodes{};
    std::uint64_t pages{};
    std::uint64_t description_checksum{};
    std::uint64_t undulation_checksum{};
};
using HeaderBytes = std::array<std::byte, header_bytes>;
// Of an unfinished file; pages and checksums are left at 0.
[[nodiscard]] RegionHeader header_of(const RegionOutline& outline, std::uint64_t fingerprint);
[[nodiscard]] HeaderBytes header_to_bytes(const RegionHeader& header);
// Of bytes whose magic, version and checksum are right.
[[nodiscard]] RegionHeader header_from_bytes(const HeaderBytes& bytes);

// A number that no region has: at which byte, which, and what was expected.
struct Implausible {
    std::uint64_t offset;
    std::string what;
};
// Checks every number of a header, those that the sizes depend on first; nothing when all is well.
[[nodiscard]] std::optional<Implausible> implausible(const RegionHeader& header);
// The same for an outline that is about to be written; the offsets are those in the file.
[[nodiscard]] std::optional<Implausible> implausible(const RegionOutline& outline);
// The same for the undulation's values, which begin at byte `offset`.
[[nodiscard]] std::optional<Implausible> implausible(std::span<const float> N_m, std::uint64_t offset);

// For a header that is plausible.
[[nodiscard]] RegionOffsets offsets_of(const RegionHeader& header);

// The header of an unfinished file, the description and the undulation: all before the records. For an
// outline that is plausible.
[[nodiscard]] std::vector<std::byte> beginning_of(const RegionOutline& outline, std::uint64_t fingerprint);

// A page's record as it lies in the file: with the place of its payload.
struct StoredRecord {
    PageRecord page;
    std::uint64_t payload_offset{};
    std::uint32_t payload_bytes{};
    std::uint64_t payload_checksum{};
};
using RecordBytes = std::array<std::byte, record_bytes>;
[[nodiscard]] RecordBytes record_to_bytes(const StoredRecord& record);

// What is wrong with a page's record that is about to be written or was read, if anything.
[[nodiscard]] std::optional<std::string> implausible(const PageRecord& record, PageIndex expected);

// Reads the record of page `number`, whose payload must lie wholly before byte `end`.
[[nodiscard]] Result<StoredRecord> read_record(const OpenFile& file, const RegionOffsets& offsets,
                                               const PageOrder& order, std::uint64_t number,
                                               std::uint64_t end);
// Reads a payload and checks it against its record; the bytes as they are, not decoded.
[[nodiscard]] Result<std::vector<std::byte>> read_payload(const OpenFile& file, const StoredRecord& record);
// The same, decoded.
Result<void> read_payload(const OpenFile& file, const StoredRecord& record, PagePayload& payload);

// Checksums as errors name them.
[[nodiscard]] std::string hexadecimal(std::uint64_t number);

}  // namespace oro::region_format
