#include "core/clusters/graph_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

#include "core/base/parallel.h"
#include "core/clusters/cluster_split.h"
#include "core/clusters/group_assignment.h"
#include "core/clusters/group_bounds.h"
#include "core/clusters/open_border.h"
#include "core/clusters/simplify_group.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// Groups that a thread takes at a time.
constexpr std::size_t groups_at_a_time = 8;
// Of vertices that are not locked, so many times (1 - kept_share) may go at most: in a narrow group, with a
// border all around, there are few, and what they hold up would fall.
constexpr double most_share = 1.25;

class Builder {
  public:
    Builder(const OriginalSurface& surface, const GroundBounds& bounds, const GraphOptions& options)
        : surface_(surface),
          bounds_(bounds),
          options_(options),
          locks_(surface.vertex_count()),
          border_(surface) {}

    // From the original on, or from the last level of a graph.
    ClusterGraph build(ClusterGraph begun);

  private:
    // What a group of the last level made (or a leaf has), sorted by the groups that it goes to.
    struct Part {
        std::uint32_t made_by;
        std::vector<std::size_t> clusters;  // triangles of each
        std::vector<std::uint32_t> groups;  // of each; empty: none
    };
    struct Made {
        std::vector<VertexTriangle> triangles;
        std::size_t triangles_in;
        GroupBounds bounds;
    };

    void share_out(const GroupAssignment& assignment, std::size_t part, Part& shared);
    void put_clusters_in_order(std::span<VertexTriangle> triangles,
                               std::span<const std::size_t> clusters) const;
    void add_clusters(const std::vector<Part>& shared, GraphLevel& report);
    void add_groups(std::size_t groups, std::uint32_t first_cluster, GraphLevel& report);
    void make(std::uint32_t group, const EdgeLimit& edges, GroupMesh& mesh, GroupSimplifier& simplifier,
              Made& made) const;
    void add_level();
    void begin_with_leaves();
    void begin_with(ClusterGraph begun);
    void see_locks(std::uint32_t level);
    void add_coarsest();
    [[nodiscard]] std::size_t triangles_left() const;

    const OriginalSurface& surface_;
    const GroundBounds& bounds_;
    const GraphOptions& options_;
    VertexLocks locks_;
    OpenBorder border_;
    bool any_whole_{true};    // of the last level's groups
    int without_progress_{};  // levels in a row
    ClusterGraph graph_;
    std::vector<std::vector<VertexTriangle>> parts_;  // of the last level
    std::vector<std::uint32_t> made_by_;              // of each part
};

std::size_t Builder::triangles_left() const {
    return std::accumulate(parts_.begin(), parts_.end(), std::size_t{0},
                           [](std::size_t sum, const auto& part) { return sum + part.size(); });
}

// Sorts a part's triangles by group, and those of each group into clusters. A leaf is a cluster already.
void Builder::share_out(const GroupAssignment& assignment, std::size_t part, Part& shared) {
    std::vector<VertexTriangle>& triangles = parts_[part];
    const auto groups = assignment.groups_of(part);
    shared.made_by = made_by_[part];
    if (shared.made_by == no_group) {
        shared.clusters = {triangles.size()};
        shared.groups = {groups.front()};
        return;
    }
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return groups[a] < groups[b]; });
    std::vector<VertexTriangle> sorted;
    sorted.reserve(triangles.size());
    for (const std::uint32_t i : order) sorted.push_back(triangles[i]);
    for (std::size_t first = 0, last = 0; first < sorted.size(); first = last) {
        const std::uint32_t group = groups[order[first]];
        while (last < sorted.size() && groups[order[last]] == group) ++last;
        split_to_clusters(surface_, std::span(sorted).subspan(first, last - first), shared.clusters);
        shared.groups.resize(shared.clusters.size(), group);
    }
    put_clusters_in_order(sorted, shared.clusters);
    triangles = std::move(sorted);
}

// So what becomes of clusters does not depend on how they came about, and a file may tell them in its own
// order.
void Builder::put_clusters_in_order(std::span<VertexTriangle> triangles,
                                    std::span<const std::size_t> clusters) const {
    std::size_t first = 0;
    for (const std::size_t count : clusters) {
        put_in_walk_order(surface_, triangles.subspan(first, count));
        first += count;
    }
}

// used_by is the group's number on its level for now.
void Builder::add_clusters(const std::vector<Part>& shared, GraphLevel& report) {
    for (std::size_t i = 0; i < shared.size(); ++i) {
        const Part& part = shared[i];
        if (part.made_by != no_group) {
            ClusterGroup& maker = graph_.groups[part.made_by];
            maker.first_made = static_cast<std::uint32_t>(graph_.clusters.size());
            maker.made = static_cast<std::uint32_t>(part.clusters.size());
        }
        std::size_t first = 0;
        for (std::size_t j = 0; j < part.clusters.size(); ++j) {
            const auto triangles = std::span(parts_[i]).subspan(first, part.clusters[j]);
            graph_.clusters.push_back({static_cast<std::uint32_t>(graph_.triangles.size()),
                                       static_cast<std::uint32_t>(triangles.size()),
                                       static_cast<std::uint32_t>(vertex_count(triangles)), part.made_by,
                                       part.groups.empty() ? no_group : part.groups[j]});
            graph_.triangles.insert(graph_.triangles.end(), triangles.begin(), triangles.end());
            first += part.clusters[j];
        }
    }
    report.triangles_in = triangles_left();
}

// The clusters from first_cluster on, by group.
void Builder::add_groups(std::size_t groups, std::uint32_t first_cluster, GraphLevel& report) {
    const auto first_group = static_cast<std::uint32_t>(graph_.groups.size());
    const auto level = static_cast<std::uint32_t>(graph_.levels.size() + 1);
    graph_.groups.resize(graph_.groups.size() + groups);
    for (std::size_t i = first_cluster; i < graph_.clusters.size(); ++i) {
        graph_.clusters[i].used_by += first_group;
        ++graph_.groups[graph_.clusters[i].used_by].members;
    }
    auto first_member = static_cast<std::uint32_t>(graph_.members.size());
    graph_.members.resize(graph_.members.size() + graph_.clusters.size() - first_cluster);
    for (std::size_t i = first_group; i < graph_.groups.size(); ++i) {
        graph_.groups[i].level = level;
        graph_.groups[i].first_member = first_member;
        first_member += graph_.groups[i].members;
        graph_.groups[i].members = 0;
    }
    for (auto i = first_cluster; i < graph_.clusters.size(); ++i) {
        ClusterGroup& group = graph_.groups[graph_.clusters[i].used_by];
        graph_.members[group.first_member + group.members++] = i;
    }
    report.groups = groups;
}

void Builder::make(std::uint32_t group, const EdgeLimit& edges, GroupMesh& mesh, GroupSimplifier& simplifier,
                   Made& made) const {
    std::vector<VertexTriangle> triangles;
    for (const std::uint32_t member : graph_.members_of(graph_.groups[group])) {
        const auto of_member = graph_.triangles_of(graph_.clusters[member]);
        triangles.insert(triangles.end(), of_member.begin(), of_member.end());
    }
    mesh.start(surface_, triangles, [&](VertexNumber vertex) {
        return locks_.is_locked(vertex) || surface_.is_open(vertex) || surface_.must_stay(vertex);
    });
    const double target = std::floor(options_.kept_share * static_cast<double>(triangles.size()));
    const double floor_m = largest_member_error_m(graph_, graph_.groups[group]);
    if (graph_.groups[group].complete || !options_.whole_alone)
        simplifier.simplify(mesh, {.triangles = static_cast<int>(target),
                                   .most_share = most_share * (1.0 - options_.kept_share),
                                   .free_difference = floor_m / height_step_m,
                                   .edges = edges});
    made.triangles_in = triangles.size();
    mesh.copy_to(made.triangles);
    made.bounds = group_bounds(surface_, bounds_, graph_, group, made.triangles, mesh.difference(surface_));
}

void Builder::add_level() {
    GraphLevel report;
    const int level = static_cast<int>(graph_.levels.size()) + 1;
    const GroupAssignment assignment(surface_, parts_, GroupTiling(level, options_.kept_share),
                                     !surface_.is_window() && triangles_left() <= one_group_triangles,
                                     locks_);
    report.locked = locks_.locked();
    report.locked_twice = locks_.locked_twice();
    // Before triangles change their places in parts.
    const std::vector<char> whole = border_.complete_groups(assignment, parts_);
    std::vector<Part> shared(parts_.size());
    in_parallel(static_cast<int>(parts_.size()), options_.threads, [&](int part) {
        const auto i = static_cast<std::size_t>(part);
        share_out(assignment, i, shared[i]);
    });
    const auto first_cluster = static_cast<std::uint32_t>(graph_.clusters.size());
    const auto first_group = static_cast<std::uint32_t>(graph_.groups.size());
    add_clusters(shared, report);
    add_groups(assignment.groups(), first_cluster, report);
    for (std::size_t i = 0; i < whole.size(); ++i) {
        graph_.groups[first_group + i].complete = whole[i] != 0;
        if (options_.tiles) options_.tiles->push_back(assignment.tile(i));
    }
    std::vector<Made> made(assignment.groups());
    const std::size_t turns = (made.size() + groups_at_a_time - 1) / groups_at_a_time;
    in_parallel(static_cast<int>(turns), options_.threads, [&](int turn) {
        GroupMesh mesh;
        GroupSimplifier simplifier(surface_);
        const std::size_t first = static_cast<std::size_t>(turn) * groups_at_a_time;
        for (std::size_t i = first; i < std::min(made.size(), first + groups_at_a_time); ++i)
            make(first_group + static_cast<std::uint32_t>(i), assignment.longest_edges(), mesh, simplifier,
                 made[i]);
    });
    parts_.clear();
    made_by_.clear();
    for (std::size_t i = 0; i < made.size(); ++i) {
        ClusterGroup& group = graph_.groups[first_group + i];
        group.error_m = made[i].bounds.error_m;
        group.centre = made[i].bounds.centre;
        group.radius_m = made[i].bounds.radius_m;
        const auto in = static_cast<double>(made[i].triangles_in);
        report.stuck_groups += static_cast<double>(made[i].triangles.size()) > stuck_share * in ? 1U : 0U;
        report.largest_group = std::max(report.largest_group, made[i].triangles_in);
        report.largest_error_m = std::max(report.largest_error_m, group.error_m);
        report.triangles_out += made[i].triangles.size();
        parts_.push_back(std::move(made[i].triangles));
        made_by_.push_back(first_group + static_cast<std::uint32_t>(i));
    }
    border_.reach(parts_, whole);
    any_whole_ = std::find(whole.begin(), whole.end(), 1) != whole.end();
    graph_.levels.push_back(report);
    without_progress_ = report.triangles_out < report.triangles_in ? 0 : without_progress_ + 1;
}

// What is left is used by none.
void Builder::add_coarsest() {
    std::vector<Part> shared(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        shared[i].made_by = made_by_[i];
        if (made_by_[i] == no_group)
            shared[i].clusters = {parts_[i].size()};
        else
            split_to_clusters(surface_, parts_[i], shared[i].clusters);
        if (made_by_[i] != no_group) put_clusters_in_order(parts_[i], shared[i].clusters);
    }
    GraphLevel unused;
    add_clusters(shared, unused);
}

void Builder::begin_with_leaves() {
    parts_ = surface_.leaves();
    made_by_.assign(parts_.size(), no_group);
    // Those of all levels, or nearly: to make room again and again would take twice as much.
    graph_.triangles.reserve(static_cast<std::size_t>(
        static_cast<double>(triangles_left()) *
        (1.0 - std::pow(options_.kept_share, options_.last_level + 1)) / (1.0 - options_.kept_share)));
}

// Which vertices are on borders between groups of a level, told by what these made.
void Builder::see_locks(std::uint32_t level) {
    locks_.begin_level();
    for (const Cluster& cluster : graph_.clusters) {
        if (cluster.made_by == no_group || graph_.groups[cluster.made_by].level != level) continue;
        for (const VertexTriangle& triangle : graph_.triangles_of(cluster)) {
            for (const VertexNumber vertex : triangle) locks_.see(vertex, cluster.made_by);
        }
    }
    locks_.end_level();
}

// As it was when the last level was made. How its clusters were split is forgotten: that is for the groups of
// the next level to say.
void Builder::begin_with(ClusterGraph begun) {
    graph_ = std::move(begun);
    const auto last = static_cast<std::uint32_t>(graph_.levels.size());
    if (last > 1) see_locks(last - 1);
    see_locks(last);
    std::vector<char> whole;
    for (std::uint32_t i = 0; i < graph_.groups.size(); ++i) {
        const ClusterGroup& group = graph_.groups[i];
        if (group.level != last) continue;
        std::vector<VertexTriangle>& part = parts_.emplace_back();
        for (std::uint32_t j = group.first_made; j < group.first_made + group.made; ++j) {
            const auto triangles = graph_.triangles_of(graph_.clusters[j]);
            part.insert(part.end(), triangles.begin(), triangles.end());
        }
        made_by_.push_back(i);
        whole.push_back(group.complete ? 1 : 0);
    }
    border_.reach(parts_, whole);
    any_whole_ = std::find(whole.begin(), whole.end(), 1) != whole.end();
    for (const GraphLevel& level : graph_.levels)
        without_progress_ = level.triangles_out < level.triangles_in ? 0 : without_progress_ + 1;
    const std::uint32_t first = graph_.groups[made_by_.front()].first_made;
    graph_.triangles.resize(graph_.clusters[first].first_triangle);
    graph_.clusters.resize(first);
}

ClusterGraph Builder::build(ClusterGraph begun) {
    if (begun.levels.empty())
        begin_with_leaves();
    else
        begin_with(std::move(begun));
    // Whether there is more to be made of a window's groups is for the whole region to say.
    const auto is_coarsest = [&] {
        return !surface_.is_window() && (without_progress_ >= most_without_progress ||
                                         (parts_.size() == 1 && triangles_left() <= most_cluster_triangles));
    };
    while (!parts_.empty() && any_whole_ && static_cast<int>(graph_.levels.size()) < options_.last_level &&
           !is_coarsest())
        add_level();
    add_coarsest();
    for (GraphLevel& level : graph_.levels) level.clusters_out = 0;
    for (const ClusterGroup& group : graph_.groups) graph_.levels[group.level - 1].clusters_out += group.made;
    return std::move(graph_);
}

}  // namespace

ClusterGraph build_cluster_graph(const OriginalSurface& surface, const GroundBounds& bounds,
                                 const GraphOptions& options) {
    return Builder(surface, bounds, options).build({});
}

ClusterGraph continue_cluster_graph(const OriginalSurface& surface, const GroundBounds& bounds,
                                    ClusterGraph begun, const GraphOptions& options) {
    return Builder(surface, bounds, options).build(std::move(begun));
}

}  // namespace oro
