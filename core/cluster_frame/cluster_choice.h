// Which clusters a frame draws: the cut for tau, without what cannot be seen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/cluster_frame/cluster_view.h"
#include "core/cluster_frame/region_clusters.h"
#include "core/earth/camera.h"
#include "core/earth/world_model.h"

namespace oro {

struct ClusterChoice {
    std::vector<std::uint32_t> clusters;  // nearest first
    std::vector<std::uint32_t> groups;    // of each: that which made it; of a leaf, that which uses it
    std::size_t groups_opened{};          // those that do not stand, and may be seen
    std::size_t beyond_frustum{};         // groups and clusters of the cut,
    std::size_t beyond_horizon{};         // clusters
};

// The cut of GroupRule, found from the coarsest clusters down. A group that does not stand gives way to the
// clusters that it uses; where its sphere cannot be seen, nothing below it is looked at. So the cost is that
// of the groups above the cut, in view. Waits for all that it must read. Errors: damage.
Result<ClusterChoice> choose_clusters(RegionClusters& clusters, const ClusterView& view);
// Chooses the clusters of a view that is used once.
Result<ClusterChoice> choose_clusters(RegionClusters& clusters, const Camera& camera, const Tile& tile,
                                      double tau_px, const WorldModel& model, const HorizonOccluder& occluder,
                                      const HeightQuantization& coding,
                                      std::optional<std::uint32_t> level = {});

// The least number of steps (GroupRule::coarser) after which something holds that holds from some step on.
unsigned coarser_steps_until(const std::function<bool(unsigned steps)>& holds);

}  // namespace oro
