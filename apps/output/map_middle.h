// Where the middle of a map lies, and how the map is turned there.
#pragma once

#include "core/base/result.h"
#include "geo/rasters/map_frame.h"

namespace oro {

struct MapMiddle {
    double lat_deg{};  // WGS84
    double lon_deg{};  // WGS84, (-180, 180]
    // The direction on the ground that is up on the map: true, clockwise from north, (-180, 180]. Where y of
    // the CRS is up on the map that is the grid convergence, positive where grid north lies east of true
    // north. Of a map by longitudes and latitudes it is 0.
    double up_azimuth_deg{};
    // The shorter side of a pixel there, in metres on the ellipsoid.
    double pixel_m{};
};

// Of the map itself, without a strip below it. Measured by PROJ's places half a pixel above and below the
// middle; error of the direction: below 1e-6 degree for pixels of 1 m to 1 km. Errors: a CRS from which PROJ
// knows no way to WGS84; a middle that has no place on the Earth (both usage).
Result<MapMiddle> map_middle(const MapFrame& map);

}  // namespace oro
