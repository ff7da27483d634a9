#include "core/cluster_frame/shown_clusters.h"

#include <map>

namespace oro {

ShownClusters shown_clusters(std::span<const gpu::DrawnCluster> drawn, std::span<const gpu::uint> states) {
    ShownClusters shown;
    for (std::size_t i = 0; i < drawn.size(); ++i)
        if ((states[i] & gpu::cluster_kept) != 0)
            shown[drawn[i].number] = (states[i] & gpu::cluster_shows) != 0;
    return shown;
}

std::vector<std::uint32_t> hidden_groups(std::span<const gpu::DrawnCluster> drawn,
                                         const ShownClusters& shown) {
    std::map<std::uint32_t, bool> shows;
    for (const gpu::DrawnCluster& cluster : drawn)
        if (const auto known = shown.find(cluster.number); known != shown.end())
            shows[cluster.group] |= known->second;
    std::vector<std::uint32_t> hidden;
    for (const auto& [group, any] : shows)
        if (!any) hidden.push_back(group);
    return hidden;
}

}  // namespace oro
