// The clusters of one frame, ready for the GPU.
#pragma once

#include <cstddef>
#include <vector>

#include "shaders/shared.h"

namespace oro {

struct ClusterPlan {
    bool on{};  // clusters are drawn, and no nodes of pages: these are for shading alone
    std::vector<gpu::DrawnCluster> drawn;  // the processor's cut, then what is coarser and there
    std::size_t in_cut{};                  // of these: those of the cut
    std::vector<gpu::ClusterBox> boxes;    // of each
    std::vector<gpu::AskedGroup> asked;    // DrawnCluster::made_by
    // Groups and clusters that the cut lacks; where there are any, coarser clusters stand in for them, and
    // the picture still has no cracks.
    std::size_t missing{};
    std::size_t without_room{};  // of those: clusters that the GPU may not hold beside the others
    std::size_t groups_opened{};
    std::size_t beyond_frustum{};
    std::size_t beyond_horizon{};
};

}  // namespace oro
