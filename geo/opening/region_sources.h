// The second step to a region: what the headers of its files say.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/baked/baked_file.h"
#include "core/base/progress.h"
#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/opening/region_files.h"
#include "geo/sources/hgt_source.h"
#include "geo/sources/raster_source.h"
#include "geo/sources/region_request.h"
#include "geo/sources/source.h"

namespace oro {

struct RegionSources {
    std::vector<Source> sources;        // of the files that hold elevation
    std::vector<std::size_t> named_by;  // of each, the number of its path (SourcePath::path)
    std::vector<std::string> notes;     // what was passed over, and what is doubtful, one line each
    std::string first_skipped;          // the first file that holds no elevation, and why; "" where each does
    std::vector<BakedGrid> baked;       // of a baked region, which has no sources
};

// How a note begins that tells of a file without elevation.
inline constexpr const char* passed_over = "passed over ";

// Looks at one file's name, size and header. Errors: a file that is damaged.
Result<Finding> probe_file(const SourcePath& path, const SourceOverrides& overrides);
// A whole-degree cell as a source, with its bounds alone.
Source source_of_cell(const TileName& cell);

// Looks at names, sizes and headers of the files that were found. What the user named must open; in folders
// and archives, rasters that are no elevation are passed over and noted, but a damaged file is an error
// wherever it lies (a hole in the terrain is no way to hear of it). What belongs to elevation data and is
// none (companions.h) is left out with one note, whoever named it, and refused where nothing else is there.
// With a box, tiles that by their names lie elsewhere are not opened. Of a baked region its grids are opened.
// Errors: those of each file; an option that was decided when a region was baked (usage).
Result<RegionSources> probe_files(const RegionFiles& files, const RegionRequest& request,
                                  const Progress& progress);

// Whole-degree cells that the region touches and no source does. Names as N45E008.
std::vector<std::string> cells_without(std::span<const Source> sources, const PostGrid& grid);

}  // namespace oro
