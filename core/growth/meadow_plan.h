// Where grass may stand in a frame: tiles of clumps (shaders/shared_meadow.h) around the eye.
#pragma once

#include <span>
#include <vector>

#include "core/growth/growth_plan.h"

namespace oro {

// Ready for the GPU but for the addresses of its buffers.
struct MeadowPlan {
    std::vector<gpu::GrowthTile> tiles;  // nearest first; none: no grass
    gpu::uint first_page{};              // of triangle ids, once the frame's pages are numbered
};

// The tiles of clumps within gpu::meadow_reach_m of the eye that may show and have a part in the grid, at
// most gpu::meadow_tiles_max, the nearest. A tile belongs to the finest of the frame's pages that covers all
// of it; without one it is left out. page_indices: of the frame, in its order. Errors: none; an eye near a
// pole, far from the grid or high above all its ground has no tiles.
MeadowPlan plan_meadow(const PostGrid& grid, std::span<const PageIndex> page_indices,
                       const GroundRangeOf& ground, const GrowthView& view);

}  // namespace oro
