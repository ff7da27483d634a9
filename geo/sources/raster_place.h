// Where a raster's posts lie on the Earth, and whether its coordinates fit its CRS.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/files/raster_library.h"
#include "geo/sources/source.h"

namespace oro {

// Fills in where a source lies (on_degrees, axes, bounds, spacing) from its horizontal CRS and the affine map
// from post numbers to it; report.rows and report.columns are set. Errors (a reason, without the file's
// name): a CRS that PROJ cannot turn into WGS84, coordinates that it cannot place.
Result<void> place_on_earth(Source& source, OGRSpatialReferenceH horizontal);

// Holds the coordinates of a source that lies on the Earth already against its horizontal CRS. `doubts` get a
// line where all of it lies far outside the area that the CRS is made for, by itself or by the same CRS in
// PROJ's database. Errors (a reason, without the file's name): degrees under a CRS of metres or feet, by
// which posts lie millimetres to centimetres apart, or outside that area.
Result<void> check_place(const Source& source, OGRSpatialReferenceH horizontal,
                         std::vector<std::string>& doubts);

}  // namespace oro
