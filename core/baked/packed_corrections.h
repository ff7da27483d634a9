// The corrections of a net as they lie in a region file: few bytes, for neighbours are corrected alike.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/net/grid_net.h"

namespace oro::region_format {

// How many corrections (4 bytes); the number of the patch of each (4 bytes); a zstd frame. It holds what each
// step differs from the plane through its neighbours before it (west + north - north-west), as 0, -1, 1, -2,
// ...: first the low bytes of all, then the high ones; correction by correction, x, y and z of each, row by
// row.
[[nodiscard]] std::vector<std::byte> pack_corrections(const GridNet::Stored& net);
// Any bytes may be given; `net` has all but its corrections, and its numbers may lie. Errors (of a "grid of
// posts"): what makes them none.
Result<void> unpack_corrections(std::span<const std::byte> bytes, GridNet::Stored& net);

}  // namespace oro::region_format
