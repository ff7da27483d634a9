// A baked region (.oro) as a Region.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/progress.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// The path among them that is a baked region's: a file that ends in .oro, or begins as one does; nothing when
// there is none.
std::optional<std::string> baked_path(const std::vector<std::string>& paths);

// Opens the baked region of a request at baked_path(); one of several grids for who can do with them
// (allow_multiple_grids).
// Without a box its posts are read when they are asked for; with one, those inside are read at once, and are
// the posts, to the bit, that the sources give for that box (and void ones up to its edge where no source
// reaches that far). Errors: a second path, options that were decided when it was baked (usage); those of
// RegionFile and of its description; a box that it does not meet, or in which all is void (no_data).
Result<Region> open_baked_region(const std::string& path, const RegionRequest& request,
                                 const Progress& progress);

}  // namespace oro
