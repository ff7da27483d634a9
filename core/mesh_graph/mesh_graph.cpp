#include "core/mesh_graph/mesh_graph.h"

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/parallel.h"
#include "core/mesh_graph/distance_cover.h"
#include "core/mesh_graph/group_sphere.h"
#include "core/mesh_graph/grown_mesh_graph.h"
#include "core/mesh_graph/level_pieces.h"
#include "core/mesh_graph/level_triangles.h"
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
// Groups of a window: few enough for little memory, and enough for each thread to have several.
constexpr std::size_t least_window = 64, window_of_thread = 16;
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
          memory_(array_memory(options.scratch)),
          spacing_m_(median_side_m()) {
        mesh_.emplace(vertices, triangles, options.scratch);
        begin();
        if (options.ground != nullptr && !options.ground->triangles.empty())
            ground_.emplace(options.ground->triangles);
        if (options.parts != nullptr) begin_parts(std::max(0, options.parts->depth - 1));
    }

    GrownMeshGraph build() {
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
        return finished();
    }

  private:
    [[nodiscard]] std::array<glm::dvec3, 3> corners_of(const std::array<std::uint32_t, 3>& triangle) const {
        return {vertices_[triangle[0]], vertices_[triangle[1]], vertices_[triangle[2]]};
    }
    [[nodiscard]] glm::dvec3 middle_of(std::size_t triangle) const {
        const auto [a, b, c] = corners_of(live_[triangle].corners);
        return (a + b + c) / 3.0;
    }
    [[nodiscard]] double ground_off_m() const { return ground_ ? options_.ground->off_m : 0.0; }
    [[nodiscard]] double median_side_m() const;
    void begin();
    void begin_pieces();
    void begin_parts(int depth);
    bool join_parts(int idle);
    void order_by_part();
    void assign(int level);
    // Triangles of a group, by their numbers among the level's, rising.
    [[nodiscard]] std::span<const std::uint32_t> triangles_of(std::size_t group) const {
        return std::span(by_group_).subspan(first_of_group_[group],
                                            first_of_group_[group + 1] - first_of_group_[group]);
    }
    void begin_groups(int level);
    [[nodiscard]] bool is_border(std::uint32_t vertex) const { return seen_[vertex] == shared; }
    [[nodiscard]] std::size_t window_groups() const;
    void end_window(std::size_t bytes) const;
    void simplify(double more);
    std::vector<LevelTriangle> simplified(std::size_t group, double more);
    void measure(bool goes_on);
    void measured(std::size_t group, StoredPieces& handed);
    double measure_made(std::size_t group, double least_m);
    void note_chains(std::span<const StoredPieces> handed, bool goes_on) const;
    void add_clusters();
    void add_clusters_of_maker(std::size_t first, std::size_t last);
    void add_clusters_of(std::span<const std::uint32_t> triangles, std::uint32_t user);
    void add_cluster(std::span<const std::uint32_t> triangles, std::uint32_t used_by);
    void end_level(std::size_t triangles_before);
    GrownMeshGraph finished();

    static constexpr std::uint32_t unseen = ~std::uint32_t{0}, shared = unseen - 1;

    std::span<const glm::dvec3> vertices_;
    std::span<const std::array<std::uint32_t, 3>> all_;
    glm::dvec3 origin_m_;
    const MeshGraphOptions& options_;
    std::pmr::memory_resource* memory_;  // for what is of the mesh's size
    double spacing_m_{};
    std::optional<NearestTriangles> mesh_;
    std::optional<NearestTriangles> ground_;
    int part_depth_{};              // of the parts that groups keep within
    std::size_t coarse_{};          // triangles of all of them that are few enough to join them
    LevelTriangles live_{memory_};  // of the level, those of one maker after another
    std::pmr::vector<std::uint32_t> group_{memory_};  // that each goes to, from 0
    std::size_t group_count_{};
    std::pmr::vector<std::uint32_t> by_group_{memory_};  // triangles, those of one group after another
    std::vector<std::size_t> first_of_group_;            // in by_group_, and the end
    std::pmr::vector<std::uint32_t> seen_{memory_};      // by vertex: the group that has it, or shared
    std::uint32_t first_group_{};                        // the level's
    std::uint32_t level_{};
    std::vector<std::size_t> first_made_;  // of each group of the level, in live_, and the end
    std::vector<double> believed_m_;       // of each
    std::vector<double> least_error_m_;    // that it is to have, for what it dropped
    LevelPieces pieces_{options_.scratch};
    std::vector<std::vector<std::uint32_t>> members_;  // clusters that each group of the next level uses
    // Of the graph.
    std::pmr::vector<VertexTriangle> graph_triangles_{memory_};
    std::pmr::vector<std::uint32_t> original_of_{memory_};
    ClusterGraph graph_;  // without triangles
};

double MeshGraphBuilder::median_side_m() const {
    std::pmr::vector<double> sides(memory_);
    sides.reserve(3 * all_.size());
    for (const auto& triangle : all_) {
        const auto [a, b, c] = corners_of(triangle);
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
            sides.push_back(glm::distance(from, to));
    }
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    return *middle;
}

void MeshGraphBuilder::begin() {
    live_.reserve(all_.size());
    for (const auto& triangle : all_) live_.add_original(triangle);
    constexpr std::size_t all_levels = 3;  // have so many times the mesh's triangles, mostly
    graph_triangles_.reserve(all_levels * all_.size());
    original_of_.reserve(all_levels * all_.size());
    if (options_.chains == nullptr) return;
    options_.chains->groups.assign(all_.size(), {});
    options_.chains->on_ground.assign(all_.size(), 0);
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

std::size_t MeshGraphBuilder::window_groups() const {
    if (options_.window_groups > 0) return options_.window_groups;
    return std::max(least_window, window_of_thread * static_cast<std::size_t>(std::max(1, options_.threads)));
}

// bytes: what was in memory.
void MeshGraphBuilder::end_window(std::size_t bytes) const {
    if (options_.most_window_bytes != nullptr)
        *options_.most_window_bytes = std::max(*options_.most_window_bytes, bytes);
    if (options_.scratch != nullptr) options_.scratch->drop_pages();
}

// Each group of the first level answers for its own triangles.
void MeshGraphBuilder::begin_pieces() {
    pieces_ = LevelPieces(options_.scratch);
    constexpr std::uint32_t blocks_at_a_time = 1U << 16U;
    const auto blocks = static_cast<std::uint32_t>(mesh_->blocks().size());
    for (std::uint32_t first = 0; first < blocks; first += blocks_at_a_time) {
        StoredPieces handed(options_.scratch);
        for (std::uint32_t block = first; block < std::min(blocks, first + blocks_at_a_time); ++block)
            for (std::uint32_t i = 0; i < mesh_->blocks()[block].count; ++i) {
                const std::uint32_t number = mesh_->number(4 * block + i);
                handed.take_whole(WholePiece::triangle(4 * block + i), static_cast<int>(group_[number]));
                if (options_.chains != nullptr) options_.chains->groups[number].push_back(group_[number]);
            }
        pieces_.take(std::span(&handed, 1));
        end_window(0);
    }
    pieces_.deal(group_count_, *mesh_, options_.threads);
    end_window(0);
}

// Triangles of each part that groups keep within, into by_group_, and where each part's begin.
void MeshGraphBuilder::order_by_part() {
    const auto part_of = [&](std::size_t triangle) {
        return part_depth_ == 0
                   ? std::size_t{0}
                   : std::size_t{
                         options_.parts->smallest(live_[triangle].original).above(part_depth_).number};
    };
    std::vector<std::size_t>& first = first_of_group_;
    first.assign((std::size_t{1} << 2 * part_depth_) + 1, 0);
    for (std::size_t i = 0; i < live_.size(); ++i) ++first[part_of(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    by_group_.resize(live_.size());
    std::vector<std::size_t> next(first.begin(), first.end());
    for (std::size_t i = 0; i < live_.size(); ++i)
        by_group_[next[part_of(i)]++] = static_cast<std::uint32_t>(i);
}

void MeshGraphBuilder::assign(int level) {
    order_by_part();
    const std::vector<std::size_t> first_of_part = std::move(first_of_group_);
    std::pmr::vector<glm::dvec3> middles(memory_);
    middles.reserve(live_.size());
    for (std::size_t i = 0; i < live_.size(); ++i) middles.push_back(middle_of(i));
    end_window(0);
    group_.assign(live_.size(), 0);
    group_count_ = 0;
    first_of_group_.assign(1, 0);
    for (std::size_t part = 0; part + 1 < first_of_part.size(); ++part)
        halve_in_place(
            middles,
            std::span(by_group_).subspan(first_of_part[part], first_of_part[part + 1] - first_of_part[part]),
            full_group, level, [](std::span<const std::uint32_t> some) { return some.size() <= full_group; },
            [&](std::span<const std::uint32_t> group) {
                for (const std::uint32_t triangle : group)
                    group_[triangle] = static_cast<std::uint32_t>(group_count_);
                first_of_group_.push_back(first_of_group_.back() + group.size());
                if (++group_count_ % window_groups() == 0) end_window(0);
            });
    end_window(0);
}

// The groups of a level as the graph has them, and what is on their borders.
void MeshGraphBuilder::begin_groups(int level) {
    level_ = static_cast<std::uint32_t>(level);
    ClusterGraph& graph = graph_;
    first_group_ = static_cast<std::uint32_t>(graph.groups.size());
    for (std::size_t i = 0; i < group_count_; ++i) {
        ClusterGroup group{};
        group.level = level_, group.complete = true;
        group.first_member = static_cast<std::uint32_t>(graph.members.size());
        group.members = static_cast<std::uint32_t>(members_[i].size());
        graph.members.insert(graph.members.end(), members_[i].begin(), members_[i].end());
        set_sphere(graph, graph_triangles_, vertices_, origin_m_, group);
        graph.groups.push_back(group);
        graph.groups.back().error_m = largest_member_error_m(graph, graph.groups.back());
    }
    seen_.assign(vertices_.size(), unseen);
    for (std::size_t i = 0; i < live_.size(); ++i)
        for (const std::uint32_t corner : live_[i].corners)
            seen_[corner] = seen_[corner] == unseen || seen_[corner] == group_[i] ? group_[i] : shared;
    end_window(0);
}

// What a group's triangles become.
std::vector<LevelTriangle> MeshGraphBuilder::simplified(std::size_t group, double more) {
    std::vector<LevelTriangle> triangles;
    triangles.reserve(triangles_of(group).size());
    for (const std::uint32_t triangle : triangles_of(group))
        triangles.push_back(live_.unpacked(triangle, vertices_));
    const std::size_t before = triangles.size();
    const double below_m = graph_.groups[first_group_ + group].error_m;
    SimplifierLimits limits{below_m,
                            more * std::max(growth * below_m, first_share * spacing_m_),
                            std::min(0.01, 0.05 * spacing_m_),
                            spacing_m_,
                            ground_ ? &*ground_ : nullptr,
                            ground_off_m()};
    const auto stays = [this](std::uint32_t vertex) { return is_border(vertex); };
    const auto aim = static_cast<std::size_t>(options_.kept_share * static_cast<double>(before));
    std::vector<LevelTriangle> made;
    if (options_.simplifier != nullptr) {
        made = simplified_by(*options_.simplifier, {vertices_, {}, stays, aim, limits.most_m},
                             std::move(triangles));
    } else {
        SpaceSimplifier simplifier(vertices_, *mesh_, limits);
        simplifier.simplify(std::move(triangles), stays, aim);
        believed_m_[group] = simplifier.reached_m(), least_error_m_[group] = simplifier.least_error_m();
        made = simplifier.take();
    }
    for (LevelTriangle& triangle : made) triangle.made_by = first_group_ + static_cast<std::uint32_t>(group);
    return made;
}

std::size_t bytes_of(std::span<const std::vector<LevelTriangle>> triangles) {
    std::size_t bytes = 0;
    for (const std::vector<LevelTriangle>& of_group : triangles)
        for (const LevelTriangle& triangle : of_group)
            bytes += sizeof(LevelTriangle) + triangle.samples.size() * sizeof(glm::dvec3);
    return bytes;
}

void MeshGraphBuilder::simplify(double more) {
    believed_m_.assign(group_count_, 0.0), least_error_m_.assign(group_count_, 0.0);
    GraphLevel level;
    level.groups = group_count_;
    LevelTriangles made(memory_);
    made.reserve(live_.size());
    first_made_.assign(1, 0);
    for (std::size_t first = 0; first < group_count_; first += window_groups()) {
        std::vector<std::vector<LevelTriangle>> of_group(std::min(window_groups(), group_count_ - first));
        in_parallel(static_cast<int>(of_group.size()), options_.threads, [&](int number) {
            const auto i = static_cast<std::size_t>(number);
            of_group[i] = simplified(first + i, more);
        });
        for (std::size_t i = 0; i < of_group.size(); ++i) {
            const std::size_t before = triangles_of(first + i).size(), left = of_group[i].size();
            level.largest_group = std::max(level.largest_group, before);
            level.stuck_groups +=
                static_cast<double>(left) > stuck_share * static_cast<double>(before) ? 1U : 0U;
            first_made_.push_back(first_made_.back() + left);
        }
        made.add(of_group);
        end_window(bytes_of(of_group));
    }
    live_ = std::move(made);
    level.triangles_out = live_.size();
    graph_.levels.push_back(level);
}

// Errors of what a level made, and who answers next for which part of the mesh.
void MeshGraphBuilder::measure(bool goes_on) {
    const std::size_t groups = first_made_.size() - 1;
    LevelPieces next(options_.scratch);
    for (std::size_t first = 0; first < groups; first += window_groups()) {
        std::vector<StoredPieces> handed;
        for (std::size_t i = first; i < std::min(groups, first + window_groups()); ++i)
            handed.emplace_back(options_.scratch);
        in_parallel(static_cast<int>(handed.size()), options_.threads, [&](int number) {
            const auto i = static_cast<std::size_t>(number);
            measured(first + i, handed[i]);
        });
        if (options_.chains != nullptr) note_chains(handed, goes_on);
        if (goes_on) next.take(handed);
        end_window(0);
    }
    if (!goes_on) return;
    pieces_ = std::move(next);
    pieces_.deal(group_count_, *mesh_, options_.threads);
    end_window(0);
}

// Which groups answer for a place from here on, or that its piece lies on the ground.
void MeshGraphBuilder::note_chains(std::span<const StoredPieces> handed, bool goes_on) const {
    MeshPlaceChains& chains = *options_.chains;
    const auto next_group = static_cast<std::uint32_t>(graph_.groups.size());
    const auto note = [&](std::uint32_t place, int user) {
        const std::uint32_t number = mesh_->number(place);
        if (user == on_ground)
            chains.on_ground[number] = 1;
        else if (goes_on)
            chains.groups[number].push_back(next_group + static_cast<std::uint32_t>(user));
    };
    for (const StoredPieces& one : handed) {
        for (const auto& [piece, user] : one.whole())
            each_triangle(*mesh_, piece, [&, to = user](std::uint32_t place) { note(place, to); });
        for (const StoredPieces::Part& part : one.parts())
            if (part.has_marked) note(part.triangle, part.user);
    }
}

// The largest distance of what a group made from the mesh, at least least_m.
double MeshGraphBuilder::measure_made(std::size_t group, double least_m) {
    double most_m = least_m;
    DistanceCover to_mesh(*mesh_, std::max(most_m, believed_m_[group]));
    for (std::size_t i = first_made_[group]; i < first_made_[group + 1]; ++i) {
        if (live_[i].from_original_m < 0.0) {
            OriginalPart polygon;
            const std::array<glm::dvec3, 3> corners = corners_of(live_[i].corners);
            std::copy(corners.begin(), corners.end(), polygon.corners.begin());
            polygon.count = 3;
            to_mesh.begin_bound();
            to_mesh.cover(polygon);
            live_[i].from_original_m = to_mesh.bound_m();
        }
        most_m = std::max(most_m, live_[i].from_original_m);
    }
    return most_m;
}

void MeshGraphBuilder::measured(std::size_t number, StoredPieces& handed) {
    ClusterGroup& group = graph_.groups[first_group_ + number];
    std::vector<std::array<glm::dvec3, 3>> made;
    std::vector<int> users;
    for (std::size_t i = first_made_[number]; i < first_made_[number + 1]; ++i) {
        made.push_back(corners_of(live_[i].corners));
        users.push_back(static_cast<int>(group_[i]));
    }
    const double most_m = measure_made(number, group.error_m);
    const NearestTriangles tree(made);
    // By nothing that is not in the graph itself: whoever checks it goes the same way (understated_error()).
    DistanceCover from_mesh(tree, group.error_m, users);
    if (ground_) from_mesh.put_on_ground_first(*ground_);
    const double bound_m = hand_on(
        *mesh_, pieces_.whole_of(number), pieces_.parts_of(number),
        [&](std::size_t part) { return pieces_.part(number, part); }, from_mesh,
        options_.chains != nullptr ? std::span<const glm::dvec3>(options_.chains->places)
                                   : std::span<const glm::dvec3>(),
        handed);
    group.error_m = std::max({most_m, bound_m + ground_off_m(), least_error_m_[number]}) + rounding_m;
}

// What each maker made, as clusters: those of one user after those of another.
void MeshGraphBuilder::add_clusters() {
    members_.assign(group_count_, {});
    ClusterGraph& graph = graph_;
    if (graph.groups.empty()) {
        for (std::uint32_t i = 0; i < group_count_; ++i) {
            add_clusters_of(triangles_of(i), i);
            if ((i + 1) % window_groups() == 0) end_window(0);
        }
        return;
    }
    for (std::size_t i = 0; i + 1 < first_made_.size(); ++i) {
        ClusterGroup& group = graph.groups[first_group_ + i];
        group.first_made = static_cast<std::uint32_t>(graph.clusters.size());
        add_clusters_of_maker(first_made_[i], first_made_[i + 1]);
        group.made = static_cast<std::uint32_t>(graph.clusters.size()) - group.first_made;
        if ((i + 1) % window_groups() == 0) end_window(0);
    }
}

void MeshGraphBuilder::add_clusters_of_maker(std::size_t first, std::size_t last) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> by_user;
    for (std::size_t i = first; i < last; ++i) by_user.emplace_back(group_[i], static_cast<std::uint32_t>(i));
    std::sort(by_user.begin(), by_user.end());
    std::vector<std::uint32_t> part;
    for (std::size_t i = 0; i < by_user.size();) {
        part.clear();
        const std::uint32_t user = by_user[i].first;
        for (; i < by_user.size() && by_user[i].first == user; ++i) part.push_back(by_user[i].second);
        add_clusters_of(part, user);
    }
}

// triangles: of the level, rising.
void MeshGraphBuilder::add_clusters_of(std::span<const std::uint32_t> triangles, std::uint32_t user) {
    std::vector<glm::dvec3> middles;
    for (const std::uint32_t triangle : triangles) middles.push_back(middle_of(triangle));
    std::vector<std::uint32_t> order(triangles.size()), corners;
    std::iota(order.begin(), order.end(), 0U);
    const auto fits = [&](std::span<const std::uint32_t> some) {
        if (some.size() > most_cluster_triangles) return false;
        corners.clear();
        for (const std::uint32_t i : some)
            corners.insert(corners.end(), live_[triangles[i]].corners.begin(),
                           live_[triangles[i]].corners.end());
        std::sort(corners.begin(), corners.end());
        return std::unique(corners.begin(), corners.end()) - corners.begin() <=
               static_cast<std::ptrdiff_t>(most_cluster_vertices);
    };
    std::vector<std::uint32_t> cluster;
    halve_in_place(middles, order, most_cluster_triangles, 1, fits, [&](std::span<const std::uint32_t> some) {
        cluster.clear();
        for (const std::uint32_t i : some) cluster.push_back(triangles[i]);
        add_cluster(cluster, user);
    });
}

void MeshGraphBuilder::add_cluster(std::span<const std::uint32_t> triangles, std::uint32_t used_by) {
    ClusterGraph& graph = graph_;
    Cluster cluster{};
    cluster.first_triangle = static_cast<std::uint32_t>(graph_triangles_.size());
    cluster.triangles = static_cast<std::uint32_t>(triangles.size());
    cluster.made_by = live_[triangles.front()].made_by;
    cluster.used_by =
        group_count_ == 0 ? no_group : static_cast<std::uint32_t>(graph.groups.size()) + used_by;
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t triangle : triangles) {
        const StoredTriangle& one = live_[triangle];
        graph_triangles_.push_back({one.corners[0], one.corners[1], one.corners[2]});
        original_of_.push_back(one.original);
        corners.insert(corners.end(), one.corners.begin(), one.corners.end());
    }
    std::sort(corners.begin(), corners.end());
    cluster.vertices =
        static_cast<std::uint32_t>(std::unique(corners.begin(), corners.end()) - corners.begin());
    if (group_count_ > 0) members_[used_by].push_back(static_cast<std::uint32_t>(graph.clusters.size()));
    graph.clusters.push_back(cluster);
}

void MeshGraphBuilder::end_level(std::size_t triangles_before) {
    ClusterGraph& graph = graph_;
    GraphLevel& level = graph.levels.back();
    level.triangles_in = triangles_before;
    for (std::size_t i = first_group_; i < graph.groups.size(); ++i) {
        level.clusters_out += graph.groups[i].made;
        level.largest_error_m = std::max(level.largest_error_m, graph.groups[i].error_m);
    }
    for (const std::uint32_t seen : seen_) level.locked += seen == shared ? 1U : 0U;
    end_window(0);
}

// The graph, once all else is given back.
GrownMeshGraph MeshGraphBuilder::finished() {
    mesh_.reset();
    pieces_ = LevelPieces(options_.scratch);
    live_ = LevelTriangles(memory_);
    return {std::move(graph_), std::move(graph_triangles_), std::move(original_of_)};
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
    GrownMeshGraph grown = grow_mesh_graph(vertices, triangles, origin_ecef_m, options);
    MeshGraph graph;
    graph.clusters = std::move(grown.clusters);
    graph.original_of.assign(grown.original_of.begin(), grown.original_of.end());
    grown.original_of = std::pmr::vector<std::uint32_t>(grown.original_of.get_allocator());
    graph.clusters.triangles.assign(grown.triangles.begin(), grown.triangles.end());
    return graph;
}

GrownMeshGraph grow_mesh_graph(std::span<const glm::dvec3> vertices,
                               std::span<const std::array<std::uint32_t, 3>> triangles,
                               const glm::dvec3& origin_ecef_m, const MeshGraphOptions& options) {
    return MeshGraphBuilder(vertices, triangles, origin_ecef_m, options).build();
}

}  // namespace oro
