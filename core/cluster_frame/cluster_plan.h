// The clusters of one frame, ready for the GPU.
#pragma once

#include <cstddef>
#include <vector>

#include "shaders/shared.h"

namespace oro {

struct ClusterPlan {
    bool on{};  // clusters are drawn, and no nodes of pages: these are for shading alone
    std::vector<gpu::DrawnCluster> drawn;
    std::size_t groups_opened{};
    std::size_t beyond_frustum{};
    std::size_t beyond_horizon{};
};

}  // namespace oro
