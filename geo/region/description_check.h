// Whether the description in a baked file is of the posts that the file holds.
#pragma once

#include <string>

#include "geo/region/region.h"

namespace oro {

// This holds what a baked grid's description tells of its posts and of its sources against the grid and its
// heights: the fingerprint of its posts, and of each source its rows, columns, box and heights. Each is asked
// only where it follows from the data: a part that was cut out of another file tells of the sources of all of
// it, and so do heights that were resampled. may_be_feathered: its heights may not be those of its sources at
// its rim (RegionRequest::feather_m). It reads all posts. Errors: the first contradiction, with what is told
// and what the data say; posts that cannot be read. name: how the error begins, "grid 1: ", or "".
[[nodiscard]] Result<void> check_description(const RegionGrid& grid, bool may_be_feathered,
                                             const std::string& name = "");

}  // namespace oro
