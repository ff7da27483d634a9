// Heights at the posts of a region as a Cloud Optimized GeoTIFF: tiled, with overviews, its directories
// first, so that a reader takes the parts that it wants out of a file on a server.
#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"
#include "geo/rasters/post_raster.h"

namespace oro {

struct CloudRasterWritten {
    bool whole_numbers{};  // Int16; else Float32
    std::uint64_t bytes{};
};

// Whether values can be kept as Int16 without a change: whole numbers of -32767 to 32767, or no_value, which
// must be -32768 then, of a kind that has no fractions. Of one band.
bool are_whole_numbers(const PostRaster& raster);

// Written whole or not at all, by GDAL's COG driver, on up to `threads` threads: Int16 where
// are_whole_numbers(), else Float32, the values of the raster's one band to the bit; DEFLATE; overviews are
// means. Same raster, same bytes for any number of threads. What is written is made in memory first. Errors:
// those of WholeFile; what GDAL cannot write.
Result<CloudRasterWritten> write_cloud_raster(const std::string& path, bool overwrite,
                                              const PostRaster& raster, int threads);

}  // namespace oro
