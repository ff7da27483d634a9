#include "apps/drawing/mesh_cut.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "apps/drawing/mesh_choice.h"
#include "apps/report/figures.h"
#include "apps/view/mesh_parts.h"
#include "core/base/elapsed.h"
#include "core/base/parallel.h"
#include "core/streamed_mesh/streamed_mesh.h"
#include "geo/together/graph_memory.h"

namespace oro {

Result<bool> draws_mesh_clusters(const Region& region, const View& view) {
    if (!asks_for_mesh_clusters(region, view)) return false;
    const char* const asks = view.mesh_level           ? "--mesh-level"
                             : view.mesh == "clusters" ? "--mesh clusters"
                                                       : "--show";
    if (view.map) return Error{ErrorKind::usage, asks, "is not for maps of a region with meshes"};
    if (view.model.earth != Earth::ellipsoid)
        return Error{ErrorKind::usage, asks, "clusters are drawn on the ellipsoid"};
    return true;
}

Result<bool> draws_terrain_clusters(const Region& region, View& view) {
    ORO_TRY(const bool of_meshes, draws_mesh_clusters(region, view));
    if (!of_meshes) return draws_clusters(region, view);
    view.mesh = "clusters";
    return false;
}

// One that was baked may have more triangles than are drawn at once.
static Result<void> check_drawn_whole(const PlacedMesh& mesh) {
    const std::size_t most = MeshRequest().most_triangles;
    const std::size_t triangles =
        mesh.streamed() ? mesh.streamed()->records().triangles : mesh.triangles.size();
    if (triangles <= most) return {};
    return Error{ErrorKind::usage, mesh.path,
                 "has " + counted(triangles, "triangle", "triangles") + ", and " +
                     counted(most, "triangle", "triangles") +
                     " are drawn at once: --mesh clusters draws as many as the picture needs"};
}

Result<std::shared_ptr<const MeshDetail>> mesh_detail_of(const Region& region, const View& view) {
    ORO_TRY(const bool draws, draws_mesh_clusters(region, view));
    if (!draws) {
        if (region.meshes)
            for (const PlacedMesh& mesh : *region.meshes) ORO_CHECK(check_drawn_whole(mesh));
        return std::shared_ptr<const MeshDetail>();
    }
    for (const PlacedMesh& mesh : *region.meshes)
        if (!mesh.stored() && !mesh.streamed())
            ORO_CHECK(check_graph_memory(mesh.path, mesh.triangles.size()));
    ORO_TRY(MeshDetail detail, MeshDetail::open(region, view.exaggeration, thread_count()));
    return std::make_shared<const MeshDetail>(std::move(detail));
}

static MeshParts shown_parts(const std::optional<Show>& show) {
    if (show == Show::clusters) return MeshParts::clusters;
    if (show == Show::groups) return MeshParts::groups;
    return show == Show::levels ? MeshParts::levels : MeshParts::none;
}

MeshAsked mesh_asked_by(const View& view, const MemoryOptions& memory) {
    // Of a triangle on the GPU: what it is drawn from (core/seam/mesh_pages.h), at most so many of houses,
    // and what casts its shadow (core/seam/mesh_casters.h).
    constexpr std::uint64_t bytes_a_triangle = 100;
    MeshAsked asked{view.tau_px, view.model.air, {}, shown_parts(view.show)};
    if (memory.gpu_memory_mb)
        asked.most_triangles =
            static_cast<std::uint64_t>(*memory.gpu_memory_mb) * 1'000'000 / 2 / bytes_a_triangle;
    constexpr std::uint64_t usual_memory_mb = 64;
    asked.held_bytes = static_cast<std::uint64_t>(memory.memory_mb.value_or(usual_memory_mb)) * 1'000'000 / 2;
    if (view.mesh_level) asked.level = static_cast<std::uint32_t>(*view.mesh_level);
    return asked;
}

Result<MeshCut> mesh_cut_of(const MeshDetail& detail, const MeshAsked& asked, std::span<const Camera> cameras,
                            const MeshCut* before) {
    constexpr double least_px = 0.05, largest_px = 1.0e6;
    detail.hold_at_most(asked.held_bytes);
    for (double tau_px = asked.tau_px;; tau_px = std::max(1.5 * tau_px, least_px)) {
        MeshCut chosen = detail.chosen(cameras, tau_px, asked.air, asked.level);
        const bool fits = asked.most_triangles == 0 || chosen.triangles <= asked.most_triangles;
        if (fits || asked.level || tau_px > largest_px)
            return detail.with_meshes(std::move(chosen), before, asked.parts);
    }
}

Result<std::optional<DrawnMeshes>> drawn_meshes(const Region& region, const View& view,
                                                const MemoryOptions& memory) {
    const auto start = Clock::now();
    ORO_TRY(const std::shared_ptr<const MeshDetail> detail, mesh_detail_of(region, view));
    if (!detail) return std::optional<DrawnMeshes>();
    DrawnMeshes drawn;
    drawn.graph_s = seconds_since(start);
    drawn.built = detail->built();
    ORO_TRY(drawn.cut, mesh_cut_of(*detail, mesh_asked_by(view, memory), std::span(&view.camera, 1)));
    drawn.is_coarser = !view.mesh_level && drawn.cut.error_px > view.tau_px;
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
    if (meshes.is_coarser) words += "; coarser than --tau asks, as half of --gpu-memory holds no more";
    if (meshes.built == 0) return words + "; graph of the file";
    std::snprintf(text, sizeof text, "; graph built in %.1f s", meshes.graph_s);
    return words + text;
}

}  // namespace oro
