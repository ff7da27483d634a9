// Which clusters of a graph are drawn: one rule, for an error in metres and for one in pixels of a view.
#pragma once

#include <cstdint>
#include <vector>

#include "core/clusters/cluster_graph.h"
#include "core/earth/camera.h"

namespace oro {

// A group stands for what it was made of where its error is small enough. A cluster is drawn when the group
// that made it stands, and the one that uses it does not. A leaf was made by none, and one of the coarsest is
// used by none. Errors and spheres grow from a group to those above it, so where a group stands all below it
// do: each place is covered by exactly one cluster.
//
// The numbers of the clusters to draw, in rising order. error_m: the largest distance from the original, 0 or
// more. At 0 the original itself is drawn where no group is exact.
[[nodiscard]] std::vector<std::uint32_t> cut_by_metres(const ClusterGraph& graph, double error_m);

// All clusters of one level of the graph (discrete): 0, the original's; above the last, the coarsest.
[[nodiscard]] std::vector<std::uint32_t> cut_by_level(const ClusterGraph& graph, std::uint32_t level);

// For a view: no place that can be seen is farther than tau_px, at least 0, from where the original would put
// it (core/cluster_frame/group_rule.h). Nothing is left out
// because it cannot be seen.
[[nodiscard]] std::vector<std::uint32_t> cut_by_pixels(const ClusterGraph& graph, const Camera& camera,
                                                       double tau_px);

// The rule itself, where it is known of each group whether it stands.
[[nodiscard]] std::vector<std::uint32_t> cut_of(const ClusterGraph& graph, const std::vector<char>& stands);

[[nodiscard]] std::size_t triangles_of_cut(const ClusterGraph& graph, const std::vector<std::uint32_t>& cut);

}  // namespace oro
