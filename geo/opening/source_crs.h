// The CRS that the sources of a region are in.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/sources/region_request.h"

namespace oro {

// The CRSs of an open region's sources, each once, as CrsPlaces::of() takes them: WKT2 where the posts lie
// in the sources' own CRS, else a code such as EPSG:2056. Empty where none has a code.
std::vector<std::string> source_crs_of(const Region& region);

// The one CRS of the sources of a region that is not open: of their headers, no post is read. The request's
// box does not count. Errors: those of probe_files(); no elevation data (no_data); sources in several CRSs
// or without a known one (usage).
Result<std::string> one_source_crs(const RegionRequest& request);

}  // namespace oro
