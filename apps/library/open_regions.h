// The regions that users of the library have open, by their numbers.
#pragma once

#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/commands/sight/sight_ground.h"
#include "apps/library/orograph.h"
#include "apps/options/options.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "geo/sources/region_request.h"

namespace oro {

// All that the library holds of an open region. It stays as it is while it is open, so that several threads
// may ask about it.
struct OpenRegion {
    RegionOptions options;
    ViewOptions cover;  // its land cover and its canopy alone
    RegionRequest request;
    nlohmann::ordered_json info;      // info_json(), without the files that were passed over
    std::optional<Region> as_opened;  // with the grids that `ground` leaves out; nothing where there are none
    std::unique_ptr<const SightGround> ground;
};

// Opens a region. Errors: those of open_sight_cover(), open_region() and sight_ground_of().
Result<std::shared_ptr<const OpenRegion>> open_for_library(const RegionOptions& options,
                                                           const ViewOptions& cover,
                                                           const Progress& progress);

// Keeps a region under a number that was never given before, and is not 0.
oro_region keep_open(std::shared_ptr<const OpenRegion> region);
// The region of a number. Errors (usage): there is none.
Result<std::shared_ptr<const OpenRegion>> region_of(oro_region number);
// Forgets the region of a number; who uses it still has it. Errors (usage): there is none.
Result<void> close_region(oro_region number);

}  // namespace oro
