// Grids of a region that lie wholly under others: nothing of them is ever seen or asked for.
#pragma once

#include "geo/region/region.h"

namespace oro {

// This takes those grids out of a region whose ground lies wholly under that of another one: one with a
// smaller rank and no void posts, or with the same posts. Nothing is drawn of them, and to cut them takes
// seconds for each pair. A grid that only several others cover together stays. What is left keeps its order.
// The first grid gets the notes of those that go, and one more that counts them. It costs a comparison of
// boxes for each pair of grids, and where a grid has a net a walk along the rim of one of them.
void leave_covered_grids_out(Region& region);

}  // namespace oro
