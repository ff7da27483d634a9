// A region of several grids in one file: a short header, then a region file for each grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/open_file.h"
#include "core/base/result.h"

namespace oro {

// One of the grids: a whole region file from `offset` on.
struct GridInFile {
    std::uint64_t offset{};
    std::uint64_t bytes{};
    std::uint32_t rank{};  // 0 is the ground where several have some (Region::rank)
};

inline constexpr std::size_t most_grids_in_file = 4096;

// Little-endian: "OROGRIDS", version (uint32, 1), number of grids (uint32); for each its size in bytes
// (uint64), its rank and a zero (uint32 each); and the XXH64 of all before. The grids follow, one right after
// the other. sizes and ranks: of 2 to most_grids_in_file grids, each rank below their number once.
[[nodiscard]] std::vector<std::byte> grids_header(std::span<const std::uint64_t> sizes,
                                                  std::span<const std::uint32_t> ranks);

// What the header of an open file says. Errors: a version that this program does not read; damage, at its
// byte; a file that is longer or shorter than its grids.
[[nodiscard]] Result<std::vector<GridInFile>> grids_in(const OpenFile& file);

// True for a plain file that begins as such a file does, of whatever version.
[[nodiscard]] bool looks_like_grids_file(const std::string& path);

}  // namespace oro
