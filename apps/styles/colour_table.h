// Colour tables in text, as `gdaldem color-relief` reads them.
#pragma once

#include <functional>
#include <string>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "shaders/shared.h"

namespace oro {

// The map that a table draws: its colours by H, mixed as codes between its heights and constant beyond them,
// without light and air; `nv` is the colour of the background. A line holds a height (or a percentage of the
// way from the region's lowest post to its highest, or `nv`), then red, green and blue from 0 to 255, or the
// name of a colour; a further number (how opaque) counts for nothing. Separated by spaces, tabs, commas or
// colons; lines that begin with # or / are comments. A height that stands twice is a step from the first
// colour to the last. A line INTERPOLATION, as QGIS exports it, says how colours go between heights:
// INTERPOLATED, mixed; DISCRETE, each holds up to its own height, and the height `inf` is above all; EXACT,
// each at its own height alone. What no class holds has the colour of the background. `range`: is asked for
// where there is a percentage. Errors: the file and the line, and what is wrong with it; more than
// tint_stops_max heights; no height at all.
// Source: GDAL, gdaldem manual, "color-relief"; held against GDALDEMProcessing by tests.
Result<gpu::FrameStyle> style_of_colour_table(const std::string& text, const std::string& file,
                                              const std::function<HeightRange()>& range);

}  // namespace oro
