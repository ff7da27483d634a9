// Whether a cluster graph that came from outside is one: so that any cut of it covers each place once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/clusters/cluster_graph.h"
#include "core/surface/ground_bounds.h"
#include "core/surface/original_surface.h"

namespace oro {

// Which group is wrong, and what was found and what was expected.
struct UnsoundGroup {
    std::uint32_t group;
    std::string what;
};

// Links: each cluster is used by the group that lists it, a group of the level after the one that made it,
// and all but those of the last level are used. So no way leads from a group back to it.
[[nodiscard]] std::optional<UnsoundGroup> wrong_link(const ClusterGraph& graph);

// Growth: errors and spheres of a group are at least those of the groups below it, and spheres of the first
// level hold what is drawn there.
[[nodiscard]] std::optional<UnsoundGroup> wrong_growth(const ClusterGraph& graph,
                                                       const OriginalSurface& surface,
                                                       const GroundBounds& bounds);

// Cover: what a group made covers what it uses, each place once: both have the same border. Along the rim a
// straight piece of it may have fewer vertices; where another group lies beyond, each edge is the same. (But
// for one case in 2^64: borders are told apart by checksums.) For a graph whose links are right and whose
// triangles are clockwise.
[[nodiscard]] std::optional<UnsoundGroup> torn_group(const ClusterGraph& graph,
                                                     const OriginalSurface& surface, int threads = 1);

}  // namespace oro
