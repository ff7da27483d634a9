#include "apps/view/mesh_parts.h"

namespace oro {

bool asks_for_mesh_clusters(const Region& region, const View& view) {
    if (!region.meshes) return false;
    return view.mesh == "clusters" || view.mesh_level || (is_of_clusters(view.show) && view.mesh != "grid");
}

void settle_mesh_parts(const Region& region, View& view) {
    view.shows_mesh_parts =
        (is_of_clusters(view.show) || view.show == Show::levels) && asks_for_mesh_clusters(region, view);
    if (view.shows_mesh_parts) view.mesh = "clusters";
}

}  // namespace oro
