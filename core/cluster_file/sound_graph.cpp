#include "core/cluster_file/sound_graph.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <unordered_map>
#include <utility>

#include "core/base/parallel.h"
#include "core/cluster_file/cluster_format.h"
#include "core/cluster_file/group_growth.h"

namespace oro {
namespace {

std::string in_words(std::uint64_t value) {
    return std::to_string(value);
}
std::string group_name(std::uint32_t group) {
    return group == no_group ? "none" : in_words(group);
}
// Goes through the groups once in their order, and twice more to those at a rim.
class GraphCheck {
  public:
    GraphCheck(const GraphByGroups& graph, const OriginalSurface& surface, const GroundBounds& bounds,
               int threads)
        : graph_(graph), surface_(surface), bounds_(bounds), threads_(threads) {
        users_.assign(graph.leaves, no_group);
    }

    Result<std::optional<UnsoundGroup>> run() {
        std::vector<GroupPart> parts;
        for (std::uint32_t first = 0; first < graph_.groups; first += cluster_format::groups_at_a_time) {
            parts.assign(std::min(cluster_format::groups_at_a_time, graph_.groups - first), {});
            ORO_CHECK(read(first, parts));
            for (const GroupPart& part : parts)
                if (const auto wrong = take(part)) return wrong;
            compare(parts);
        }
        if (const auto wrong = wrong_users()) return wrong;
        if (wrong_growth_) return wrong_growth_;
        return torn();
    }

  private:
    // An edge that is gone, the other way round, and the group that it is gone from.
    struct Gone {
        BorderEdge edge;
        std::uint32_t group;
    };
    struct Found {
        std::optional<UnsoundGroup> growth;
        bool same_border{};
    };
    // Of one whose border is another: read at all, the same but for straight pieces, and the edges that are
    // gone.
    struct Rim {
        Result<void> read;
        bool same{};
        std::vector<Gone> gone;
    };
    // Edges that are gone, by number, and the place of the first of `gone_` with it.
    using EdgeNumbers = std::unordered_map<std::uint64_t, std::size_t>;

    Result<void> read(std::uint32_t first, std::vector<GroupPart>& parts) const;
    std::optional<UnsoundGroup> take(const GroupPart& part);
    std::optional<UnsoundGroup> wrong_members(const GroupPart& part);
    [[nodiscard]] std::optional<UnsoundGroup> wrong_users() const;
    void compare(const std::vector<GroupPart>& parts);
    [[nodiscard]] std::optional<UnsoundGroup> wrong_growth(const GroupPart& part) const;
    [[nodiscard]] bool same_border(const GroupPart& part) const;
    Result<void> compare_border(std::uint32_t number, Rim& rim) const;
    Result<std::optional<UnsoundGroup>> torn();
    Result<std::vector<VertexTriangle>> used_triangles(const GroupPart& part) const;
    Result<std::optional<UnsoundGroup>> lost_edge(std::uint32_t level, const std::vector<Gone>& gone) const;
    [[nodiscard]] std::vector<std::uint32_t> groups_at(std::uint32_t level,
                                                       const std::vector<Gone>& gone) const;
    Result<std::optional<UnsoundGroup>> lost_by(std::uint32_t group, const std::vector<Gone>& gone,
                                                const EdgeNumbers& numbers) const;
    [[nodiscard]] std::optional<UnsoundGroup> lost_by(std::span<const VertexTriangle> triangles,
                                                      std::uint32_t user, const std::vector<Gone>& gone,
                                                      const EdgeNumbers& numbers) const;

    // The group that made a cluster; no_group: a leaf.
    [[nodiscard]] std::uint32_t maker(std::uint32_t cluster) const {
        return maker_among(groups_, graph_.leaves, cluster);
    }
    [[nodiscard]] std::uint32_t level_of(std::uint32_t cluster) const {
        const std::uint32_t made_by = maker(cluster);
        return made_by == no_group ? 0 : groups_[made_by].level;
    }

    const GraphByGroups& graph_;
    const OriginalSurface& surface_;
    const GroundBounds& bounds_;
    int threads_;
    std::vector<ClusterGroup> groups_;          // those that were taken
    std::vector<std::uint32_t> users_;          // of each cluster; of a leaf, the first group that lists it
    std::vector<std::uint64_t> sums_;           // border_sum of each cluster but leaves
    std::uint64_t listed_{0};                   // clusters, by groups
    std::optional<UnsoundGroup> wrong_growth_;  // the first
    std::vector<std::uint32_t> other_border_;   // groups whose sums differ
};

Result<void> GraphCheck::read(std::uint32_t first, std::vector<GroupPart>& parts) const {
    std::vector<Result<void>> done(parts.size());
    in_parallel(static_cast<int>(parts.size()), threads_, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        done[at] = graph_.part(first + static_cast<std::uint32_t>(i), parts[at]);
    });
    for (const Result<void>& one : done) ORO_CHECK(one);
    return {};
}

// What others will ask of a group; whether its links are right.
std::optional<UnsoundGroup> GraphCheck::take(const GroupPart& part) {
    groups_.push_back(part.group);
    for (const Cluster& cluster : part.made) {
        users_.push_back(cluster.used_by);
        sums_.push_back(
            border_sum(std::span(part.triangles).subspan(cluster.first_triangle, cluster.triangles)));
    }
    listed_ += part.members.size();
    return wrong_members(part);
}

std::optional<UnsoundGroup> GraphCheck::wrong_members(const GroupPart& part) {
    std::int64_t before = -1;
    const auto uses = [&](std::uint32_t member, const std::string& what) {
        return UnsoundGroup{part.number, "uses cluster " + in_words(member) + what};
    };
    for (const std::uint32_t member : part.members) {
        if (member <= before || member >= part.group.first_made)
            return uses(member, " after " + std::to_string(before) + ", expected rising numbers of " +
                                    in_words(graph_.clusters));
        before = member;
        if (auto wrong = wrong_level(part.group, member, groups_, graph_.leaves))
            return UnsoundGroup{part.number, std::move(*wrong)};
        if (member < graph_.leaves && users_[member] == no_group) users_[member] = part.number;
        if (users_[member] != part.number)
            return uses(member, ", which says that it is used by " + group_name(users_[member]));
    }
    return std::nullopt;
}

// Each member says that it is used by the one group that lists it. So where as many are listed as say so,
// none is missing.
std::optional<UnsoundGroup> GraphCheck::wrong_users() const {
    std::uint64_t said = 0;
    for (std::uint32_t i = 0; i < users_.size(); ++i) {
        const bool last = level_of(i) == graph_.levels;
        if (users_[i] != no_group) ++said;
        if ((users_[i] == no_group) == last) continue;
        return UnsoundGroup{i < graph_.leaves ? 0 : maker(i),
                            "has cluster " + in_words(i) + " of level " + in_words(level_of(i)) + " of " +
                                in_words(graph_.levels) + " used by " + group_name(users_[i])};
    }
    if (said != listed_)
        return UnsoundGroup{0, "and others list " + in_words(listed_) + " clusters, but " + in_words(said) +
                                   " say that they are used"};
    return std::nullopt;
}

void GraphCheck::compare(const std::vector<GroupPart>& parts) {
    std::vector<Found> found(parts.size());
    in_parallel(static_cast<int>(parts.size()), threads_, [&](int i) {
        const GroupPart& part = parts[static_cast<std::size_t>(i)];
        found[static_cast<std::size_t>(i)] = {wrong_growth(part), same_border(part)};
    });
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (found[i].growth && !wrong_growth_) wrong_growth_ = found[i].growth;
        if (!found[i].same_border) other_border_.push_back(parts[i].number);
    }
}

std::optional<UnsoundGroup> GraphCheck::wrong_growth(const GroupPart& part) const {
    if (auto wrong = oro::wrong_growth(part, groups_, graph_.leaves))
        return UnsoundGroup{part.number, std::move(*wrong)};
    for (const std::uint32_t member : part.members) {
        if (member >= graph_.leaves) break;
        for (const VertexTriangle& triangle : graph_.leaf(member))
            for (const VertexNumber vertex : triangle)
                if (auto wrong = beyond_sphere(part.group, bounds_.ecef(surface_.vertex(vertex))))
                    return UnsoundGroup{part.number, std::move(*wrong)};
    }
    return std::nullopt;
}

bool GraphCheck::same_border(const GroupPart& part) const {
    std::uint64_t used = 0;
    for (const std::uint32_t member : part.members)
        used += member < graph_.leaves ? border_sum(graph_.leaf(member)) : sums_[member - graph_.leaves];
    return used == border_sum(part.triangles);
}

Result<std::vector<VertexTriangle>> GraphCheck::used_triangles(const GroupPart& part) const {
    std::vector<VertexTriangle> triangles;
    GroupPart below;
    std::uint32_t read = no_group;
    for (const std::uint32_t member : part.members) {
        if (member < graph_.leaves) {
            const std::vector<VertexTriangle> leaf = graph_.leaf(member);
            triangles.insert(triangles.end(), leaf.begin(), leaf.end());
            continue;
        }
        const std::uint32_t made_by = maker(member);
        if (made_by != read) {
            below = {};
            ORO_CHECK(graph_.part(made_by, below));
            read = made_by;
        }
        const Cluster& cluster = below.made[member - below.group.first_made];
        const auto some = std::span(below.triangles).subspan(cluster.first_triangle, cluster.triangles);
        triangles.insert(triangles.end(), some.begin(), some.end());
    }
    return triangles;
}

// A group whose border is another than that of what it uses: by vertices on straight pieces alone?
Result<void> GraphCheck::compare_border(std::uint32_t number, Rim& rim) const {
    GroupPart part;
    ORO_CHECK(graph_.part(number, part));
    ORO_TRY(const std::vector<VertexTriangle> used, used_triangles(part));
    const std::vector<BorderEdge> before = border_of(used), after = border_of(part.triangles);
    rim.same = same_but_straight(surface_, before, after);
    for (const BorderEdge& edge : before) {
        if (!std::binary_search(after.begin(), after.end(), edge))
            rim.gone.push_back({{edge.to, edge.from}, number});
    }
    return {};
}

Result<std::optional<UnsoundGroup>> GraphCheck::torn() {
    std::vector<Rim> rims(other_border_.size());
    in_parallel(static_cast<int>(rims.size()), threads_, [&](int i) {
        Rim& rim = rims[static_cast<std::size_t>(i)];
        rim.read = compare_border(other_border_[static_cast<std::size_t>(i)], rim);
    });
    std::vector<std::vector<Gone>> gone(graph_.levels + 1);
    for (std::size_t i = 0; i < rims.size(); ++i) {
        ORO_CHECK(rims[i].read);
        if (!rims[i].same)
            return std::optional(UnsoundGroup{
                other_border_[i], "made clusters with another border than those that it uses have"});
        std::vector<Gone>& of_level = gone[groups_[other_border_[i]].level];
        of_level.insert(of_level.end(), rims[i].gone.begin(), rims[i].gone.end());
    }
    for (std::uint32_t level = 1; level <= graph_.levels; ++level) {
        if (gone[level].empty()) continue;
        ORO_TRY(const std::optional<UnsoundGroup> wrong, lost_edge(level, gone[level]));
        if (wrong) return wrong;
    }
    return std::optional<UnsoundGroup>();
}

std::uint64_t number_of(const BorderEdge& edge) {
    return std::uint64_t{edge.from} << 32U | edge.to;
}

std::optional<UnsoundGroup> GraphCheck::lost_by(std::span<const VertexTriangle> triangles, std::uint32_t user,
                                                const std::vector<Gone>& gone,
                                                const EdgeNumbers& numbers) const {
    for (const VertexTriangle& triangle : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const auto found = numbers.find(number_of({triangle[i], triangle[(i + 1) % 3]}));
            if (found == numbers.end()) continue;
            const Gone& one = gone[found->second];
            return UnsoundGroup{one.group, "has lost the edge from vertex " + std::to_string(one.edge.to) +
                                               " to " + std::to_string(one.edge.from) +
                                               ", which it shares with group " + std::to_string(user)};
        }
    }
    return std::nullopt;
}

Result<std::optional<UnsoundGroup>> GraphCheck::lost_by(std::uint32_t group, const std::vector<Gone>& gone,
                                                        const EdgeNumbers& numbers) const {
    GroupPart part;
    ORO_CHECK(graph_.part(group, part));
    for (const Cluster& cluster : part.made) {
        const auto triangles = std::span(part.triangles).subspan(cluster.first_triangle, cluster.triangles);
        if (const auto wrong = lost_by(triangles, cluster.used_by, gone, numbers)) return wrong;
    }
    return std::optional<UnsoundGroup>();
}

// Groups of the level below that may have one of the edges: their spheres hold all that they cover.
std::vector<std::uint32_t> GraphCheck::groups_at(std::uint32_t level, const std::vector<Gone>& gone) const {
    std::vector<glm::dvec3> places;
    for (const Gone& one : gone) places.push_back(bounds_.ecef(surface_.vertex(one.edge.from)).m);
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < groups_.size(); ++i)
        if (groups_[i].level + 1 == level) numbers.push_back(i);
    std::vector<char> near(numbers.size());
    in_parallel(static_cast<int>(numbers.size()), threads_, [&](int i) {
        const ClusterGroup& group = groups_[numbers[static_cast<std::size_t>(i)]];
        const double square = group.radius_m * group.radius_m * (1.0 + 1.0e-9);
        near[static_cast<std::size_t>(i)] =
            std::any_of(places.begin(), places.end(), [&](const glm::dvec3& place) {
                const glm::dvec3 offset = place - group.centre.m;
                return glm::dot(offset, offset) <= square;
            });
    });
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (near[i] != 0) found.push_back(numbers[i]);
    return found;
}

// Edges that are gone from a level's groups must have had nothing beyond them.
Result<std::optional<UnsoundGroup>> GraphCheck::lost_edge(std::uint32_t level,
                                                          const std::vector<Gone>& gone) const {
    EdgeNumbers numbers;
    for (std::size_t i = 0; i < gone.size(); ++i) numbers.emplace(number_of(gone[i].edge), i);
    for (std::uint32_t leaf = 0; level == 1 && leaf < graph_.leaves; ++leaf)
        if (const auto wrong = lost_by(graph_.leaf(leaf), users_[leaf], gone, numbers)) return wrong;
    const std::vector<std::uint32_t> groups = groups_at(level, gone);
    using Answer = Result<std::optional<UnsoundGroup>>;
    std::vector<Answer> found(groups.size(), Answer(std::nullopt));
    in_parallel(static_cast<int>(groups.size()), threads_, [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        found[at] = lost_by(groups[at], gone, numbers);
    });
    for (const Answer& one : found)
        if (!one.ok() || one.value()) return one;
    return std::optional<UnsoundGroup>();
}

}  // namespace

Result<std::optional<UnsoundGroup>> unsound_group(const GraphByGroups& graph, const OriginalSurface& surface,
                                                  const GroundBounds& bounds, int threads) {
    return GraphCheck(graph, surface, bounds, threads).run();
}

}  // namespace oro
