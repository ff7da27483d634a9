// How a baked grid lies in its chunks (core/base/container.h); for what writes and what reads it.
//
//   outline      184 bytes: OutlineNumbers
//   description  UTF-8
//   undulation   4 bytes a node
//   net          where the posts lie in a CRS of their own (core/baked/net_bytes.h); a grid whose posts lie
//   on
//                latitudes and longitudes has no such chunk
//   pages        records, 444 bytes a page, in the order of PageOrder: found without reading anything else
//   heights      payloads (core/baked/page_compression.h), in the same order, one right after the other
//
// A record has its checksum at its end, and that of its payload. So pages are read one by one; checksums of
// the whole chunks of pages and heights are asked for where all is read anyway. A page in which a region
// round the Earth ends has one more column of posts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/baked/region_file.h"
#include "core/base/container.h"
#include "core/base/open_file.h"

namespace oro::region_format {

inline constexpr std::size_t outline_bytes = 184;
inline constexpr std::size_t record_bytes = 444;
inline constexpr std::uint64_t longest_description = 64U << 20U;
// A geoid of the whole Earth with a node every two minutes has fewer.
inline constexpr std::uint64_t most_undulation_nodes = 64U << 20U;
inline constexpr std::uint64_t largest_file = (std::uint64_t{1} << 63U) - 1;

// These are the numbers of an outline, in the order in which they are stored.
struct OutlineNumbers {
    std::uint64_t fingerprint{};
    // Of a grid on a net only step and count mean anything, and all else is 0.
    GridAxis lat;
    GridAxis lon;
    GridAxis undulation_lat;
    GridAxis undulation_lon;
    glm::dvec3 occluder_radii_m{};
    float lowest_H_m{};
    float highest_H_m{};
    std::uint64_t voids{};
    std::uint64_t triangles{};
};
// These turn an outline into its numbers, and numbers into bytes and back.
[[nodiscard]] OutlineNumbers numbers_of(const RegionOutline& outline, std::uint64_t fingerprint);
[[nodiscard]] std::vector<std::byte> numbers_to_bytes(const OutlineNumbers& numbers);
[[nodiscard]] OutlineNumbers numbers_from_bytes(std::span<const std::byte> bytes);  // outline_bytes of them

// A number that no region has: at which byte of its chunk, and in words which, and what was expected.
struct Implausible {
    std::uint64_t offset;
    std::string what;
};
// Checks every number of an outline; nothing when all is well. on_net: the grid has a net.
[[nodiscard]] std::optional<Implausible> implausible(const OutlineNumbers& numbers,
                                                     std::uint64_t undulation_bytes, bool on_net);
// The same for an outline that is about to be written, its undulation and its description with it.
[[nodiscard]] std::optional<Implausible> implausible(const RegionOutline& outline);
// The same for the undulation's values.
[[nodiscard]] std::optional<Implausible> implausible(std::span<const float> N_m);

// An unfinished file: its table, in which the heights have no bytes yet, and all chunks before the pages. For
// an outline that is plausible.
struct RegionBeginning {
    ChunkTable table;
    std::vector<std::byte> chunks;
};
[[nodiscard]] RegionBeginning beginning_of(const RegionOutline& outline, std::uint64_t fingerprint);

// A page's record as it lies in the file: with the place of its payload.
struct StoredRecord {
    PageRecord page;
    std::uint64_t payload_offset{};  // in its chunk
    std::uint32_t payload_bytes{};
    std::uint64_t payload_checksum{};
};
[[nodiscard]] std::vector<std::byte> record_to_bytes(const StoredRecord& record);

// What is wrong with a page's record that is about to be written or was read, if anything.
[[nodiscard]] std::optional<std::string> implausible(const PageRecord& record, PageIndex expected);

// Reads the record of page `number`, whose payload must lie wholly before the end of the heights.
[[nodiscard]] Result<StoredRecord> read_record(const OpenFile& file, const RegionOffsets& offsets,
                                               const PageOrder& order, std::uint64_t number);
// Reads a payload and checks it against its record; the bytes as they are, not decoded.
[[nodiscard]] Result<std::vector<std::byte>> read_payload(const OpenFile& file, const RegionOffsets& offsets,
                                                          const StoredRecord& record);
// Decodes what read_payload() gave.
Result<void> decode_payload(const OpenFile& file, const RegionOffsets& offsets, const StoredRecord& record,
                            std::span<const std::byte> bytes, PagePayload& payload);

}  // namespace oro::region_format
