// --overwrite is for what the program writes: what a picture is made from is never replaced by it.
#pragma once

#include <string>
#include <vector>

#include "apps/view/view.h"
#include "geo/region/region.h"

namespace oro {

// All four tell files by themselves and not by their names: links of both kinds are seen through.

// Errors (usage): a file to be written is one of `inputs`, of which the message says `what_they_are`.
Result<void> spare_files(const std::vector<std::string>& written, const std::vector<std::string>& inputs,
                         const std::string& what_they_are);
// Errors (usage): a file to be written is the style or one of the files that the elevation data of a view are
// made of: archives, all that a VRT names, side-cars.
Result<void> spare_inputs(const std::vector<std::string>& written, const View& view, const Region& region);
// The same of elevation data alone: `paths` as they were given.
Result<void> spare_ground(const std::vector<std::string>& written, const std::vector<std::string>& paths,
                          const Region& region);
// Errors (usage): a file to be written is a view that is only read, the picture it is in, or the one it lies
// beside.
Result<void> spare_view(const std::vector<std::string>& written, const std::string& view_file);

}  // namespace oro
