#include "apps/drawing/mesh_choice.h"

#include "apps/view/model_names.h"

namespace oro {
namespace {

// Why there are none; "" where there are some.
std::string without_clusters(const Region& region, const View& view) {
    if (region.grids.size() > 1) return "the region has several grids, and clusters are of one";
    if (region.meshes)
        return "a mesh lies on the region (--mesh-file), and clusters of the ground are drawn alone";
    const RegionGrid& grid = region.grids.front();
    if (!grid.file || !grid.clusters)
        return "the region has no clusters: bake it with --mesh clusters, and draw the whole .oro file";
    if (view.exaggeration != 1.0) return "clusters are of heights without exaggeration";
    if (view.model.earth != Earth::ellipsoid) return "clusters are drawn on the ellipsoid";
    if (view.show == Show::overdraw)
        return "--show " + std::string(name_in(show_names, *view.show)) + " tells of blocks, not of clusters";
    if (grid.field.undulation.N_m.size() != grid.file->outline().undulation.N_m.size())
        return "clusters are of heights with the geoid";
    return "";
}

// What asks for clusters, and for nothing else; "": nothing does.
std::string asks_for_clusters(const View& view) {
    if (view.mesh_level) return "--mesh-level";
    if (is_of_clusters(view.show)) return "--show " + std::string(name_in(show_names, *view.show));
    return view.mesh == "clusters" ? "--mesh clusters" : "";
}

}  // namespace

bool has_clusters(const Region& region, const View& view) {
    View plain = view;
    plain.show.reset();
    return without_clusters(region, plain).empty();
}

Result<bool> draws_clusters(const Region& region, View& view) {
    const std::string why_not = without_clusters(region, view);
    if (const std::string asks = asks_for_clusters(view); !asks.empty()) {
        if (!why_not.empty())
            return Error{ErrorKind::usage, asks,
                         why_not + (view.mesh_level || view.show ? "" : "; --mesh grid draws it by blocks")};
        if (view.mesh == "grid")
            return Error{ErrorKind::usage, asks, "is of clusters, and --mesh grid draws blocks"};
    }
    const bool clusters = why_not.empty() && view.mesh != "grid";
    view.mesh = clusters ? "clusters" : "auto";
    return clusters;
}

}  // namespace oro
