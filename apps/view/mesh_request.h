// Which meshes lie on a region's ground, by the command line.
#pragma once

#include <string>
#include <vector>

#include "apps/options/options.h"
#include "core/base/result.h"
#include "geo/sources/region_request.h"

namespace oro {

// PATHs of elevation data: those that are no meshes (is_mesh_file()).
std::vector<std::string> terrain_paths(const RegionOptions& options);
// The meshes of --mesh-file, then those among the PATHs.
std::vector<std::string> mesh_files_of(const RegionOptions& options);
// The meshes of --mesh-file, then those among the PATHs, and how they are read. Errors of usage: an option of
// meshes without any; --building-base without --building-height; a --lod that is no number from 0 to 10.
Result<MeshRequest> mesh_request(const RegionOptions& options);
// Whether a level of detail is none that CityJSON could have.
bool is_no_lod(const std::string& lod);

}  // namespace oro
