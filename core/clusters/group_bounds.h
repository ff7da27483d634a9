// The error and the sphere of a group: never less than those of the groups below it.
#pragma once

#include <span>

#include "core/clusters/cluster_graph.h"
#include "core/surface/ground_bounds.h"
#include "core/surface/original_surface.h"

namespace oro {

struct GroupBounds {
    double error_m{};
    Ecef centre;
    double radius_m{};
};

// The bounds of a group whose members are known, from what came out of it and how far that is from the
// original, in height (steps). A group of leaves gets a sphere around their vertices; others get one around
// the spheres of the groups below, so that it holds all that is drawn there at any detail.
[[nodiscard]] GroupBounds group_bounds(const OriginalSurface& surface, const GroundBounds& ground,
                                       const ClusterGraph& graph, std::uint32_t group,
                                       std::span<const VertexTriangle> made, double difference);

}  // namespace oro
