#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/commands/info_mesh.h"
#include "apps/commands/mesh_levels.h"
#include "apps/report/figures.h"
#include "apps/report/json_object.h"
#include "core/base/parallel.h"
#include "core/mesh_file/mesh_check.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/together/mesh_ground.h"

namespace oro {

std::string baked_meshes_text(const Region& region) {
    std::string text;
    if (!region.meshes) return text;
    for (const PlacedMesh& mesh : *region.meshes) {
        if (!mesh.stored()) continue;
        text += "mesh:        " + one_line(mesh.path) + ", " + one_line(mesh.format) + ", " +
                counted(mesh.triangles.size(), "triangle", "triangles") + ", " +
                counted(mesh.vertices.size(), "vertex", "vertices");
        if (!mesh.features.empty()) text += ", " + counted(mesh.features.size(), "feature", "features");
        text += "\n" + mesh_levels_text(mesh.stored()->graph, 13);
    }
    return text;
}

nlohmann::ordered_json baked_meshes_json(const Region& region) {
    nlohmann::ordered_json meshes = nlohmann::ordered_json::array();
    if (!region.meshes) return meshes;
    for (const PlacedMesh& mesh : *region.meshes) {
        if (!mesh.stored()) continue;
        meshes.push_back(json_object("name", mesh.path, "format", mesh.format, "crs", mesh.crs, "triangles",
                                     mesh.triangles.size(), "vertices", mesh.vertices.size(), "features",
                                     mesh.features.size(), "levels", mesh_levels_json(mesh.stored()->graph)));
    }
    return meshes;
}

Result<void> check_baked_meshes(const Region& region) {
    if (!region.meshes) return {};
    for (const PlacedMesh& mesh : *region.meshes) {
        if (!mesh.stored()) continue;
        MeshGround ground;
        if (mesh.stored()->ground_fingerprint != 0) {
            ground = ground_below_parts(*mesh.stored(), region, 1.0);
            if (fingerprint_of(ground, mesh.stored()->origin_ecef_m()) != mesh.stored()->ground_fingerprint)
                return Error{ErrorKind::failed, mesh.path,
                             "its levels were made over other ground than the file has"};
        }
        if (const auto wrong = understated_error(*mesh.stored(), thread_count(), &ground))
            return Error{ErrorKind::failed, mesh.path, "the mesh " + *wrong};
    }
    const RegionGrid& grid = region.grids.front();
    if (!grid.file) return {};
    ORO_TRY(const std::shared_ptr<const Container> container, Container::open(grid.file->path()));
    std::uint32_t number = 0;
    for (const PlacedMesh& mesh : *region.meshes)
        if (mesh.stored()) ORO_CHECK(check_streamed_mesh(*container, number++, mesh, region));
    return {};
}

}  // namespace oro
