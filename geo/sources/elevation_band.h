// Which band of a raster holds the heights.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/files/raster_library.h"

namespace oro {

struct ElevationBand {
    int band{1};
    bool signed_bytes{};  // see Source
    std::string doubt;    // what a user must know, without the file's name; "" for nothing
};

// Of several bands the heights' one is that whose description says so (elevation, height, DEM ...), or the
// only one that does not hold codes: bytes, or a few small whole numbers, as masks have. Reads some posts of
// each. Errors (a reason, without the file's name): no band, an image, several that may be heights.
Result<ElevationBand> elevation_band(GDALDatasetH dataset);

}  // namespace oro
