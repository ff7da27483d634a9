// How high what grows on the ground is at the posts of a grid.
#pragma once

#include <span>
#include <vector>

#include "core/base/result.h"
#include "geo/canopy/canopy_map.h"
#include "geo/region/region.h"

namespace oro {

// The canopy around each post of a row, metres: one value for each column of the grid; no_canopy_m where
// nothing is known. It is that of the cell between the middles of the ways to the neighbouring posts. May be
// called from several threads. Errors: those of CanopyMap::heights_around().
Result<void> canopy_of_row(const PostGrid& grid, int row, const CanopyMap& canopy, std::span<float> canopy_m);

// The same of every post, row by row from the north-west. Computes on all threads.
Result<std::vector<float>> canopy_of_posts(const PostGrid& grid, const CanopyMap& canopy);

}  // namespace oro
