// The CRS that a GeoJSON file names, which OGR takes for WGS84 in silence where it does not know it.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/files/guarded_files.h"

namespace oro {

// Errors (a reason, without the file's name): the file has a member "crs" by which nothing is known. Files
// without one, and of other formats, are fine.
Result<void> check_geojson_crs(const std::string& file, FileWatch& watch);

}  // namespace oro
