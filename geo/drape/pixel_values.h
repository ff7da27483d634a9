// Single pixels of a raster, by place.
#pragma once

#include <functional>
#include <span>

#include "core/base/result.h"
#include "geo/drape/placed_raster.h"
#include "geo/drape/shared_raster.h"

namespace oro {

// The pixel that a place lies in, and what the first band holds there.
struct PixelValue {
    std::size_t place{};  // number of the place
    int column{};
    int row{};
    double value{};
};
using PixelSink = std::function<Result<void>(const PixelValue& pixel)>;

// Reads the pixels that places lie in, WGS84 degrees, one after the other; places beyond the raster are
// passed over. Nothing is interpolated. The library keeps the blocks that they are in. `shared` is of the
// raster. Errors: a file that has changed, is damaged or takes too long; those of the sink.
Result<void> read_pixels_at(const PlacedRaster& raster, const SharedRaster& shared,
                            std::span<const double> lat_deg, std::span<const double> lon_deg,
                            const PixelSink& sink);

}  // namespace oro
