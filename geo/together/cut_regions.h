// The grids of a region that lie over each other, made one surface.
#pragma once

#include <vector>

#include "core/seam/seam.h"
#include "geo/region/region.h"
#include "geo/together/gap_bridges.h"
#include "geo/together/grid_clip.h"

namespace oro {

// Those that cut a part out of one of them, in the order that GridClip counts them from 1.
std::vector<const RegionGrid*> finer_than(const Region& region, const RegionGrid& one);

// What those cut out of it; empty where there are none. Errors: as clip_by_finer().
Result<GridClip> cut_of(const Region& region, const RegionGrid& one);

// What makes the grids of a region one surface.
struct RegionCuts {
    std::vector<GridClip> grids;     // what is cut out of each by those with a smaller rank
    std::vector<GapBridge> bridges;  // ... and what joins those that lie next to each other
};
// Errors: as clip_by_finer() and gap_bridges().
Result<RegionCuts> cut_regions(const Region& region);

// What is drawn between them.
Seam seam_between(const Region& region, const RegionCuts& cuts, double exaggeration);

}  // namespace oro
