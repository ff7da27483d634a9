// The fifth step to a region: what is known of its grids.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/opening/grid_mosaic.h"
#include "geo/region/region.h"
#include "geo/sources/region_request.h"

namespace oro {

// This counts the posts of a grid without a height, and why, and takes its fingerprints; a baked grid was
// described when it was baked. Errors: none of its
// posts has a height (no_data), and why.
[[nodiscard]] Result<RegionGrid> describe_grid(LaidGrid laid, const RegionRequest& request);

// This makes a region of grids, at least one, in the order of their choice: that of most posts comes first,
// and has the notes on all (those of a baked region stay in its order). left_out: of each grid without any
// height, why.
[[nodiscard]] Region describe_region(std::vector<RegionGrid> grids, const std::vector<Error>& left_out,
                                     bool is_baked);

}  // namespace oro
