// A surface at every detail between all of its triangles and a few: clusters of triangles, joined in groups
// that are drawn as they are or made coarser, whole.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/surface/surface_vertex.h"

namespace oro {

inline constexpr std::size_t most_cluster_triangles = 128;
inline constexpr std::size_t most_cluster_vertices = 128;

// No group: the cluster is a leaf, or one of the coarsest.
inline constexpr std::uint32_t no_group = ~std::uint32_t{0};

// What is drawn or left out whole.
struct Cluster {
    std::uint32_t first_triangle;
    std::uint32_t triangles;  // 1 .. most_cluster_triangles
    std::uint32_t vertices;   // 1 .. most_cluster_vertices
    std::uint32_t made_by;  // the group that it is a part of what came out of; no_group: the original itself
    std::uint32_t used_by;  // the group that makes it coarser; no_group: nothing does
};

// Clusters that are made coarser together, so that what comes out has their outer border.
struct ClusterGroup {
    std::uint32_t level;  // of what comes out: 1 or more; the original's clusters are level 0
    std::uint32_t first_member;
    std::uint32_t members;     // clusters that it uses
    std::uint32_t first_made;  // cluster, one after another
    std::uint32_t made;        // clusters that come out
    // Bound of the distance, metres, between a place of the original and what comes out in its stead. At
    // least that of each group whose clusters it uses.
    double error_m;
    // A sphere around all that it covers, of any detail. It holds the spheres of the groups whose clusters it
    // uses.
    Ecef centre;
    double radius_m;
    // It is the same as in the graph of the whole surface, of which a window was built.
    bool complete;
};

// What building a level did.
struct GraphLevel {
    std::size_t triangles_in{};
    std::size_t triangles_out{};
    std::size_t groups{};
    std::size_t clusters_out{};
    // Groups that kept more than stuck_share of their triangles. They are handed on to the next level, whose
    // borders lie elsewhere.
    std::size_t stuck_groups{};
    std::size_t largest_group{};  // triangles
    double largest_error_m{};
    // Vertices that had to stay at this level because of a border between groups, and those of them that had
    // to stay at the level before, too; none stays for a third one.
    std::size_t locked{};
    std::size_t locked_twice{};
};
inline constexpr double stuck_share = 0.85;

struct ClusterGraph {
    std::vector<VertexTriangle> triangles;  // cluster after cluster
    std::vector<Cluster> clusters;          // leaves first, then as groups made them
    std::vector<ClusterGroup> groups;       // level by level
    std::vector<std::uint32_t> members;     // clusters that groups use, group after group
    std::vector<GraphLevel> levels;         // level 1 first

    [[nodiscard]] std::span<const VertexTriangle> triangles_of(const Cluster& cluster) const {
        return std::span(triangles).subspan(cluster.first_triangle, cluster.triangles);
    }
    [[nodiscard]] std::span<const std::uint32_t> members_of(const ClusterGroup& group) const {
        return std::span(members).subspan(group.first_member, group.members);
    }
};

// The largest error of the groups that made what a group uses; 0 where it uses the original's own clusters.
[[nodiscard]] inline double largest_member_error_m(const ClusterGraph& graph, const ClusterGroup& group) {
    double largest_m = 0.0;
    for (const std::uint32_t member : graph.members_of(group)) {
        const std::uint32_t below = graph.clusters[member].made_by;
        if (below != no_group) largest_m = std::max(largest_m, graph.groups[below].error_m);
    }
    return largest_m;
}

}  // namespace oro
