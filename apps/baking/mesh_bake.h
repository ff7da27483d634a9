// Meshes of a region on their way into its baked file.
#pragma once

#include <string>
#include <vector>

#include "core/base/container.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/together/baked_meshes.h"

namespace oro {

// The files that meshes are baked to, beside the one that is baked. It removes what is left of them: a bake
// that is broken off does not go on with them.
struct MeshBake {
    MeshBake() = default;
    MeshBake(MeshBake&&) noexcept = default;
    MeshBake& operator=(MeshBake&&) = delete;
    MeshBake(const MeshBake&) = delete;
    MeshBake& operator=(const MeshBake&) = delete;
    ~MeshBake();

    std::vector<ContainerPart> parts;
    std::vector<BakedMeshReport> reports;
};

// Bakes each mesh of a region with its graph beside `out`, which the caller holds (BakeHold); nothing where
// it has none. Errors: those of write_baked_mesh(); somebody else's file of that name.
Result<MeshBake> bake_meshes(const Region& region, const std::string& out);

// "with zurich.city.json: 5,134 triangles, 12 levels, 3.1 bytes a triangle, graph built in 0.4 s".
std::string words_of(const std::string& name, const BakedMeshReport& report);

}  // namespace oro
