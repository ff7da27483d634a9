// The CRS that a GeoJSON file names.
#pragma once

#include "core/base/result.h"
#include "geo/vectors/json_text.h"
#include "geo/vectors/vector_shapes.h"

namespace oro {

// What turns a file's coordinates into WGS84's: by its member "crs", as GeoJSON had one before RFC 7946 (a
// name, or the number of an EPSG code), or WGS84 where there is none. Errors (a reason, without the file's
// name): a CRS that PROJ does not know, a link to one, which is not followed.
Result<ShapeSplitter> splitter_of_geojson(const JsonValue& root);

}  // namespace oro
