// Where a raster's posts lie on the Earth.
#pragma once

#include <array>

#include "core/base/result.h"
#include "geo/files/raster_library.h"
#include "geo/sources/source.h"

namespace oro {

// Fills in where a source lies (on_degrees, axes, bounds, spacing) from its horizontal CRS and the affine map
// from post numbers to it; report.rows and report.columns are set. Errors (a reason, without the file's
// name): a CRS that PROJ cannot turn into WGS84, coordinates that it cannot place.
Result<void> place_on_earth(Source& source, OGRSpatialReferenceH horizontal);

}  // namespace oro
