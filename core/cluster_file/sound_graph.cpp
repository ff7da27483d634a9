#include "core/cluster_file/sound_graph.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <sstream>
#include <vector>

namespace oro {
namespace {

std::string in_words(std::uint64_t value) {
    return std::to_string(value);
}
std::string group_name(std::uint32_t group) {
    return group == no_group ? "none" : in_words(group);
}
// All digits that a distance has.
std::string metres(double value_m) {
    std::ostringstream text;
    text.precision(17);
    text << value_m << " m";
    return text.str();
}

// 0 for a leaf.
std::uint32_t level_of(const ClusterGraph& graph, const Cluster& cluster) {
    return cluster.made_by == no_group ? 0 : graph.groups[cluster.made_by].level;
}

std::optional<UnsoundGroup> wrong_members(const ClusterGraph& graph, std::uint32_t group) {
    std::int64_t before = -1;
    for (const std::uint32_t member : graph.members_of(graph.groups[group])) {
        if (member <= before || member >= graph.clusters.size())
            return UnsoundGroup{group, "uses cluster " + in_words(member) + " after " +
                                           std::to_string(before) + ", expected rising numbers of " +
                                           in_words(graph.clusters.size())};
        before = member;
        const Cluster& cluster = graph.clusters[member];
        if (level_of(graph, cluster) + 1 != graph.groups[group].level)
            return UnsoundGroup{group, "uses cluster " + in_words(member) + " of level " +
                                           in_words(level_of(graph, cluster)) + ", expected level " +
                                           in_words(graph.groups[group].level - 1)};
        if (cluster.used_by != group)
            return UnsoundGroup{group, "uses cluster " + in_words(member) +
                                           ", which says that it is used by " + group_name(cluster.used_by)};
    }
    return std::nullopt;
}

std::optional<UnsoundGroup> too_small_sphere(std::uint32_t group, double reach_m, double radius_m) {
    return UnsoundGroup{group, "has a sphere of " + metres(radius_m) + ", but what it holds reaches " +
                                   metres(reach_m) + " from its centre"};
}

}  // namespace

std::optional<UnsoundGroup> wrong_link(const ClusterGraph& graph) {
    std::size_t used = 0;
    for (std::uint32_t i = 0; i < graph.groups.size(); ++i) {
        if (auto wrong = wrong_members(graph, i)) return wrong;
        used += graph.groups[i].members;
    }
    // Each member says that it is used by the one group that lists it. So where as many are listed as say so,
    // none is missing.
    std::size_t said = 0;
    for (std::uint32_t i = 0; i < graph.clusters.size(); ++i) {
        const Cluster& cluster = graph.clusters[i];
        const bool last = level_of(graph, cluster) == graph.levels.size();
        if (cluster.used_by != no_group) ++said;
        if ((cluster.used_by == no_group) == last) continue;
        return UnsoundGroup{cluster.made_by == no_group ? 0 : cluster.made_by,
                            "has cluster " + in_words(i) + " of level " + in_words(level_of(graph, cluster)) +
                                " of " + in_words(graph.levels.size()) + " used by " +
                                group_name(cluster.used_by)};
    }
    if (said != used)
        return UnsoundGroup{0, "and others list " + in_words(used) + " clusters, but " + in_words(said) +
                                   " say that they are used"};
    return std::nullopt;
}

std::optional<UnsoundGroup> wrong_growth(const ClusterGraph& graph, const OriginalSurface& surface,
                                         const GroundBounds& bounds) {
    for (std::uint32_t i = 0; i < graph.groups.size(); ++i) {
        const ClusterGroup& group = graph.groups[i];
        if (const double below_m = largest_member_error_m(graph, group); below_m > group.error_m)
            return UnsoundGroup{
                i, "has error " + metres(group.error_m) + ", but one below it has " + metres(below_m)};
        std::uint32_t last = no_group;
        for (const std::uint32_t member : graph.members_of(group)) {
            const Cluster& cluster = graph.clusters[member];
            if (cluster.made_by == no_group) {
                for (const VertexTriangle& triangle : graph.triangles_of(cluster)) {
                    for (const VertexNumber vertex : triangle) {
                        const double reach_m =
                            glm::distance(bounds.ecef(surface.vertex(vertex)).m, group.centre.m);
                        if (reach_m > group.radius_m) return too_small_sphere(i, reach_m, group.radius_m);
                    }
                }
            } else if (cluster.made_by != last) {
                last = cluster.made_by;
                const ClusterGroup& below = graph.groups[last];
                const double reach_m = glm::distance(below.centre.m, group.centre.m) + below.radius_m;
                if (reach_m > group.radius_m) return too_small_sphere(i, reach_m, group.radius_m);
            }
        }
    }
    return std::nullopt;
}

}  // namespace oro
