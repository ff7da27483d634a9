#include "core/clusters/cluster_cut.h"

#include <algorithm>

#include "core/lod/levels.h"
#include "core/lod/levels_gpu.h"

namespace oro {

std::vector<std::uint32_t> cut_of(const ClusterGraph& graph, const std::vector<char>& stands) {
    std::vector<std::uint32_t> cut;
    for (std::uint32_t i = 0; i < graph.clusters.size(); ++i) {
        const Cluster& cluster = graph.clusters[i];
        if (cluster.made_by != no_group && stands[cluster.made_by] == 0) continue;
        if (cluster.used_by != no_group && stands[cluster.used_by] != 0) continue;
        cut.push_back(i);
    }
    return cut;
}

std::vector<std::uint32_t> cut_by_metres(const ClusterGraph& graph, double error_m) {
    std::vector<char> stands(graph.groups.size());
    std::transform(graph.groups.begin(), graph.groups.end(), stands.begin(),
                   [&](const ClusterGroup& group) { return group.error_m <= error_m ? 1 : 0; });
    return cut_of(graph, stands);
}

std::vector<std::uint32_t> cut_by_pixels(const ClusterGraph& graph, const Camera& camera, double tau_px) {
    const LevelView view = level_view(camera, tau_px);
    const glm::dmat3 view_from_ecef = camera.view_from_ecef();
    const Ecef eye = camera.eye_ecef();
    std::vector<char> stands(graph.groups.size());
    for (std::size_t i = 0; i < stands.size(); ++i) {
        const ClusterGroup& group = graph.groups[i];
        const glm::dvec3 centre_view = view_from_ecef * (group.centre.m - eye.m);
        stands[i] = gpu::projected_error_px(gpu::vec3(centre_view), static_cast<float>(group.radius_m),
                                            static_cast<float>(group.error_m), view.pixels_per_tangent,
                                            view.corner_tangent) <= view.tau_px
                        ? 1
                        : 0;
    }
    // Roundings to float may let a group stand above one that does not: then it does not either.
    for (const ClusterGroup& group : graph.groups) {
        char& here = stands[static_cast<std::size_t>(&group - graph.groups.data())];
        for (const std::uint32_t member : graph.members_of(group)) {
            const std::uint32_t below = graph.clusters[member].made_by;
            if (below != no_group && stands[below] == 0) here = 0;
        }
    }
    return cut_of(graph, stands);
}

std::size_t triangles_of_cut(const ClusterGraph& graph, const std::vector<std::uint32_t>& cut) {
    std::size_t triangles = 0;
    for (const std::uint32_t cluster : cut) triangles += graph.clusters[cluster].triangles;
    return triangles;
}

}  // namespace oro
