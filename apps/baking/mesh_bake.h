// Meshes of a region on their way into its baked file.
#pragma once

#include <string>
#include <vector>

#include "core/base/container.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/together/baked_meshes.h"

namespace oro {

struct MeshBake {
    std::vector<ContainerPart> parts;  // files beside the one that is baked
    std::vector<BakedMeshReport> reports;
};

// Bakes each mesh of a region with its graph beside `out`; nothing where it has none. Errors: those of
// write_baked_mesh().
Result<MeshBake> bake_meshes(const Region& region, const std::string& out);

// "with zurich.city.json: 5,134 triangles, 12 levels, 3.1 bytes a triangle, graph built in 0.4 s".
std::string words_of(const std::string& name, const BakedMeshReport& report);

}  // namespace oro
