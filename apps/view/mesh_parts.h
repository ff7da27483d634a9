// Whether a view shows of what parts the meshes on its region are drawn.
#pragma once

#include "apps/view/view.h"
#include "geo/region/region.h"

namespace oro {

// Whether a view asks that the meshes on the region are drawn by clusters: --mesh clusters, --mesh-level, or
// --show of what clusters alone have.
bool asks_for_mesh_clusters(const Region& region, const View& view);
// Puts into view.shows_mesh_parts whether it shows these meshes' clusters, groups or levels; view.mesh is
// then "clusters". To be asked again where the view or its region has changed, and before load_style().
void settle_mesh_parts(const Region& region, View& view);

}  // namespace oro
