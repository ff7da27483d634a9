// What regions whose posts lie where their own CRS has them cannot do.
#pragma once

#include "apps/view/view.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// A usage error where a view of such a region asks for what only regions of latitudes and longitudes have:
// another model of the Earth or of placing.
Result<void> check_own_posts(const View& view, const Region& region);

}  // namespace oro
