#include "apps/drawing/mesh_cut.h"

#include <cmath>
#include <cstdio>

#include "apps/report/figures.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"

namespace oro {

Result<bool> draws_mesh_clusters(const Region& region, const View& view) {
    if (!region.meshes || view.show == Show::clusters || view.show == Show::groups) return false;
    if (view.mesh != "clusters" && !view.mesh_level) return false;
    const char* const asks = view.mesh_level ? "--mesh-level" : "--mesh clusters";
    if (view.map) return Error{ErrorKind::usage, asks, "is not for maps of a region with meshes"};
    if (view.model.earth != Earth::ellipsoid)
        return Error{ErrorKind::usage, asks, "clusters are drawn on the ellipsoid"};
    return true;
}

Result<std::optional<DrawnMeshes>> drawn_meshes(const Region& region, const View& view) {
    ORO_TRY(const bool draws, draws_mesh_clusters(region, view));
    if (!draws) return std::optional<DrawnMeshes>();
    const auto start = Clock::now();
    const MeshDetail detail = MeshDetail::of(region, view.exaggeration, thread_count());
    DrawnMeshes drawn;
    drawn.graph_s = seconds_since(start);
    std::optional<std::uint32_t> level;
    if (view.mesh_level) level = static_cast<std::uint32_t>(*view.mesh_level);
    drawn.cut = detail.cut(view.camera, view.tau_px, view.model.air, level);
    return std::optional(std::move(drawn));
}

std::string words_of(const DrawnMeshes& meshes) {
    char text[200];
    std::snprintf(text, sizeof text, "meshes: %s of %s triangles, within %.3g m",
                  grouped(meshes.cut.triangles).c_str(), grouped(meshes.cut.of_triangles).c_str(),
                  meshes.cut.error_m);
    std::string words = text;
    if (std::isfinite(meshes.cut.error_px)) {
        std::snprintf(text, sizeof text, " (%.3g px)", meshes.cut.error_px);
        words += text;
    }
    std::snprintf(text, sizeof text, "; graph built in %.1f s", meshes.graph_s);
    return words + text;
}

}  // namespace oro
