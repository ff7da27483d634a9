// From paths and a bounding box to one region: which sources there are, what they say of themselves, and the
// height field that they make together.
#pragma once

#include "core/base/progress.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/sources/region_request.h"

namespace oro {

// Reads a region, or opens a baked one: the way from files to posts.
//     RegionRequest request;
//     request.paths = {"jacksboro.tif"};
//     request.box = BoundingBox{-84.3, 36.5, -84.2, 36.6};  // west, south, east, north
//     ORO_TRY(const Region region, open_region(request));
//     const float H_m = region.grids[0].field.H_at_post_m(0, 0);  // the north-west post, above the geoid
// Errors: a path that is not there or unreadable, a source that is
// damaged (file, place, value, reason), no data in the region (ErrorKind::no_data), a datum that cannot be
// honoured with strict_datum, a baked region beside other paths or with an option that was decided when it
// was baked (ErrorKind::usage).
Result<Region> open_region(const RegionRequest& request, const Progress& progress = {});

}  // namespace oro
