// Where a raster of posts lies, told to GDAL. Within geo/rasters.
#pragma once

#include "geo/rasters/post_raster.h"

namespace oro {

// Gives a dataset of GDAL's (a GDALDatasetH) the posts' place, their CRS and the file's tags; each post is
// the middle of a cell. False: GDAL has said why not.
[[nodiscard]] bool place_posts(void* dataset, const PostRaster& raster);

}  // namespace oro
