// What regions of a file's own posts (--own-posts) cannot do yet.
#pragma once

#include "apps/view/view.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// A usage error where a view of such a region asks for what only regions of latitudes and longitudes have:
// another model of the Earth or of placing, images over the ground.
Result<void> check_own_posts(const View& view, const Region& region);

// A usage error where a command that cannot do with them is asked for own posts.
Result<void> refuse_own_posts(bool asked, const char* command);

}  // namespace oro
