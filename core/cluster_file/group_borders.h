// The borders of what a group uses and of what it made, held against each other.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "core/clusters/cluster_graph.h"
#include "core/surface/original_surface.h"

namespace oro {

// A triangle's side, clockwise around it.
struct BorderEdge {
    VertexNumber from;
    VertexNumber to;
    friend auto operator<=>(const BorderEdge&, const BorderEdge&) = default;
};

// The border of some triangles as a sum: each edge counts for itself, and against the same edge the other way
// round, so that what is within goes away. Triangles that are all clockwise, with the border of some others,
// cover each place as often as these. Sums of several clusters add up to that of all of them.
[[nodiscard]] std::uint64_t border_sum(std::span<const VertexTriangle> triangles);

// Of triangles of several clusters: edges without one the other way round, rising.
[[nodiscard]] std::vector<BorderEdge> border_of(std::span<const VertexTriangle> triangles);

// Whether two borders are the same but for vertices on straight pieces.
[[nodiscard]] bool same_but_straight(const OriginalSurface& surface, std::span<const BorderEdge> a,
                                     std::span<const BorderEdge> b);

}  // namespace oro
