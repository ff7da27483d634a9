// Whether a file that came from a server is the tile that it should be.
#pragma once

#include <functional>
#include <string>

#include "core/base/result.h"
#include "geo/fetch/tile_layout.h"

namespace oro {

// Checks the file `file`, which is to be called `name` in the layout's format. An .hgt.gz must unpack, by its
// checksum, to 2 x 1201^2 or 2 x 3601^2 bytes; no more than that is unpacked. A GeoTIFF must have one band,
// lie where its tile does (within 0.01 degrees), hold whole numbers where it is land cover or canopy, be
// elevation data as other commands open them where it is heights, and have all its blocks inside the file.
// Errors: what it is instead; `shown` stands for the file.
Result<void> check_tile(const std::string& file, const std::string& shown, const TileLayout& layout,
                        const TileName& tile);

// Checks a GeoTIFF of heights: one band, all its blocks inside the file, elevation data as other commands
// open them under the name `name`, and is_in_place(its GDALDatasetH). Errors: what it is instead.
Result<void> check_elevation_raster(const std::string& file, const std::string& shown,
                                    const std::string& name,
                                    const std::function<bool(void* dataset)>& is_in_place);

}  // namespace oro
