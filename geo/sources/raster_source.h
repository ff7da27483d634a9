// Elevation rasters that GDAL reads: GeoTIFF, COG, VRT and the rest.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/files/source_paths.h"
#include "geo/sources/length_unit.h"
#include "geo/sources/source.h"
#include "geo/sources/source_overrides.h"

namespace oro {

// A source, or the reason why a file is none although nothing is wrong with it.
struct Finding {
    std::optional<Source> source;
    Error unfit;  // without a source: several bands, a palette, no place, no CRS or an unknown one or unit
    std::vector<std::string> doubts;  // what a user must know, one line each
    // It belongs to data of heights, and holds something else than heights: left out beside others, refused
    // by itself.
    bool companion{};
};

// Looks at a raster's header and at the files that it is made of: where its posts lie and what its values
// mean. Errors: damage, in it or in what
// belongs to it; a file that names a network or a pipe, or takes more than the budget for opening
// (guarded_files.h, raster_parts.h); whatever it is, one that cannot be opened although its name or its first
// bytes are those of a trusted format.
Result<Finding> inspect_raster(const SourcePath& path, const SourceOverrides& overrides);

// Reads a window of its posts: no-data, masks, NaN and implausible heights become void.
Result<PostBlock> read_raster(const Source& source, const PostWindow& window);

}  // namespace oro
