#include "apps/baking/mesh_bake.h"

#include <unistd.h>

#include <cstdio>

#include "apps/report/figures.h"
#include "core/base/parallel.h"
#include "geo/meshes/placed_mesh.h"
#include "geo/together/baked_parts.h"

namespace oro {

MeshBake::~MeshBake() {
    // What is not there has been joined.
    for (const ContainerPart& part : parts) unlink(part.path.c_str());
}

Result<MeshBake> bake_meshes(const Region& region, const std::string& out) {
    MeshBake bake;
    if (!region.meshes) return bake;
    for (const PlacedMesh& mesh : *region.meshes) {
        const std::size_t number = bake.parts.size();
        const std::string path = path_of_mesh(out, number);
        ORO_CHECK(check_path_of_part(path));
        bake.parts.push_back({path, static_cast<std::uint32_t>(number)});
        ORO_TRY(const BakedMeshReport report,
                write_baked_mesh(path, mesh, region.grids.front().field.undulation, thread_count(), &region));
        bake.reports.push_back(report);
    }
    return bake;
}

std::string words_of(const std::string& name, const BakedMeshReport& report) {
    char text[160];
    std::snprintf(text, sizeof text, ", %.2f bytes a triangle, graph built in %.1f s",
                  static_cast<double>(report.bytes) / static_cast<double>(report.triangles), report.build_s);
    return "with " + name + ": " + counted(report.triangles, "triangle", "triangles") + ", " +
           counted(report.levels, "level", "levels") + " above them" + text;
}

}  // namespace oro
