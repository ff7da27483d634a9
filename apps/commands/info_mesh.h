// orograph info of files of triangle meshes.
#pragma once

#include <string>
#include <vector>

#include "apps/commands/options.h"
#include "core/base/result.h"

namespace oro {

// Whether there are paths, and all are files of meshes (is_mesh_file()), or GeoPackages of surfaces.
bool names_meshes(const std::vector<std::string>& paths);

// Prints what each mesh holds, in its own coordinates: as text, or with options.json as one JSON object.
// Errors: an option of elevation data is given (usage); the first mesh that cannot be read.
Result<void> run_mesh_info(const InfoOptions& options);

}  // namespace oro
