// Whether a view's meshes are drawn at the detail that it needs, and what that is.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "apps/options/options.h"
#include "apps/view/view.h"
#include "geo/region/region.h"
#include "geo/together/mesh_detail.h"

namespace oro {

// What is drawn in the place of a view's meshes, and what choosing it took.
struct DrawnMeshes {
    MeshCut cut;
    double graph_s{};     // building the graphs
    std::size_t built{};  // of them; the others lie in a baked file
    bool is_coarser{};    // than the view asks: more would not fit into --gpu-memory
};

// True where meshes lie on the region and the view asks for clusters of them; the terrain is then drawn by
// blocks. Errors: the view asks, and is a map, or not drawn on the ellipsoid.
Result<bool> draws_mesh_clusters(const Region& region, const View& view);

// Whether the view's clusters are those of the terrain (draws_clusters()): false, and its mesh stays
// "clusters", where draws_mesh_clusters(). Errors: as both.
Result<bool> draws_terrain_clusters(const Region& region, View& view);

// The graphs of the region's meshes; null where draws_mesh_clusters() says no. Errors: as it, and
// check_graph_memory() of meshes that are not baked.
Result<std::shared_ptr<const MeshDetail>> mesh_detail_of(const Region& region, const View& view);
// What a view asks of its meshes, beside its camera.
struct MeshAsked {
    double tau_px{};
    Air air{};
    std::optional<std::uint32_t> level{};  // --mesh-level
    MeshParts parts{};                     // --show
    std::uint64_t most_triangles{};        // that half of --gpu-memory holds; 0: any number
    std::uint64_t held_bytes{};            // half of --memory: of groups that were read
};
MeshAsked mesh_asked_by(const View& view, const MemoryOptions& memory);
// What a view with that camera, or several, shows of them. Where it needs more triangles than there is memory
// for, its tau is half as large again until they fit, unless it asks for a level. before: as
// MeshDetail::cut(). Errors: as that.
Result<MeshCut> mesh_cut_of(const MeshDetail& detail, const MeshAsked& asked, std::span<const Camera> cameras,
                            const MeshCut* before = nullptr);

// Builds the graphs of the region's meshes and chooses from them, on all threads of the machine; nothing
// where draws_mesh_clusters() says no. Errors: as it.
Result<std::optional<DrawnMeshes>> drawn_meshes(const Region& region, const View& view,
                                                const MemoryOptions& memory);

// "meshes: 5,140 of 174,899 triangles, within 0.31 m (0.98 px); graph built in 3.2 s".
std::string words_of(const DrawnMeshes& meshes);

}  // namespace oro
