// What a baked region says of itself: everything in a RegionGrid but the surface, as text in its file.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// JSON on one line, the same for the same region. Bytes that are no UTF-8 (in file names) are replaced.
std::string region_description(const RegionGrid& region);

// The region that a description tells of, without its surface. Errors name `where` and the field: a text that
// is no JSON, a field that is missing or is not what it must be, more or deeper nested values than any region
// has.
Result<RegionGrid> region_from_description(const std::string& text, const std::string& where);

}  // namespace oro
