#include "core/cluster_frame/cluster_cut.h"

#include <algorithm>

#include "core/cluster_frame/group_rule.h"

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

std::vector<std::uint32_t> cut_by_level(const ClusterGraph& graph, std::uint32_t level) {
    std::vector<char> stands(graph.groups.size());
    std::transform(graph.groups.begin(), graph.groups.end(), stands.begin(),
                   [&](const ClusterGroup& group) { return group.level <= level ? 1 : 0; });
    return cut_of(graph, stands);
}

std::vector<std::uint32_t> cut_by_pixels(const ClusterGraph& graph, const Camera& camera, double tau_px) {
    const GroupRule rule(camera, tau_px);
    std::vector<char> stands(graph.groups.size());
    std::transform(graph.groups.begin(), graph.groups.end(), stands.begin(),
                   [&](const ClusterGroup& group) { return rule.stands(group) ? 1 : 0; });
    return cut_of(graph, stands);
}

std::size_t triangles_of_cut(const ClusterGraph& graph, const std::vector<std::uint32_t>& cut) {
    std::size_t triangles = 0;
    for (const std::uint32_t cluster : cut) triangles += graph.clusters[cluster].triangles;
    return triangles;
}

}  // namespace oro
