// A baked region (.oro): its grids, as the steps of opening take them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/baked/baked_file.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// The path among them that is a baked region's: a file that ends in .oro, or begins as one does; nothing when
// there is none.
std::optional<std::string> baked_path(const std::vector<std::string>& paths);

// This opens the grids of the baked region at a path. Errors: those of open_baked_file(); a second path, or
// options that were decided when it was baked (usage).
[[nodiscard]] Result<std::vector<BakedGrid>> open_baked_grids(const std::string& path,
                                                              const RegionRequest& request);

// This reads one of its grids, with its description. Without a box its posts are read when they are asked
// for; with one, those inside are read at once, and are the posts, to the bit, that the sources give for that
// box (and void ones up to its edge where no source reaches that far). Errors: those of RegionFile and of its
// description; a box that it does not meet, or in which all is void (no_data).
[[nodiscard]] Result<RegionGrid> read_baked_grid(const BakedGrid& baked, const RegionRequest& request,
                                                 const Progress& progress);

}  // namespace oro
