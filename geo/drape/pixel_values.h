// Pixels of a raster by place: the one that a place lies in, or all those around it.
#pragma once

#include <functional>
#include <span>

#include "core/base/result.h"
#include "geo/drape/cell_size.h"
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

// As read_pixels_at(), but reads all the pixels of a box around each place, which is as large as a cell: an
// odd number of columns and of rows, those of the cell around the first place that lies in the raster; one
// pixel where pixels are larger than half of a cell. What of the box lies beyond the raster is left out.
Result<void> read_pixels_around(const PlacedRaster& raster, const SharedRaster& shared,
                                std::span<const double> lat_deg, std::span<const double> lon_deg,
                                const CellSize& cell, const PixelSink& sink);

}  // namespace oro
