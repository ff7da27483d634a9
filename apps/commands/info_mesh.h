// orograph info of files of triangle meshes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "apps/commands/options.h"
#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// Whether there are paths, and all are files of meshes (is_mesh_file()), or GeoPackages of surfaces.
bool names_meshes(const std::vector<std::string>& paths);

// Prints what each mesh holds, in its own coordinates: as text, or with options.json as one JSON object. With
// options.check its cluster graph is built, and told level by level. Errors: coordinates in degrees, with
// options.check; an option of elevation data is given (usage); the first mesh that cannot be read.
Result<void> run_mesh_info(const InfoOptions& options);

// The same, and where it lies, of each mesh on the ground of a region that is in no baked file. Of footprints
// there is less: how many triangles and features, and where. Errors: one that cannot be read again.
Result<nlohmann::ordered_json> meshes_on_ground_json(const Region& region, const RegionOptions& options);
// The same of the meshes in a baked region (Region::meshes), which have their graphs.
std::string baked_meshes_text(const Region& region);
nlohmann::ordered_json baked_meshes_json(const Region& region);
// Measures the errors of their graphs again. Errors: one that is no bound.
Result<void> check_baked_meshes(const Region& region);

}  // namespace oro
