#include "apps/drawing/mesh_choice.h"

#include "apps/view/model_names.h"

namespace oro {
namespace {

// Why there are none; "" where there are some.
std::string without_clusters(const Region& region, const View& view) {
    if (!region.beside.empty()) return "the region has several grids, and clusters are of one";
    if (!region.file || !region.clusters)
        return "the region has no clusters: bake it with --mesh clusters, and draw the whole .oro file";
    if (view.exaggeration != 1.0) return "clusters are of heights without exaggeration";
    if (view.model.earth != Earth::ellipsoid) return "clusters are drawn on the ellipsoid";
    if (view.show == Show::levels || view.show == Show::visible || view.show == Show::overdraw)
        return "--show " + std::string(name_of(*view.show)) + " tells of blocks, not of clusters";
    if (region.field.undulation.N_m.size() != region.file->outline().undulation.N_m.size())
        return "clusters are of heights with the geoid";
    return "";
}

}  // namespace

Result<bool> draws_clusters(const Region& region, View& view) {
    const std::string why_not = without_clusters(region, view);
    if (view.mesh == "clusters" && !why_not.empty())
        return Error{ErrorKind::usage, "--mesh clusters", why_not + "; --mesh grid draws it by blocks"};
    const bool clusters = why_not.empty() && view.mesh != "grid";
    view.mesh = clusters ? "clusters" : "auto";
    return clusters;
}

}  // namespace oro
