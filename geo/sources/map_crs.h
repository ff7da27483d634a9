// A map's CRS, from and to text: for map_frame.cpp and geotiff_tags.cpp.
#pragma once

#include <string>

#include "geo/files/raster_library.h"

namespace oro {

// As GDAL takes it (EPSG:2056, PROJ or WKT text), x or longitude first; null for what PROJ does not know.
// Nothing is fetched, and no file is read.
SpatialReference crs_from_text(const std::string& text);
// A short name where PROJ has the same by it, else WKT2.
std::string text_of_crs(OGRSpatialReferenceH crs);

}  // namespace oro
