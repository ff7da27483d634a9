#include "geo/opening/region_files.h"

#include <optional>

#include "geo/opening/baked_region.h"

namespace oro {

Result<RegionFiles> find_files(const RegionRequest& request) {
    RegionFiles found;
    if (request.paths.empty()) return Error{ErrorKind::no_data, "", "no path to elevation data was given"};
    if (const std::optional<std::string> baked = baked_path(request.paths)) {
        found.baked = *baked;
        return found;
    }
    ORO_TRY(found.sources, find_sources(request.paths));
    return found;
}

}  // namespace oro
