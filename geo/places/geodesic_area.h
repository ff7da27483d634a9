// How large a part of the ellipsoid is.
#pragma once

#include <span>

#include "geo/places/geodesic.h"

namespace oro {

struct GeodesicArea {
    double area_m2{};  // 0 or more, whichever way round the corners go; of the smaller side
    double perimeter_m{};
};
// The polygon of these corners, joined by shortest paths, the last to the first. Error: 0.1 m2 a corner (C.
// F. F. Karney, Algorithms for geodesics, J. Geodesy 87, 2013). Paths that cross count parts with opposite
// signs.
GeodesicArea geodesic_area(std::span<const LatLon> corners);

}  // namespace oro
