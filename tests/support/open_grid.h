// A region that is one grid, for tests.
#pragma once

#include <string>
#include <utility>

#include "geo/opening/open_region.h"

namespace oro::test {

// Errors: those of open_region(); none or several grids.
inline Result<RegionGrid> open_grid(const RegionRequest& request, const Progress& progress = {}) {
    ORO_TRY(Region region, open_region(request, progress));
    if (region.grids.size() != 1)
        return Error{ErrorKind::failed, "region", "has " + std::to_string(region.grids.size()) + " grids"};
    return std::move(region.grids.front());
}

}  // namespace oro::test
