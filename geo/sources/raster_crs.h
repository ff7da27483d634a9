// What a raster says of the coordinates that it lies in.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/files/raster_library.h"

namespace oro {

// The CRS that a raster states, x (or longitude) first. Errors (a reason, without the file's name): none, one
// that PROJ does not know, one that is tied to no place on the Earth.
Result<SpatialReference> crs_of(GDALDatasetH dataset);
// WKT2.
std::string wkt_of(OGRSpatialReferenceH crs);
// "EPSG:2056 CH1903+ / LV95"
std::string crs_name(OGRSpatialReferenceH crs);
// Its horizontal part, x (or longitude) first.
SpatialReference horizontal_part(OGRSpatialReferenceH crs);

// As GDAL takes it (EPSG:2056, PROJ or WKT text), x or longitude first; null for what PROJ does not know.
// Nothing is fetched, and no file is read.
SpatialReference crs_from_text(const std::string& text);
// What is wrong with a text for which crs_from_text() gives null: "is no coordinate reference system that
// PROJ knows; e.g. EPSG:2056", or that EPSG:2056 may be meant by 2056.
std::string unknown_crs_words(const std::string& text, const std::string& example);
// A short name where PROJ has the same by it, else WKT2.
std::string text_of_crs(OGRSpatialReferenceH crs);

}  // namespace oro
