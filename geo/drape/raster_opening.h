// From a file to a placed raster, by GDAL.
#pragma once

#include <string>

#include "core/base/result.h"
#include "geo/drape/placed_raster.h"
#include "geo/files/raster_library.h"

namespace oro {

// Opens the raster's file by a driver that is trusted, and fills in its size, the files that it is made of
// and what is doubtful of them. Errors (a reason, without the file's name): as inspect_raster's for what a
// raster names; a format that is not accepted.
Result<Dataset> open_dataset(PlacedRaster& raster, const GdalMessages& messages);
// Over the pixels that a raster holds itself, to be read; null where there is no memory.
Dataset held_dataset(const PlacedRaster& raster);
// Fills in where it lies. Errors (a reason, without the file's name): no CRS; a georeference that is no map
// from pixels to places.
Result<void> place_raster(PlacedRaster& raster, GDALDatasetH dataset);
// The error of a reason that the functions above gave, with the raster's file.
Error with_file(const std::string& file, const Error& error);

}  // namespace oro
