// A box of latitudes and longitudes, and all around it.
#pragma once

#include "geo/places/bounding_box.h"

namespace oro {

// A box with all places within a distance of those in `box`, on WGS84, 0 to 5,000 km; a box without width or
// height is a place. Its longitudes are of -180 to 180, and it may cross the antimeridian; where a pole comes
// within the distance, it goes from -180 to 180, and to the pole. Up to 500 km and 70 degrees of latitude it
// is wider than need be by less than one part in 50 of the distance.
BoundingBox widened_box(const BoundingBox& box, double by_m);

}  // namespace oro
