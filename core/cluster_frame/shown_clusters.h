// Which clusters a frame has shown, and which other ground hid. It decides what comes first and what gives
// way, nothing of what is drawn.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "shaders/shared.h"

namespace oro {

// Of clusters that a frame in rounds drew: whether they show. Of others it tells nothing.
using ShownClusters = std::unordered_map<std::uint32_t, bool>;

// states: gpu::cluster_... of each, after the last round.
ShownClusters shown_clusters(std::span<const gpu::DrawnCluster> drawn, std::span<const gpu::uint> states);
// Groups (DrawnCluster::group) of such clusters none of which shows, by their numbers.
std::vector<std::uint32_t> hidden_groups(std::span<const gpu::DrawnCluster> drawn,
                                         const ShownClusters& shown);

}  // namespace oro
