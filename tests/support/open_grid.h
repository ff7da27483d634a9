// A region that is one grid, for tests.
#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "geo/opening/open_region.h"

namespace oro::test {

inline Result<RegionGrid> open_grid(const RegionRequest& request, const Progress& progress = {}) {
    ORO_TRY(Region region, open_region(request, progress));
    EXPECT_EQ(region.grids.size(), 1U);
    return std::move(region.grids.front());
}

}  // namespace oro::test
