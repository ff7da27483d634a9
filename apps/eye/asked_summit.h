// How the eye of a view came to stand on a summit.
#pragma once

#include <optional>

#include "apps/options/options.h"
#include "core/base/result.h"
#include "core/terrain/summit.h"
#include "geo/region/region.h"

namespace oro {

// What --on-summit did to the place of a view that open_view() made of these options and this region: nothing
// where it was not asked for. Errors: ground that cannot be read.
Result<std::optional<MovedToSummit>> asked_summit(const ViewOptions& options, const Region& region,
                                                  double exaggeration);

// Where --on-summit was not asked for: the post near that stands as a wall before the eye (Standpoint::wall);
// nothing where the eye does not stand on its place. Errors: likewise.
Result<std::optional<MovedToSummit>> wall_near(const ViewOptions& options, const Region& region,
                                               double exaggeration);

}  // namespace oro
