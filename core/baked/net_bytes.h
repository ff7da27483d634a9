// A net of posts (core/net/lattice_georeference.h) as it lies in a region file: how its posts are cut into
// patches, its error, the coefficients of each patch, and where there are any the corrections of some
// patches, packed; little endian, to the bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/net/lattice_georeference.h"

namespace oro::region_format {

// Before the coefficients: eight counts of 4 bytes, and the error. A patch's coefficients are three doubles
// each.
inline constexpr std::uint64_t net_front_bytes = 40;
inline constexpr std::uint64_t patch_bytes = std::uint64_t{LatticeGeoreference::coefficients_a_patch} * 24;

// The largest size that a net of rows x columns posts can have whose bytes begin with `front`,
// net_front_bytes or all that there are: what memory is taken for. Any bytes may be given. Errors: what makes
// them no such net.
[[nodiscard]] Result<std::uint64_t> most_net_bytes(std::span<const std::byte> front, int rows, int columns);
[[nodiscard]] std::vector<std::byte> net_to_bytes(const LatticeGeoreference& net);
// Any bytes may be given. Errors: what makes them no net of rows x columns posts.
[[nodiscard]] Result<std::shared_ptr<const LatticeGeoreference>> net_from_bytes(
    std::span<const std::byte> bytes, int rows, int columns);

}  // namespace oro::region_format
