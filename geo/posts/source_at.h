// Which source the ground at a place comes from.
#pragma once

#include "geo/region/region.h"

namespace oro {

// The source of a grid that the surface at a place (degrees; any whole turn of the longitude) comes from:
// of those whose posts lie around it the finest, among equals the first in the byte order of file names. A
// source reaches half a spacing beyond its posts where no other has posts around the place. Null where there
// is none. Boxes are all that is asked: where the finest has a void post that a coarser one filled, or does
// not fill its box, the finest is named all the same. Points into the grid.
const SourceReport* source_at(const RegionGrid& grid, double lat_deg, double lon_deg);

}  // namespace oro
