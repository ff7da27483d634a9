// The grids of a region that lie over each other, made one surface.
#pragma once

#include <vector>

#include "core/seam/seam.h"
#include "geo/region/region.h"
#include "geo/together/cut_out.h"

namespace oro {

// The grids of a region: its own, then those beside it.
std::vector<const Region*> all_grids(const Region& region);

// What is cut out of each of them by those with a smaller rank. Errors: as cut_out().
Result<std::vector<CutOut>> cut_regions(const Region& region);

// What is drawn between them.
Seam seam_between(const Region& region, const std::vector<CutOut>& cuts, double exaggeration);

}  // namespace oro
