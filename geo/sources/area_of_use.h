// The area that a coordinate reference system is made for, as PROJ's database states it.
#pragma once

#include <optional>
#include <string>

#include "geo/files/raster_library.h"

namespace oro {

// Degrees; east below west across the antimeridian.
struct AreaOfUse {
    double west_deg, south_deg, east_deg, north_deg;
};

// Nothing where a CRS and its like in the database state none. wkt: the CRS's text. From any thread.
std::optional<AreaOfUse> area_of_use(OGRSpatialReferenceH crs, const std::string& wkt);

// Degrees between a box and an area, along a meridian or a parallel, whichever is more; 0 where they meet.
// Its west is at most its east, each in any whole turn.
double outside_area_deg(const AreaOfUse& area, const AreaOfUse& box);

// "47 N to 56 N, 6 E to 12 E"
std::string area_words(const AreaOfUse& area);

}  // namespace oro
