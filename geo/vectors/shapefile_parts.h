// The files that a shapefile is made of.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace oro {

struct ShapefileParts {
    std::vector<std::string> files;  // the .shp first, then those of .shx, .dbf, .prj and .cpg that are there
    std::vector<std::string> notes;  // what a user must know, one line each, with the file's name
};

// Finds what belongs to a .shp beside it, in small or in capital letters, and compares the lengths that these
// files tell with those that they have. `file` is one of this machine, or in GDAL's memory (memory_files.h),
// `shown` what notes call it. Errors (a reason, without the file's name): a .shx that is
// not there, or a .prj that is needed; a .shp, .shx or .dbf that is cut. Source: ESRI Shapefile Technical
// Description, July 1998.
Result<ShapefileParts> shapefile_parts(const std::string& file, const std::string& shown,
                                       bool needs_prj = true);

}  // namespace oro
