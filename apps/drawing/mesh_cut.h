// Whether a view's meshes are drawn at the detail that it needs, and what that is.
#pragma once

#include <optional>
#include <string>

#include "apps/view/view.h"
#include "geo/region/region.h"
#include "geo/together/mesh_detail.h"

namespace oro {

// What is drawn in the place of a view's meshes, and what choosing it took.
struct DrawnMeshes {
    MeshCut cut;
    double graph_s{};  // building the graphs
};

// True where meshes lie on the region and the view asks for clusters (--mesh clusters, --mesh-level); the
// terrain is then drawn by blocks. Errors: the view asks, and is a map, or not drawn on the ellipsoid.
Result<bool> draws_mesh_clusters(const Region& region, const View& view);

// Builds the graphs of the region's meshes and chooses from them, on all threads of the machine; nothing
// where draws_mesh_clusters() says no. Errors: as it.
Result<std::optional<DrawnMeshes>> drawn_meshes(const Region& region, const View& view);

// "meshes: 5,140 of 174,899 triangles, within 0.31 m (0.98 px); graph built in 3.2 s".
std::string words_of(const DrawnMeshes& meshes);

}  // namespace oro
