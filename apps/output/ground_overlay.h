// A map as KML lays it on the ground.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/rasters/map_frame.h"

namespace oro {

struct GroundOverlay {
    std::string kml;
    // How far from its place a viewer shows the map at most, in the map's pixels: it is told the corners, and
    // lays what is between them evenly (bilinearly) in degrees. Measured at 17 x 17 places.
    double off_px{};
};

// A GroundOverlay that shows the picture of that file name, beside which it lies, and a LookAt from above
// that has all of it in view, with the top of the map at the top. Where the picture's borders are meridians
// and parallels, and its rows and columns lie evenly between them (within a thousandth of a pixel), it has a
// LatLonBox, else a gx:LatLonQuad. Longitudes go on past 180 where the map lies over that meridian.
// legend_px: rows of a strip below the map, which is a part of the picture and lies south of it. attribution:
// who is to be named for the data, "" nobody. Source: OGC KML 2.2 (07-147r2), 11.2 and 11.3; Google's KML
// Reference, gx:LatLonQuad: corners counter-clockwise from the picture's lower left one, in a convex
// quadrilateral. Errors (usage): those of map_middle(); corners that have no place, or between which the map
// does not lie (a pole is in it).
Result<GroundOverlay> ground_overlay(const MapFrame& map, int legend_px, const std::string& picture_name,
                                     const std::string& attribution);

}  // namespace oro
