// Elevation that a command needs and that is not there: fetched into the user's cache.
#pragma once

#include <string>
#include <vector>

#include "apps/options/fetching_options.h"
#include "apps/options/options.h"
#include "core/base/result.h"

namespace oro {

// A place on a command line.
struct AskedPlace {
    std::string option;  // "--at"
    std::string text;
};

// Adds to the region's paths the tiles of a source (FetchingOptions::source) that the command needs and that
// the paths have no data for: those of --bbox or --tile, where the region has one, else those within
// FetchingOptions::km of the places. They are fetched into the cache, or are there already; then the cache is
// trimmed to its limit. One line on standard error tells what was fetched, and who must be named, unless
// quiet. Errors: usage for a source that is none or has no heights, and for a region without a box and a
// place; a tile that could not be fetched.
Result<void> fetch_missing_tiles(RegionOptions& region, const std::vector<AskedPlace>& places,
                                 const FetchingOptions& options, bool quiet);

}  // namespace oro
