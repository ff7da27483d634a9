#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "core/base/parallel.h"
#include "core/cluster_file/sound_graph.h"

// The border of some triangles as a sum: each edge counts for itself, and against the same edge the other way
// round, so that what is within goes away. Triangles that are all clockwise, with the border of some others,
// cover each place as often as these.
namespace oro {
namespace {

struct Edge {
    VertexNumber from;
    VertexNumber to;
    friend auto operator<=>(const Edge&, const Edge&) = default;
};

// Spreads a number over all 64 bits. Source: G. Steele, D. Lea, C. Flood, Fast splittable pseudorandom number
// generators, OOPSLA 2014 (its mixing function).
std::uint64_t mixed(std::uint64_t number) {
    number += 0x9e3779b97f4a7c15U;
    number = (number ^ (number >> 30U)) * 0xbf58476d1ce4e5b9U;
    number = (number ^ (number >> 27U)) * 0x94d049bb133111ebU;
    return number ^ (number >> 31U);
}

std::uint64_t border_sum(std::span<const VertexTriangle> triangles) {
    std::uint64_t sum = 0;
    for (const VertexTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const VertexNumber from = triangle[i], to = triangle[(i + 1) % 3];
            const std::uint64_t one = mixed(std::uint64_t{std::min(from, to)} << 32U | std::max(from, to));
            sum += from < to ? one : -one;
        }
    }
    return sum;
}

// Of triangles of several clusters: edges without one the other way round.
std::vector<Edge> border_of(std::span<const VertexTriangle> triangles) {
    std::vector<Edge> edges;
    for (const VertexTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) edges.push_back({triangle[i], triangle[(i + 1) % 3]});
    }
    std::sort(edges.begin(), edges.end());
    std::vector<Edge> border;
    for (const Edge& edge : edges) {
        if (!std::binary_search(edges.begin(), edges.end(), Edge{edge.to, edge.from})) border.push_back(edge);
    }
    return border;
}

// An end of an edge on the straight line that the edge lies on: +1 where it begins, -1 where it ends. On a
// line edges one after another add up to their first begin and their last end.
struct End {
    std::int64_t down, right;  // the line's direction, without a common divisor, of two opposite ones the one
    std::int64_t beside;       // where it lies
    VertexNumber vertex;
    int sign;
    [[nodiscard]] auto place() const { return std::tie(down, right, beside, vertex); }
};

void add_ends(const OriginalSurface& surface, std::span<const Edge> edges, int sign, std::vector<End>& ends) {
    for (const Edge& edge : edges) {
        const SurfaceVertex from = surface.vertex(edge.from), to = surface.vertex(edge.to);
        std::int64_t down = std::int64_t{to.row} - from.row, right = std::int64_t{to.column} - from.column;
        const std::int64_t common = std::gcd(down, right);
        down /= common;
        right /= common;
        if (down < 0 || (down == 0 && right < 0)) {
            down = -down;
            right = -right;
        }
        const std::int64_t beside = down * from.column - right * from.row;
        ends.push_back({down, right, beside, edge.from, sign});
        ends.push_back({down, right, beside, edge.to, -sign});
    }
}

// Whether two borders are the same but for vertices on straight pieces.
bool same_but_straight(const OriginalSurface& surface, std::span<const Edge> a, std::span<const Edge> b) {
    std::vector<End> ends;
    add_ends(surface, a, 1, ends);
    add_ends(surface, b, -1, ends);
    std::sort(ends.begin(), ends.end(), [](const End& x, const End& y) { return x.place() < y.place(); });
    for (std::size_t first = 0, last = 0; first < ends.size(); first = last) {
        int sum = 0;
        for (; last < ends.size() && ends[last].place() == ends[first].place(); ++last)
            sum += ends[last].sign;
        if (sum != 0) return false;
    }
    return true;
}

std::vector<VertexTriangle> used_triangles(const ClusterGraph& graph, const ClusterGroup& group) {
    std::vector<VertexTriangle> triangles;
    for (const std::uint32_t member : graph.members_of(group)) {
        const auto of_member = graph.triangles_of(graph.clusters[member]);
        triangles.insert(triangles.end(), of_member.begin(), of_member.end());
    }
    return triangles;
}

// What a group made lies together.
std::span<const VertexTriangle> made_triangles(const ClusterGraph& graph, const ClusterGroup& group) {
    const Cluster& first = graph.clusters[group.first_made];
    const Cluster& last = graph.clusters[group.first_made + group.made - 1];
    return std::span(graph.triangles)
        .subspan(first.first_triangle, last.first_triangle + last.triangles - first.first_triangle);
}

bool same_sum(const ClusterGraph& graph, const ClusterGroup& group) {
    std::uint64_t used = 0;
    for (const std::uint32_t member : graph.members_of(group))
        used += border_sum(graph.triangles_of(graph.clusters[member]));
    return used == border_sum(made_triangles(graph, group));
}

// An edge that is gone, the other way round, and the group that it is gone from.
struct Gone {
    Edge edge;
    std::uint32_t group;
};

// Edges that are gone from a level's groups must have had nothing beyond them.
std::optional<UnsoundGroup> gone_inside(const ClusterGraph& graph, std::uint32_t level,
                                        std::vector<Gone>& gone) {
    if (gone.empty()) return std::nullopt;
    const auto number_of = [](const Edge& edge) { return std::uint64_t{edge.from} << 32U | edge.to; };
    std::unordered_set<std::uint64_t> edges;
    for (const Gone& one : gone) edges.insert(number_of(one.edge));
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.used_by == no_group || graph.groups[cluster.used_by].level != level) continue;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster)) {
            for (std::size_t i = 0; i < 3; ++i) {
                const Edge edge{triangle[i], triangle[(i + 1) % 3]};
                if (!edges.contains(number_of(edge))) continue;
                const auto found =
                    std::find_if(gone.begin(), gone.end(), [&](const Gone& one) { return one.edge == edge; });
                return UnsoundGroup{found->group, "has lost the edge from vertex " + std::to_string(edge.to) +
                                                      " to " + std::to_string(edge.from) +
                                                      ", which it shares with group " +
                                                      std::to_string(cluster.used_by)};
            }
        }
    }
    return std::nullopt;
}

}  // namespace

std::optional<UnsoundGroup> torn_group(const ClusterGraph& graph, const OriginalSurface& surface,
                                       int threads) {
    std::vector<char> same(graph.groups.size());
    in_parallel(static_cast<int>(same.size()), threads, [&](int i) {
        const auto group = static_cast<std::size_t>(i);
        same[group] = same_sum(graph, graph.groups[group]) ? 1 : 0;
    });
    std::vector<std::vector<Gone>> gone(graph.levels.size() + 1);
    for (std::uint32_t i = 0; i < graph.groups.size(); ++i) {
        if (same[i] != 0) continue;
        const ClusterGroup& group = graph.groups[i];
        const std::vector<Edge> before = border_of(used_triangles(graph, group));
        const std::vector<Edge> after = border_of(made_triangles(graph, group));
        if (!same_but_straight(surface, before, after))
            return UnsoundGroup{i, "made clusters with another border than those that it uses have"};
        for (const Edge& edge : before) {
            if (!std::binary_search(after.begin(), after.end(), edge))
                gone[group.level].push_back({{edge.to, edge.from}, i});
        }
    }
    for (std::uint32_t level = 1; level < gone.size(); ++level) {
        if (auto wrong = gone_inside(graph, level, gone[level])) return wrong;
    }
    return std::nullopt;
}

}  // namespace oro
