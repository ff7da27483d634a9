// Elevation rasters that GDAL reads: GeoTIFF, COG, VRT and the rest.
#pragma once

#include "core/result.h"
#include "geo/source.h"
#include "geo/source_paths.h"

namespace oro {

// Metres in a unit of height, by any of its usual names ("m", "ft", "us-ft", "cm", "US survey foot", ...);
// nothing for other words. Source: international foot 0.3048 m and US survey foot 1200/3937 m, NIST Special
// Publication 811, 2008, B.6.
std::optional<double> metres_in(const std::string& unit);

// Looks at a raster's header: where its posts lie and what its values mean. `height_unit` overrides what the
// file says when it is not empty. Errors: a file that GDAL cannot open, one that is no elevation (several
// bands, a palette), that states no place, no CRS or an unknown one, an unknown unit.
Result<Source> inspect_raster(const SourcePath& path, const std::string& height_unit);

// Reads a window of its posts: no-data, masks, NaN and implausible heights become void.
Result<PostBlock> read_raster(const Source& source, const PostWindow& window);

}  // namespace oro
