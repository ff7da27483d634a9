// Rasters of land cover: each pixel is the code of a class.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "core/base/result.h"
#include "geo/drape/placed_raster.h"

namespace oro {

struct CoverSource : PlacedRaster {
    std::optional<int> no_data;  // the code that its file has for nothing
    // Those that its first band holds, without no_data; of more than 16 million pixels those of 256 squares
    // of 256 x 256, evenly over it.
    std::set<int> codes;
};

// Looks at a raster in a format that terrain is read from: where it lies, and which codes it holds. Errors:
// those of open_image(); numbers that are no whole ones, and colours, which are no classes; more than 4096
// different codes.
// Of a file of vectors: open_cover_polygons().
Result<CoverSource> open_cover_source(const std::string& file);

}  // namespace oro
