// Styles by which QGIS shows rasters of several bands: without one it takes three bands for red, green and
// blue.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/files/whole_file.h"

namespace oro {

// The style for the first band of a viewshed: hidden and seen, with names. The plugin of QGIS has the same.
extern const char* const viewshed_qml;
// The same for the first band of horizons: elevations from -5 to 60 degrees.
extern const char* const horizon_qml;

// Where QGIS looks for the style of a raster: NAME.qml of NAME.tif.
std::string style_path(const std::string& raster);

// The style beside a raster of so many bands, without its name yet. Nothing where QGIS shows the first band
// by itself (of one or two); where a file has that name already, which may be a user's own; and on a network.
// Errors: those of WholeFile.
Result<std::optional<WholeFile>> style_beside(const std::string& raster, std::size_t bands, const char* qml);

}  // namespace oro
