// Whether what a group says of itself fits the groups below it: asked of a whole graph when it is checked,
// and of each group that is drawn.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "core/cluster_file/group_code.h"
#include "core/clusters/cluster_graph.h"

namespace oro {

// The group that made a cluster; no_group: a leaf. groups: of the graph, in their order; those that made
// cluster numbers up to this one do.
[[nodiscard]] std::uint32_t maker_among(std::span<const ClusterGroup> groups, std::uint32_t leaves,
                                        std::uint32_t cluster);

// Each of these: nothing when all is well, else words that follow "group N". Numbers are compared as they
// are: the builder (core/clusters/group_bounds.h) lets spheres grow by more than rounding.

// Clusters that a group uses are of the level below its own.
[[nodiscard]] std::optional<std::string> wrong_level(const ClusterGroup& group, std::uint32_t member,
                                                     std::span<const ClusterGroup> groups,
                                                     std::uint32_t leaves);
// Its error is at least that of each group below it, and its sphere holds theirs.
[[nodiscard]] std::optional<std::string> wrong_growth(const GroupPart& part,
                                                      std::span<const ClusterGroup> groups,
                                                      std::uint32_t leaves);
// Its sphere holds a place that it covers.
[[nodiscard]] std::optional<std::string> beyond_sphere(const ClusterGroup& group, const Ecef& place);

}  // namespace oro
