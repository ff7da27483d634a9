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
        const UndulationField& undulation = region.grids.front().field.undulation;
        std::optional<BakedMeshReport> report = mesh_baked_before(path, mesh, undulation, &region);
        if (!report) {
            ORO_TRY(report, write_baked_mesh(path, mesh, undulation, thread_count(), &region));
        }
        bake.reports.push_back(*report);
    }
    return bake;
}

std::string words_of(const std::string& name, const BakedMeshReport& report) {
    char text[160], built[60];
    if (report.was_there)
        std::snprintf(built, sizeof built, "of a bake that was broken off");
    else
        std::snprintf(built, sizeof built, "built in %.1f s", report.build_s);
    std::snprintf(
        text, sizeof text, ", %.2f bytes a triangle, graph ",
        static_cast<double>(report.bytes + report.group_bytes) / static_cast<double>(report.triangles));
    return "with " + name + ": " + counted(report.triangles, "triangle", "triangles") + ", " +
           counted(report.levels, "level", "levels") + " above them" + text + built;
}

}  // namespace oro
