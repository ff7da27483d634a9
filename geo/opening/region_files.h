// The first step to a region: which files there are.
#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"
#include "geo/files/source_paths.h"
#include "geo/sources/region_request.h"

namespace oro {

// What the paths of a request lead to: files that may hold elevation, or one baked region.
struct RegionFiles {
    std::vector<SourcePath> sources;  // none where `baked` is given
    std::string baked;                // the path of a baked region; "" where sources are read
};

// This searches the paths of a request. It opens no file but archives, and the first bytes of what might be
// baked. Errors: no path was given (no_data); those of find_sources().
[[nodiscard]] Result<RegionFiles> find_files(const RegionRequest& request);

// This gives an error that says that a folder holds no elevation data, and says that it holds meshes where it
// does. Other errors stay as they are.
[[nodiscard]] Error with_meshes_of_folder(Error error);

}  // namespace oro
