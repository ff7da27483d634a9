// Whether a cluster graph that came from outside is one: so that any cut of it covers each place once.
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/cluster_file/group_code.h"
#include "core/clusters/cluster_graph.h"
#include "core/surface/ground_bounds.h"
#include "core/surface/original_surface.h"

namespace oro {

// A graph that is asked group by group, so that nobody needs to have it whole. Both functions are asked by
// any number of threads at once, and for the same group more than once.
struct GraphByGroups {
    std::uint32_t leaves{};
    std::uint32_t clusters{};  // leaves, too
    std::uint32_t groups{};
    std::uint32_t levels{};
    std::function<std::vector<VertexTriangle>(std::uint32_t leaf)> leaf;
    // As ClusterFile::part() gives it: members are below what the group made.
    std::function<Result<void>(std::uint32_t number, GroupPart& part)> part;
};

// Which group is wrong, and what was found and what was expected.
struct UnsoundGroup {
    std::uint32_t group{};
    std::string what;
};

// The first group that is wrong in the first of three ways; nothing where the graph is one.
//
// Links: each cluster is used by the group that lists it, a group of the level after the one that made it,
// and all but those of the last level are used. So no way leads from a group back to it.
// Growth: errors and spheres of a group are at least those of the groups below it, and spheres of the first
// level hold what is drawn there.
// Cover: what a group made covers what it uses, each place once: both have the same border. Along the rim a
// straight piece of it may have fewer vertices; where another group lies beyond, each edge is the same. (But
// for one case in 2^64: borders are told apart by checksums.) For triangles that are clockwise.
//
// Keeps 12 bytes a cluster and 80 a group, and what is at a rim. Errors: those of `part`.
[[nodiscard]] Result<std::optional<UnsoundGroup>> unsound_group(const GraphByGroups& graph,
                                                                const OriginalSurface& surface,
                                                                const GroundBounds& bounds, int threads = 1);

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
