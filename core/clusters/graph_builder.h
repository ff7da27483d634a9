// Builds the cluster graph of a surface (docs/CLUSTERS.md).
#pragma once

#include <vector>

#include "core/clusters/cluster_graph.h"
#include "core/clusters/group_tiling.h"
#include "core/surface/ground_bounds.h"
#include "core/surface/original_surface.h"

namespace oro {

// With so few triangles a level is one group: what 3 x 3 leaves have.
inline constexpr std::size_t one_group_triangles = 9 * most_cluster_triangles;
// Groups may be stuck for a level: the next has other borders, and the one after that.
inline constexpr int most_without_progress = 3;

struct GraphOptions {
    int threads{1};
    double kept_share{0.65};  // of a group's triangles, in what comes out of it
    int last_level{80};       // stop after it; what it made is then used by none
    // For a window: groups that are not complete stay as fine as they come, as nobody takes them from it.
    bool whole_alone{false};
    std::vector<GroupTile>* tiles{};  // told the tile of each group that is added
};

// All levels up to the coarsest: one group, or groups that cannot be made coarser; of a window all that have
// a group that is whole, whether or not these can be made coarser (docs/CLUSTERS.md, "Regions of any size").
// The result does not depend on `threads`.
//
// Each level: triangles go to groups by where they lie (group_assignment.h); what one group has made is split
// where groups of the next level meet, and into clusters of most_cluster_triangles; each group is made
// coarser with its border as it is (simplify_group.h), and measured against the original.
//
// Memory: 12 bytes a triangle of all levels together, some 70 a vertex of a grid; and half as much again or a
// little more while it works (194 MB in all for 1201 x 1201 posts).
[[nodiscard]] ClusterGraph build_cluster_graph(const OriginalSurface& surface, const GroundBounds& bounds,
                                               const GraphOptions& options = {});

// Goes on with a graph of the same surface that was stopped after some level, or had nothing more to be made
// coarser: with the same kept_share the result is that of one go, to the bit. All that is needed of it is in
// a file of it (core/cluster_file/cluster_file.h): what its last two levels made.
[[nodiscard]] ClusterGraph continue_cluster_graph(const OriginalSurface& surface, const GroundBounds& bounds,
                                                  ClusterGraph begun, const GraphOptions& options = {});

}  // namespace oro
