// Whether grids of a region that have ground for the same places have the same ground.
#pragma once

#include <string>

#include "geo/region/region.h"

namespace oro {

// One note on each pair of grids, of nearly the same spacing, whose heights differ by more than elevation
// data is accurate (contradiction_m) at more than half of the places that both have; "" for none. Looks at
// 1,024 posts at most of the finer grid of each pair, and at no pairs of more than 64 grids.
std::string note_of_contradicting_grids(const Region& region);

}  // namespace oro
