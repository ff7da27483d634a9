#include "core/cluster_frame/shown_clusters.h"

#include <algorithm>
#include <utility>

namespace oro {

ShownClusters shown_clusters(std::span<const gpu::DrawnCluster> drawn, std::span<const gpu::uint> states) {
    ShownClusters shown;
    shown.reserve(drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i)
        if ((states[i] & gpu::cluster_kept) != 0)
            shown[drawn[i].number] = (states[i] & gpu::cluster_shows) != 0;
    return shown;
}

std::vector<std::uint32_t> hidden_groups(std::span<const gpu::DrawnCluster> drawn,
                                         const ShownClusters& shown) {
    // Of each group first those of its clusters that show.
    std::vector<std::pair<std::uint32_t, bool>> hides;
    hides.reserve(drawn.size());
    for (const gpu::DrawnCluster& cluster : drawn)
        if (const auto known = shown.find(cluster.number); known != shown.end())
            hides.emplace_back(cluster.group, !known->second);
    std::ranges::sort(hides);
    std::vector<std::uint32_t> hidden;
    for (std::size_t i = 0; i < hides.size(); ++i)
        if ((i == 0 || hides[i - 1].first != hides[i].first) && hides[i].second)
            hidden.push_back(hides[i].first);
    return hidden;
}

}  // namespace oro
