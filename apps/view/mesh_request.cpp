#include "apps/view/mesh_request.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "apps/command_line/refusals.h"
#include "apps/options/option_table.h"
#include "apps/options/view_limits.h"
#include "geo/meshes/mesh_file.h"
#include "geo/meshes/mesh_look.h"

namespace oro {

std::vector<std::string> terrain_paths(const RegionOptions& options) {
    std::vector<std::string> paths;
    std::ranges::remove_copy_if(options.paths, std::back_inserter(paths), is_mesh_file);
    return paths;
}

std::vector<std::string> mesh_files_of(const RegionOptions& options) {
    std::vector<std::string> files = options.mesh_files;
    std::ranges::copy_if(options.paths, std::back_inserter(files), is_mesh_file);
    return files;
}

bool is_no_lod(const std::string& lod) {
    return lod.size() > 4 || lod.find_first_not_of("0123456789.") != std::string::npos ||
           lod.starts_with('.') || lod.ends_with('.') || std::ranges::count(lod, '.') > 1;
}

Result<MeshRequest> mesh_request(const RegionOptions& options) {
    MeshRequest meshes{mesh_files_of(options),  options.mesh_crs,      options.mesh_unit, options.mesh_lod,
                       options.building_height, options.building_base, options.mesh_look, options.cut_under};
    if (options.crease_deg) {
        ORO_TRY(meshes.crease_deg, within("--crease", *options.crease_deg, view_limits::crease_deg));
    }
    const std::array<std::pair<const char*, const std::string*>, 6> given{
        {{"--mesh-crs", &meshes.crs},
         {"--mesh-unit", &meshes.unit},
         {"--lod", &meshes.lod},
         {"--building-height", &meshes.building_height},
         {"--building-base", &meshes.building_base},
         {"--mesh-look", &meshes.look}}};
    for (const auto& [option, value] : given)
        if (meshes.files.empty() && !value->empty())
            return refused(option, "", "says nothing without --mesh-file FILE");
    if (meshes.files.empty() && meshes.cut_under)
        return refused("--cut-under", "", "says nothing without --mesh-file FILE");
    if (meshes.files.empty() && meshes.crease_deg)
        return refused("--crease", "", "says nothing without --mesh-file FILE");
    if (meshes.building_height.empty() && !meshes.building_base.empty())
        return refused("--building-base", "", "says nothing without --building-height FIELD");
    if (!meshes.look.empty() && !is_mesh_look(meshes.look))
        return refused("--mesh-look", meshes.look, "is none of ground, built, plain");
    if (is_no_lod(meshes.lod)) return refused("--lod", meshes.lod, "is no level of detail: 1, 2, 2.2, say");
    return meshes;
}

}  // namespace oro
