#include "geo/opening/region_files.h"

#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "geo/meshes/mesh_file.h"
#include "geo/opening/baked_region.h"

namespace oro {

Result<RegionFiles> find_files(const RegionRequest& request) {
    RegionFiles found;
    if (request.paths.empty()) return Error{ErrorKind::no_data, "", "no path to elevation data was given"};
    if (const std::optional<std::string> baked = baked_path(request.paths)) {
        found.baked = *baked;
        return found;
    }
    Result<std::vector<SourcePath>> sources = find_sources(request.paths);
    if (!sources) return with_meshes_of_folder(sources.error());
    found.sources = std::move(*sources);
    return found;
}

Error with_meshes_of_folder(Error error) {
    namespace fs = std::filesystem;
    std::error_code fault;
    if (error.kind != ErrorKind::no_data || !fs::is_directory(error.where, fault)) return error;
    std::string first;
    std::size_t count = 0;
    for (fs::recursive_directory_iterator place(error.where, fault), end; !fault && place != end;
         place.increment(fault)) {
        const std::string path = place->path().string();
        if (!is_mesh_file(path)) continue;
        ++count;
        if (first.empty() || path < first) first = path;
    }
    if (count > 0)
        error.what = "no elevation data under this folder, but " +
                     (count == 1 ? std::string("a mesh") : std::to_string(count) + " meshes") +
                     ": name them one by one, with --mesh-file " + first;
    return error;
}

}  // namespace oro
