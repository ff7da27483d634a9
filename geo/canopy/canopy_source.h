// Rasters of canopy heights: metres from the ground to the top of what grows on it.
#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "geo/drape/placed_raster.h"

namespace oro {

// No canopy is higher; the highest trees known have 116 m, and few pixels of such rasters more than 80 m.
// Higher values are codes, centimetres or heights above the sea.
inline constexpr double highest_canopy_m = 100.0;
// Surveys subtract a ground from a surface, and are off by some decimetres: what is below 0 counts as 0, and
// what is lower than this is no canopy.
inline constexpr double lowest_canopy_m = -2.0;

struct CanopySource : PlacedRaster {
    std::optional<double> no_data;  // the value that its file has for nothing
    double scale{1.0};              // metres = scale * value + offset
    double offset{0.0};
};

// Looks at a raster in a format that terrain is read from: where it lies, and whether its first band may be
// heights in metres. Errors: those of open_image(); colours, codes of classes and complex numbers, which are
// no heights; another unit than metres.
Result<CanopySource> open_canopy_source(const std::string& file);

}  // namespace oro
