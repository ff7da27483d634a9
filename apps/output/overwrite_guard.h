// --overwrite is for what the program writes: what it reads is never replaced by it.
#pragma once

#include <string>
#include <vector>

#include "apps/view/view.h"
#include "geo/region/region.h"

namespace oro {

// Files that a command reads, now or later, and what a message says that they are.
struct FilesToSpare {
    std::vector<std::string> files;
    std::string what_they_are;  // "which the elevation data are in"
};

// All that a picture is made from: the style, and the files that a view's elevation data, images, names and
// lines are made of (archives, all that a VRT names, side-cars, world files).
FilesToSpare files_of_picture(const View& view, const Region& region);
// The files of elevation data alone: `paths` as they were given.
FilesToSpare files_of_ground(const std::vector<std::string>& paths, const Region& region);
// A view that is only read, the picture it is in, and the ones it may lie beside.
FilesToSpare files_of_view(const std::string& view_file);

// For every command, before it takes time: that a file can be written where it shall be, and is not there yet
// unless `overwrite` says that it may be replaced. Errors: usage for a name that is none; failed for a file
// that is there, and for one that cannot be written.
Result<void> check_may_write(const std::string& file, bool overwrite);
// ... and once it is known what the command reads: that none of the files it will write, side outputs among
// them, is one of `inputs` or one that it has read so far (core/base/files_read.h; what it reads later is
// asked about when a file gets its name). A message begins with `option`, which names them. Files are told by
// themselves and not by their names: links of both kinds are seen through. Errors: usage; failed where the
// system cannot tell.
Result<void> spare_inputs(const std::vector<std::string>& written, const std::vector<FilesToSpare>& inputs,
                          const std::string& option = "--out");

}  // namespace oro
