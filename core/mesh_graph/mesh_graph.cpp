#include "core/mesh_graph/mesh_graph.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh_graph/distance_cover.h"
#include "core/mesh_graph/group_sphere.h"
#include "core/mesh_graph/mesh_groups.h"
#include "core/mesh_graph/nearest_triangles.h"
#include "core/mesh_graph/original_pieces.h"
#include "core/mesh_graph/space_simplifier.h"

namespace oro {
namespace {

constexpr std::size_t full_group = 1152;
constexpr int most_levels = 80, most_idle_levels = 6, most_idle_in_parts = 2;
// Of the error below a group that the next collapse may cost, or at first of the mesh's spacing; as many
// times more after each level without progress.
constexpr double growth = 4.0, first_share = 0.25;
// What distances in double, and the lattice's own corners, may round: 2 um.
constexpr double rounding_m = 2.0e-6;

// The graph while it grows: what is there, and the level that is being made coarser.
class MeshGraphBuilder {
  public:
    MeshGraphBuilder(std::span<const glm::dvec3> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles, const glm::dvec3& origin_ecef_m,
                     const MeshGraphOptions& options)
        : vertices_(vertices),
          all_(triangles),
          origin_m_(origin_ecef_m),
          options_(options),
          mesh_(corners_of(triangles)) {
        begin(triangles);
        if (options.ground != nullptr && !options.ground->triangles.empty())
            ground_.emplace(options.ground->triangles);
        if (options.parts != nullptr) begin_parts(std::max(0, options.parts->depth - 1));
    }

    MeshGraph build() {
        assign(1);
        add_clusters();
        begin_pieces();
        int idle = 0;
        for (int level = 1; level <= most_levels; ++level) {
            const std::size_t before = live_.size(), groups = group_count_;
            begin_groups(level);
            simplify(std::pow(growth, idle));
            idle = static_cast<double>(live_.size()) > 0.97 * static_cast<double>(before) ? idle + 1 : 0;
            const bool is_in_parts = part_depth_ > 0;
            if (is_in_parts && join_parts(idle)) idle = 0;
            const bool is_done =
                (groups == 1 && live_.size() <= most_cluster_triangles) || idle > most_idle_levels;
            const bool is_last = (is_done && !is_in_parts) || level == most_levels;
            if (is_last)
                group_.assign(live_.size(), 0), group_count_ = 0;
            else
                assign(level + 1);
            measure(!is_last);
            add_clusters();
            end_level(before);
            if (is_last) break;
        }
        return std::move(graph_);
    }

  private:
    [[nodiscard]] std::vector<std::array<glm::dvec3, 3>> corners_of(
        std::span<const std::array<std::uint32_t, 3>> triangles) const {
        std::vector<std::array<glm::dvec3, 3>> corners;
        corners.reserve(triangles.size());
        for (const auto& [a, b, c] : triangles) corners.push_back({vertices_[a], vertices_[b], vertices_[c]});
        return corners;
    }
    [[nodiscard]] std::array<glm::dvec3, 3> corners_of(const LevelTriangle& triangle) const {
        return {vertices_[triangle.corners[0]], vertices_[triangle.corners[1]],
                vertices_[triangle.corners[2]]};
    }
    [[nodiscard]] double ground_off_m() const { return ground_ ? options_.ground->off_m : 0.0; }
    void begin(std::span<const std::array<std::uint32_t, 3>> triangles);
    void begin_pieces();
    void begin_parts(int depth);
    bool join_parts(int idle);
    [[nodiscard]] HalvedParts triangles_of_parts() const;
    void assign(int level);
    void begin_groups(int level);
    [[nodiscard]] bool is_border(std::uint32_t vertex) const { return seen_[vertex] == shared; }
    void simplify(double more);
    void measure(bool goes_on);
    void measure_group(std::size_t number, HandedPieces& handed);
    void end_chains(const std::vector<HandedPieces>& handed, MeshPlaceChains& chains) const;
    void hand_over(std::vector<HandedPieces>& handed);
    void add_clusters();
    void add_clusters_of(std::size_t first, std::size_t last);
    void add_cluster(std::span<const std::uint32_t> triangles, std::uint32_t used_by);
    void end_level(std::size_t triangles_before);

    static constexpr std::uint32_t unseen = ~std::uint32_t{0}, shared = unseen - 1;

    std::span<const glm::dvec3> vertices_;
    std::span<const std::array<std::uint32_t, 3>> all_;
    glm::dvec3 origin_m_;
    const MeshGraphOptions& options_;
    NearestTriangles mesh_;
    std::optional<NearestTriangles> ground_;
    double spacing_m_{};
    int part_depth_{};                  // of the parts that groups keep within
    std::size_t coarse_{};              // triangles of all of them that are few enough to join them
    std::vector<LevelTriangle> live_;   // of the level, those of one maker after another
    std::vector<std::uint32_t> group_;  // that each goes to, from 0
    std::size_t group_count_{};
    std::vector<std::uint32_t> seen_;  // by vertex: the group that has it, or shared
    std::uint32_t first_group_{};      // the level's
    std::uint32_t level_{};
    std::vector<std::size_t> first_made_;              // of each group of the level, in live_, and the end
    std::vector<double> believed_m_;                   // of each
    std::vector<double> least_error_m_;                // that it is to have, for what it dropped
    std::vector<std::vector<PartBox>> on_the_ground_;  // that it dropped
    std::vector<OriginalPieces> pieces_;
    std::vector<std::vector<std::uint32_t>> members_;  // clusters that each group of the next level uses
    MeshGraph graph_;
};

void MeshGraphBuilder::begin(std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::vector<double> sides;
    sides.reserve(3 * triangles.size());
    live_.resize(triangles.size());
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        LevelTriangle& triangle = live_[i];
        triangle.corners = triangles[i], triangle.original = i, triangle.made_by = no_group;
        triangle.from_original_m = 0.0;
        const auto [a, b, c] = corners_of(triangle);
        triangle.samples.push_back((a + b + c) / 3.0);
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
            sides.push_back(glm::distance(from, to));
        // A side that two triangles have is sampled once where they go round it in opposite ways.
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = triangles[i][k], to = triangles[i][(k + 1) % 3];
            if (from < to) triangle.samples.push_back(0.5 * (vertices_[from] + vertices_[to]));
        }
    }
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    spacing_m_ = *middle;
    if (options_.chains == nullptr) return;
    options_.chains->groups.assign(triangles.size(), {});
    options_.chains->on_ground.assign(triangles.size(), 0);
}

void MeshGraphBuilder::begin_parts(int depth) {
    part_depth_ = depth;
    coarse_ = live_.size() / 2;
    if (depth == 0) return;
    coarse_ = std::min(coarse_, coarse_triangles(*options_.parts, all_, depth, options_.part_triangles));
}

// Whether groups may have larger parts from the next level on.
bool MeshGraphBuilder::join_parts(int idle) {
    if (live_.size() > coarse_ && idle <= most_idle_in_parts) return false;
    begin_parts(part_depth_ - 1);
    return true;
}

// The triangles of each part that groups keep within.
HalvedParts MeshGraphBuilder::triangles_of_parts() const {
    HalvedParts parts(std::size_t{1} << 2 * part_depth_);
    for (std::uint32_t i = 0; i < live_.size(); ++i) {
        const NestedPart part =
            part_depth_ == 0 ? NestedPart{} : options_.parts->smallest(live_[i].original).above(part_depth_);
        parts[part.number].push_back(i);
    }
    return parts;
}

// Each group of the first level answers for its own triangles.
void MeshGraphBuilder::begin_pieces() {
    pieces_.resize(group_count_);
    for (std::uint32_t block = 0; block < mesh_.blocks().size(); ++block) {
        for (std::uint32_t i = 0; i < mesh_.blocks()[block].count; ++i) {
            const std::uint32_t number = mesh_.number(4 * block + i);
            pieces_[group_[number]].whole.push_back(WholePiece::triangle(4 * block + i));
            if (options_.chains != nullptr) options_.chains->groups[number].push_back(group_[number]);
        }
    }
    in_parallel(static_cast<int>(pieces_.size()), options_.threads,
                [&](int i) { join_whole_pieces(mesh_, pieces_[static_cast<std::size_t>(i)].whole); });
}

void MeshGraphBuilder::assign(int level) {
    std::vector<glm::dvec3> middles(live_.size());
    for (std::size_t i = 0; i < live_.size(); ++i) {
        const auto [a, b, c] = corners_of(live_[i]);
        middles[i] = (a + b + c) / 3.0;
    }
    group_.assign(live_.size(), 0);
    group_count_ = 0;
    for (std::vector<std::uint32_t>& part : triangles_of_parts())
        for (const std::vector<std::uint32_t>& group :
             halved(middles, std::move(part), full_group, level,
                    [](std::span<const std::uint32_t> some) { return some.size() <= full_group; })) {
            for (const std::uint32_t triangle : group)
                group_[triangle] = static_cast<std::uint32_t>(group_count_);
            ++group_count_;
        }
}

// The groups of a level as the graph has them, and what is on their borders.
void MeshGraphBuilder::begin_groups(int level) {
    level_ = static_cast<std::uint32_t>(level);
    ClusterGraph& graph = graph_.clusters;
    first_group_ = static_cast<std::uint32_t>(graph.groups.size());
    for (std::size_t i = 0; i < group_count_; ++i) {
        ClusterGroup group{};
        group.level = level_, group.complete = true;
        group.first_member = static_cast<std::uint32_t>(graph.members.size());
        group.members = static_cast<std::uint32_t>(members_[i].size());
        graph.members.insert(graph.members.end(), members_[i].begin(), members_[i].end());
        set_sphere(graph, vertices_, origin_m_, group);
        graph.groups.push_back(group);
        graph.groups.back().error_m = largest_member_error_m(graph, graph.groups.back());
    }
    seen_.assign(vertices_.size(), unseen);
    for (std::size_t i = 0; i < live_.size(); ++i)
        for (const std::uint32_t corner : live_[i].corners)
            seen_[corner] = seen_[corner] == unseen || seen_[corner] == group_[i] ? group_[i] : shared;
}

void MeshGraphBuilder::simplify(double more) {
    std::vector<std::vector<LevelTriangle>> of_group(group_count_);
    for (std::size_t i = 0; i < live_.size(); ++i) of_group[group_[i]].push_back(std::move(live_[i]));
    live_.clear();
    believed_m_.assign(group_count_, 0.0), least_error_m_.assign(group_count_, 0.0);
    on_the_ground_.assign(group_count_, {});
    GraphLevel level;
    level.groups = group_count_;
    std::vector<std::size_t> before(group_count_);
    for (std::size_t i = 0; i < group_count_; ++i) {
        before[i] = of_group[i].size();
        level.largest_group = std::max(level.largest_group, before[i]);
    }
    in_parallel(static_cast<int>(group_count_), options_.threads, [&](int number) {
        const auto i = static_cast<std::size_t>(number);
        const double below_m = graph_.clusters.groups[first_group_ + i].error_m;
        SimplifierLimits limits{below_m,
                                more * std::max(growth * below_m, first_share * spacing_m_),
                                std::min(0.01, 0.05 * spacing_m_),
                                spacing_m_,
                                ground_ ? &*ground_ : nullptr,
                                ground_off_m()};
        SpaceSimplifier simplifier(vertices_, mesh_, limits);
        simplifier.simplify(
            std::move(of_group[i]), [&](std::uint32_t vertex) { return is_border(vertex); },
            static_cast<std::size_t>(options_.kept_share * static_cast<double>(before[i])));
        of_group[i] = simplifier.take();
        believed_m_[i] = simplifier.reached_m(), least_error_m_[i] = simplifier.least_error_m();
        on_the_ground_[i] = simplifier.on_the_ground();
    });
    first_made_.assign(1, 0);
    for (std::uint32_t i = 0; i < group_count_; ++i) {
        level.stuck_groups +=
            static_cast<double>(of_group[i].size()) > stuck_share * static_cast<double>(before[i]) ? 1U : 0U;
        for (LevelTriangle& triangle : of_group[i]) {
            triangle.made_by = first_group_ + i;
            live_.push_back(std::move(triangle));
        }
        first_made_.push_back(live_.size());
    }
    level.triangles_out = live_.size();
    graph_.clusters.levels.push_back(level);
}

// Errors of what a level made, and who answers next for which part of the mesh.
void MeshGraphBuilder::measure(bool goes_on) {
    const std::size_t groups = first_made_.size() - 1;
    std::vector<HandedPieces> handed(groups);
    in_parallel(static_cast<int>(groups), options_.threads, [&](int i) {
        measure_group(static_cast<std::size_t>(i), handed[static_cast<std::size_t>(i)]);
    });
    if (options_.chains != nullptr) end_chains(handed, *options_.chains);
    if (goes_on) hand_over(handed);
}

// Places whose pieces lie on the ground from here on.
void MeshGraphBuilder::end_chains(const std::vector<HandedPieces>& handed, MeshPlaceChains& chains) const {
    for (const HandedPieces& one : handed) {
        for (const auto& [piece, user] : one.whole)
            if (user == on_ground)
                each_triangle(mesh_, piece,
                              [&](std::uint32_t place) { chains.on_ground[mesh_.number(place)] = 1; });
        for (const auto& [part, user] : one.parts)
            if (user == on_ground && part.has_marked) chains.on_ground[mesh_.number(part.triangle)] = 1;
    }
}

void MeshGraphBuilder::measure_group(std::size_t number, HandedPieces& handed) {
    ClusterGroup& group = graph_.clusters.groups[first_group_ + number];
    std::vector<std::array<glm::dvec3, 3>> made;
    std::vector<int> users;
    for (std::size_t i = first_made_[number]; i < first_made_[number + 1]; ++i) {
        made.push_back(corners_of(live_[i]));
        users.push_back(static_cast<int>(group_[i]));
    }
    double most_m = group.error_m;
    DistanceCover to_mesh(mesh_, std::max(most_m, believed_m_[number]));
    for (std::size_t i = first_made_[number]; i < first_made_[number + 1]; ++i) {
        if (live_[i].from_original_m < 0.0) {
            OriginalPart polygon;
            const std::array<glm::dvec3, 3>& corners = made[i - first_made_[number]];
            std::copy(corners.begin(), corners.end(), polygon.corners.begin());
            polygon.count = 3;
            to_mesh.begin_bound();
            to_mesh.cover(polygon);
            live_[i].from_original_m = to_mesh.bound_m();
        }
        most_m = std::max(most_m, live_[i].from_original_m);
    }
    // What was dropped lies on the ground.
    const double believed_m = std::max(most_m, to_mesh.found_m());
    if (!on_the_ground_[number].empty())
        add_ground_near(*ground_, on_the_ground_[number], believed_m, made, users);
    const NearestTriangles tree(made);
    DistanceCover from_mesh(tree, believed_m, users);
    if (ground_) from_mesh.put_on_ground_first(*ground_);
    handed = hand_on(mesh_, pieces_[number], from_mesh,
                     options_.chains != nullptr ? std::span<const glm::dvec3>(options_.chains->places)
                                                : std::span<const glm::dvec3>());
    group.error_m = std::max({most_m, handed.bound_m + ground_off_m(), least_error_m_[number]}) + rounding_m;
}

void MeshGraphBuilder::hand_over(std::vector<HandedPieces>& handed) {
    const auto next_group = static_cast<std::uint32_t>(graph_.clusters.groups.size());
    std::vector<OriginalPieces> next(group_count_);
    MeshPlaceChains* const chains = options_.chains;
    for (const HandedPieces& one : handed) {
        for (const auto& [piece, user] : one.whole) {
            if (user == on_ground) continue;
            next[static_cast<std::size_t>(user)].whole.push_back(piece);
            if (chains == nullptr) continue;
            const std::uint32_t group = next_group + static_cast<std::uint32_t>(user);
            each_triangle(mesh_, piece,
                          [&](std::uint32_t place) { chains->groups[mesh_.number(place)].push_back(group); });
        }
        for (const auto& [part, user] : one.parts) {
            if (user == on_ground) continue;
            next[static_cast<std::size_t>(user)].parts.push_back(part);
            if (chains != nullptr && part.has_marked)
                chains->groups[mesh_.number(part.triangle)].push_back(next_group +
                                                                      static_cast<std::uint32_t>(user));
        }
    }
    handed.clear();
    in_parallel(static_cast<int>(next.size()), options_.threads,
                [&](int i) { join_whole_pieces(mesh_, next[static_cast<std::size_t>(i)].whole); });
    pieces_ = std::move(next);
}

// What each maker made, as clusters: those of one user after those of another.
void MeshGraphBuilder::add_clusters() {
    members_.assign(group_count_, {});
    if (graph_.clusters.groups.empty()) {
        add_clusters_of(0, live_.size());
        return;
    }
    for (std::size_t i = 0; i + 1 < first_made_.size(); ++i) {
        ClusterGroup& group = graph_.clusters.groups[first_group_ + i];
        group.first_made = static_cast<std::uint32_t>(graph_.clusters.clusters.size());
        add_clusters_of(first_made_[i], first_made_[i + 1]);
        group.made = static_cast<std::uint32_t>(graph_.clusters.clusters.size()) - group.first_made;
    }
}

void MeshGraphBuilder::add_clusters_of(std::size_t first, std::size_t last) {
    std::vector<glm::dvec3> middles(last - first);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_user;
    for (std::size_t i = first; i < last; ++i) {
        const auto [a, b, c] = corners_of(live_[i]);
        middles[i - first] = (a + b + c) / 3.0;
        by_user.emplace_back(group_[i], static_cast<std::uint32_t>(i - first));
    }
    std::sort(by_user.begin(), by_user.end());
    std::vector<std::uint32_t> corners;
    const auto fits = [&](std::span<const std::uint32_t> triangles) {
        if (triangles.size() > most_cluster_triangles) return false;
        corners.clear();
        for (const std::uint32_t triangle : triangles)
            corners.insert(corners.end(), live_[first + triangle].corners.begin(),
                           live_[first + triangle].corners.end());
        std::sort(corners.begin(), corners.end());
        return std::unique(corners.begin(), corners.end()) - corners.begin() <=
               static_cast<std::ptrdiff_t>(most_cluster_vertices);
    };
    for (std::size_t i = 0; i < by_user.size();) {
        std::vector<std::uint32_t> part;
        const std::uint32_t user = by_user[i].first;
        for (; i < by_user.size() && by_user[i].first == user; ++i) part.push_back(by_user[i].second);
        for (std::vector<std::uint32_t>& cluster :
             halved(middles, std::move(part), most_cluster_triangles, 1, fits)) {
            for (std::uint32_t& triangle : cluster) triangle += static_cast<std::uint32_t>(first);
            add_cluster(cluster, user);
        }
    }
}

void MeshGraphBuilder::add_cluster(std::span<const std::uint32_t> triangles, std::uint32_t used_by) {
    ClusterGraph& graph = graph_.clusters;
    Cluster cluster{};
    cluster.first_triangle = static_cast<std::uint32_t>(graph.triangles.size());
    cluster.triangles = static_cast<std::uint32_t>(triangles.size());
    cluster.made_by = live_[triangles.front()].made_by;
    cluster.used_by =
        group_count_ == 0 ? no_group : static_cast<std::uint32_t>(graph.groups.size()) + used_by;
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t triangle : triangles) {
        const LevelTriangle& one = live_[triangle];
        graph.triangles.push_back({one.corners[0], one.corners[1], one.corners[2]});
        graph_.original_of.push_back(one.original);
        corners.insert(corners.end(), one.corners.begin(), one.corners.end());
    }
    std::sort(corners.begin(), corners.end());
    cluster.vertices =
        static_cast<std::uint32_t>(std::unique(corners.begin(), corners.end()) - corners.begin());
    if (group_count_ > 0) members_[used_by].push_back(static_cast<std::uint32_t>(graph.clusters.size()));
    graph.clusters.push_back(cluster);
}

void MeshGraphBuilder::end_level(std::size_t triangles_before) {
    ClusterGraph& graph = graph_.clusters;
    GraphLevel& level = graph.levels.back();
    level.triangles_in = triangles_before;
    for (std::size_t i = first_group_; i < graph.groups.size(); ++i) {
        level.clusters_out += graph.groups[i].made;
        level.largest_error_m = std::max(level.largest_error_m, graph.groups[i].error_m);
    }
    for (const std::uint32_t seen : seen_) level.locked += seen == shared ? 1U : 0U;
}

}  // namespace

double MeshGraph::largest_error_m() const {
    double most_m = 0.0;
    for (const ClusterGroup& group : clusters.groups) most_m = std::max(most_m, group.error_m);
    return most_m;
}

MeshGraph build_mesh_graph(std::span<const glm::dvec3> vertices,
                           std::span<const std::array<std::uint32_t, 3>> triangles,
                           const glm::dvec3& origin_ecef_m, const MeshGraphOptions& options) {
    return MeshGraphBuilder(vertices, triangles, origin_ecef_m, options).build();
}

}  // namespace oro
