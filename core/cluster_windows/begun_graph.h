// What windows have left at their last level, for the next levels to be made of.
#pragma once

#include <cstdint>
#include <vector>

#include "core/cluster_windows/joined_windows.h"
#include "core/cluster_windows/region_windows.h"
#include "core/clusters/cluster_graph.h"

namespace oro {

// As the last two levels of windows have them: what the builder needs to go on, with vertices numbered anew.
struct BegunGraph {
    ClusterGraph graph;
    RegionWindow window;                      // posts that it lies over
    std::vector<VertexNumber> vertices;       // of these posts, rising
    std::vector<GroupTile> tiles;             // of its groups
    std::vector<std::uint32_t> triangles_in;  // likewise

    [[nodiscard]] PostCounts posts() const { return {window.rows, window.columns}; }
};

// The graph of all groups, over all posts of the region.
Result<BegunGraph> begun_graph(const JoinedWindows& joined, const PostCounts& region, int threads);
// The graph of groups that reach into a window; those that also reach out of it are not complete. Its posts
// may reach beyond the window. No groups: there is no ground.
Result<BegunGraph> begun_graph_in(const JoinedWindows& joined, const PostCounts& region,
                                  const RegionWindow& window, int threads);

}  // namespace oro
