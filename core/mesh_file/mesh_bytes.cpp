#include "core/mesh_file/mesh_bytes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "core/base/little_endian.h"
#include "core/mesh_file/group_maps.h"
#include "core/mesh_file/leaf_code.h"
#include "core/mesh_graph/group_sphere.h"

// The order of the bytes: MeshNumbers; the ground's fingerprint where there is one, which a bit of the
// levels' count says; groups of each level, 4 bytes each; then, range coded, the leaves, each with its count,
// its triangles, unless another bit of the levels' count says that they are elsewhere, and its user; and
// level by level the groups, each with the count of its clusters, its maps, its error and its clusters'
// users.
namespace oro {
namespace {

constexpr std::uint32_t most_levels = 80, most_used_triangles = 4096;
constexpr std::uint32_t has_ground = 1U << 31U, leaves_elsewhere = 1U << 30U;  // beside the number of levels
// After so many what lies in scratch files is out of memory: some 100,000 triangles.
constexpr std::uint32_t window_leaves = 1024, window_groups = 64;

struct MeshNumbers {
    LatticeSteps origin{}, least{};
    std::uint32_t vertices{}, triangles{}, labels{}, leaves{}, clusters{}, levels{};
    std::uint32_t graph_triangles{};  // of all levels
};

template <class Visit>
void visit_numbers(Visit& visit, auto& numbers) {
    for (auto& step : numbers.origin) visit(step);
    for (auto& step : numbers.least) visit(step);
    visit(numbers.vertices), visit(numbers.triangles), visit(numbers.labels), visit(numbers.leaves);
    visit(numbers.clusters), visit(numbers.levels), visit(numbers.graph_triangles);
}

// What no mesh has; "" where all is well.
std::string implausible(const MeshNumbers& numbers) {
    // The Earth and 100 km around it.
    constexpr std::int64_t most_steps = 6600000LL * 2048;
    for (const LatticeSteps& at : {numbers.origin, numbers.least})
        for (const std::int64_t step : at)
            if (step < -2 * most_steps || step > most_steps) return "lies outside of the Earth";
    if (numbers.triangles == 0 || numbers.triangles > most_stored_triangles)
        return "has " + std::to_string(numbers.triangles) + " triangles, expected 1 to 100,000,000";
    if (numbers.vertices < 3 || numbers.vertices > 3 * numbers.triangles)
        return "has " + std::to_string(numbers.vertices) + " vertices, which its triangles do not have";
    if (numbers.levels == 0 || numbers.levels > most_levels)
        return "has " + std::to_string(numbers.levels) + " levels, expected 1 to 80";
    if (numbers.graph_triangles < numbers.triangles || numbers.graph_triangles > most_graph_triangles)
        return "has " + std::to_string(numbers.graph_triangles) + " triangles at all levels";
    if (numbers.leaves == 0 || numbers.leaves > numbers.triangles || numbers.clusters < numbers.leaves ||
        numbers.clusters > numbers.graph_triangles)
        return "has " + std::to_string(numbers.clusters) + " clusters, which its triangles do not fill";
    if (numbers.labels > numbers.triangles + 1U + 2U * most_stored_triangles) return "has too many labels";
    return "";
}

// Both ways: a decoder fills `mesh`, and an encoder, too, from `source`.
template <class Coder>
class MeshBytesCode {
  public:
    MeshBytesCode(Coder& coder, const MeshNumbers& numbers, std::vector<std::uint32_t> groups,
                  const MeshToStore* source, CodedMesh<Coder>& mesh, ScratchMemory* scratch,
                  LeavesIn leaves_in, MeshLeaves* given_leaves)
        : coder_(coder),
          leaves_in_(leaves_in),
          given_leaves_(given_leaves),
          numbers_(numbers),
          groups_(std::move(groups)),
          source_(source),
          mesh_(mesh),
          scratch_(scratch),
          leaf_(numbers.least, numbers.vertices, numbers.labels, array_memory(scratch)),
          maps_(0, array_memory(scratch)),
          counted_by_(array_memory(scratch)) {}

    // "" where all is well.
    std::string code() {
        if constexpr (Coder::writes) {
            leaf_.expect(numbers_.triangles);
            given_original_.reserve(numbers_.triangles), turn_.reserve(numbers_.triangles);
        }
        if (std::string wrong = leaves(); !wrong.empty()) return wrong;
        maps_ = GroupMaps(mesh_.places.size(), array_memory(scratch_));
        vertices_m_.reserve(mesh_.places.size());
        for (const LatticeSteps& at : mesh_.places)
            vertices_m_.push_back(
                metres_of({at[0] - mesh_.origin[0], at[1] - mesh_.origin[1], at[2] - mesh_.origin[2]}));
        if (has_flat(0)) return "has a triangle without an area";
        for (std::uint32_t i = 0; i < numbers_.levels; ++i)
            if (std::string wrong = level(i); !wrong.empty()) return wrong;
        if (graph().clusters.size() != numbers_.clusters || triangles().size() != numbers_.graph_triangles)
            return "has " + std::to_string(graph().clusters.size()) + " clusters of " +
                   std::to_string(triangles().size()) + " triangles, expected " +
                   std::to_string(numbers_.clusters) + " of " + std::to_string(numbers_.graph_triangles);
        return "";
    }

  private:
    [[nodiscard]] ClusterGraph& graph() { return graph_of(mesh_); }
    [[nodiscard]] auto& triangles() const { return triangles_of(mesh_); }
    [[nodiscard]] std::span<const VertexTriangle> triangles_in(const Cluster& cluster) const {
        return std::span(triangles()).subspan(cluster.first_triangle, cluster.triangles);
    }
    [[nodiscard]] auto& originals() const { return originals_of(mesh_); }
    [[nodiscard]] const ClusterGraph& given() const { return source_->graph.clusters; }
    static glm::dvec3 metres_of(const LatticeSteps& at) {
        return {static_cast<double>(at[0]) / lattice_steps_per_m,
                static_cast<double>(at[1]) / lattice_steps_per_m,
                static_cast<double>(at[2]) / lattice_steps_per_m};
    }
    // An encoder's, now and then: what was told, and what was asked for it, is out of memory.
    void end_window() {
        if constexpr (Coder::writes) {
            const std::vector<std::byte> some = coder_.take();
            static_cast<void>(aside_.take());
            mesh_.bytes.insert(mesh_.bytes.end(), some.begin(), some.end());
            if (scratch_ != nullptr) scratch_->drop_pages();
        }
    }
    [[nodiscard]] bool is_cut_off() const {
        if constexpr (Coder::writes)
            return false;
        else
            return coder_.is_wrong();
    }
    std::string leaves();
    std::string leaf(std::uint32_t number);
    bool leaf_triangles(std::uint32_t count, const LeafSource& source);
    std::string take_given_leaves();
    std::string used_by(std::size_t number, std::uint32_t groups_above, std::uint32_t first_above);
    std::string level(std::uint32_t number);
    void begin_groups(std::uint32_t number, std::uint32_t first_group);
    std::pmr::vector<char> borders(std::uint32_t first_group);
    std::string group(std::uint32_t number, std::span<const char> is_border, std::uint32_t groups_above,
                      std::uint32_t first_above);
    std::vector<GroupMaps::Left> left_of(std::uint32_t number,
                                         std::span<const std::uint32_t> originals) const;
    std::string clusters_of(std::uint32_t number, std::uint32_t made, std::span<const GroupMaps::Left> left,
                            std::span<const std::uint32_t> originals);
    std::string error(ClusterGroup& group, double least_m);
    [[nodiscard]] std::string too_full(const Cluster& cluster);
    // Whether a triangle of the graph, that or a later one, has no area.
    [[nodiscard]] bool has_flat(std::size_t first) const {
        const auto& all = triangles();
        return std::any_of(all.begin() + static_cast<std::ptrdiff_t>(first), all.end(), [&](const auto& one) {
            return glm::cross(vertices_m_[one[1]] - vertices_m_[one[0]],
                              vertices_m_[one[2]] - vertices_m_[one[0]]) == glm::dvec3(0.0);
        });
    }

    Coder& coder_;
    LeavesIn leaves_in_;
    MeshLeaves* given_leaves_;  // a decoder's, where leaves are elsewhere
    RangeEncoder aside_;        // what becomes of an encoder's leaves there: nothing
    MeshNumbers numbers_;
    std::vector<std::uint32_t> groups_;  // by level
    const MeshToStore* source_;
    CodedMesh<Coder>& mesh_;
    ScratchMemory* scratch_;
    LeafCode leaf_;
    GroupMaps maps_;
    // By vertex: the last cluster that it was counted for; 0: none.
    std::pmr::vector<std::uint32_t> counted_by_;
    std::pmr::vector<glm::dvec3> vertices_m_{array_memory(scratch_)};
    // An encoder's, by triangles of the mesh: which it was given, and which of its corners comes first.
    std::pmr::vector<std::uint32_t> given_original_{array_memory(scratch_)};
    std::pmr::vector<std::uint8_t> turn_{array_memory(scratch_)};
    SmallNumber leaf_room_, made_;
    NearZero user_;
    std::uint32_t last_user_{};
    std::uint32_t first_live_{};  // the first cluster of the level below
};

template <class Coder>
std::string MeshBytesCode<Coder>::too_full(const Cluster& cluster) {
    const auto number = static_cast<std::uint32_t>(graph().clusters.size());  // of the next one
    std::uint32_t vertices = 0;
    // No more of it than there are vertices so far: bytes may state any number of these.
    counted_by_.resize(mesh_.places.size());
    for (const VertexTriangle& triangle : triangles_in(cluster))
        for (const std::uint32_t corner : triangle) {
            vertices += counted_by_[corner] == number ? 0U : 1U;
            counted_by_[corner] = number;
        }
    graph().clusters.back().vertices = vertices;
    if (cluster.triangles >= 1 && cluster.triangles <= most_cluster_triangles &&
        vertices <= most_cluster_vertices)
        return "";
    return "has a cluster of " + std::to_string(cluster.triangles) + " triangles and " +
           std::to_string(vertices) + " vertices";
}

// The group of the next level that makes a cluster coarser.
template <class Coder>
std::string MeshBytesCode<Coder>::used_by(std::size_t number, std::uint32_t groups_above,
                                          std::uint32_t first_above) {
    if (groups_above == 0) return "";
    std::uint32_t user = 0;
    if constexpr (Coder::writes) user = given().clusters[number].used_by - first_above;
    const auto step = static_cast<std::int32_t>(user - last_user_);
    user = last_user_ + static_cast<std::uint32_t>(user_.code(coder_, step));
    if (user >= groups_above) return "whose clusters a group of another level uses";
    last_user_ = user;
    graph().clusters[number].used_by = first_above + user;
    return "";
}

// False where a decoder's bytes tell none such.
template <class Coder>
bool MeshBytesCode<Coder>::leaf_triangles(std::uint32_t count, const LeafSource& source) {
    if constexpr (Coder::writes) {
        return leaf_.code(leaves_in_ == LeavesIn::payloads ? aside_ : coder_, count, source, source_->places,
                          mesh_);
    } else {
        if (leaves_in_ != LeavesIn::payloads) return leaf_.code(coder_, count, source, {}, mesh_);
        const std::size_t first = triangles().size();
        const auto append = [&](auto& to, const auto& from) {
            const auto begin = from.begin() + static_cast<std::ptrdiff_t>(first);
            to.insert(to.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
        };
        append(triangles(), given_leaves_->triangles);
        if (numbers_.labels > 0) append(mesh_.labels, given_leaves_->labels);
        return true;
    }
}

// What is wrong with leaves that a decoder is given; "" where all is well.
template <class Coder>
std::string MeshBytesCode<Coder>::take_given_leaves() {
    if constexpr (!Coder::writes) {
        if (leaves_in_ != LeavesIn::payloads) return "";
        if (given_leaves_ == nullptr) return "has its triangles elsewhere";
        MeshLeaves& given = *given_leaves_;
        if (given.triangles.size() != numbers_.triangles || given.places.size() != numbers_.vertices)
            return "has groups of " + std::to_string(given.triangles.size()) + " triangles and " +
                   std::to_string(given.places.size()) + " vertices, expected " +
                   std::to_string(numbers_.triangles) + " and " + std::to_string(numbers_.vertices);
        const bool has_labels = numbers_.labels > 0;
        if (given.labels.size() != (has_labels ? given.triangles.size() : 0) ||
            std::ranges::any_of(given.labels, [&](std::uint32_t one) { return one >= numbers_.labels; }))
            return "has groups of other features than it states";
        mesh_.places = std::move(given.places);
    }
    return "";
}

template <class Coder>
std::string MeshBytesCode<Coder>::leaf(std::uint32_t number) {
    LeafSource source;
    std::vector<std::uint32_t> labels;
    std::uint32_t count = 0;
    if constexpr (Coder::writes) {
        const Cluster& cluster = given().clusters[number];
        count = cluster.triangles;
        source.triangles = source_->graph.triangles_of(cluster);
        if (numbers_.labels > 0)
            for (std::uint32_t i = 0; i < count; ++i)
                labels.push_back(source_->labels[source_->graph.original_of[cluster.first_triangle + i]]);
        source.labels = labels;
    }
    constexpr auto most = static_cast<std::uint32_t>(most_cluster_triangles);
    const std::uint32_t room = leaf_room_.code(coder_, most - count);
    if (room >= most) return "has an empty leaf";
    count = most - room;
    const auto first = static_cast<std::uint32_t>(triangles().size());
    if (count > numbers_.triangles - first) return "has more triangles in its leaves than it states";
    if (!leaf_triangles(count, source)) return "has a triangle that is none";
    for (std::uint32_t i = 0; i < count; ++i) originals().push_back(first + i);
    if constexpr (Coder::writes)
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t number_there = given().clusters[number].first_triangle + leaf_.recorded()[i];
            given_original_.push_back(source_->graph.original_of[number_there]);
            std::uint8_t turn = 0;
            while (leaf_.number_of(source_->graph.triangles[number_there][turn]) != triangles()[first + i][0])
                ++turn;
            turn_.push_back(turn);
        }
    graph().clusters.push_back({first, count, 0, no_group, no_group});
    if (std::string wrong = too_full(graph().clusters.back()); !wrong.empty()) return wrong;
    if (std::string wrong = used_by(number, groups_[0], 0); !wrong.empty()) return "has a leaf " + wrong;
    return "";
}

template <class Coder>
std::string MeshBytesCode<Coder>::leaves() {
    if (std::string wrong = take_given_leaves(); !wrong.empty()) return wrong;
    for (std::uint32_t i = 0; i < numbers_.leaves; ++i) {
        if (std::string wrong = leaf(i); !wrong.empty()) return wrong;
        if (is_cut_off()) return "is cut off in its leaves";
        if ((i + 1) % window_leaves == 0) end_window();
    }
    std::pmr::vector<std::uint32_t> given_vertex = leaf_.end();
    if constexpr (Coder::writes) mesh_.given_vertex = std::move(given_vertex);
    if (given_leaves_ != nullptr) *given_leaves_ = {};
    if (triangles().size() != numbers_.triangles || mesh_.places.size() != numbers_.vertices)
        return "has " + std::to_string(triangles().size()) + " triangles and " +
               std::to_string(mesh_.places.size()) + " vertices, expected " +
               std::to_string(numbers_.triangles) + " and " + std::to_string(numbers_.vertices);
    return "";
}

// Groups of a level, with what each uses of the level below.
template <class Coder>
void MeshBytesCode<Coder>::begin_groups(std::uint32_t number, std::uint32_t first_group) {
    std::vector<std::vector<std::uint32_t>> members(groups_[number]);
    for (std::uint32_t i = first_live_; i < graph().clusters.size(); ++i)
        members[graph().clusters[i].used_by - first_group].push_back(i);
    for (const std::vector<std::uint32_t>& of_group : members) {
        ClusterGroup group{};
        group.level = number + 1, group.complete = true;
        group.first_member = static_cast<std::uint32_t>(graph().members.size());
        group.members = static_cast<std::uint32_t>(of_group.size());
        graph().members.insert(graph().members.end(), of_group.begin(), of_group.end());
        set_sphere(graph(), triangles(), vertices_m_, metres_of(mesh_.origin), group);
        graph().groups.push_back(group);
        if (graph().groups.size() % window_groups == 0) end_window();
    }
}

// Whether each vertex is one of several groups.
template <class Coder>
std::pmr::vector<char> MeshBytesCode<Coder>::borders(std::uint32_t first_group) {
    const ClusterGraph& all = graph();
    std::pmr::vector<std::uint32_t> seen(mesh_.places.size(), no_group, array_memory(scratch_));
    std::pmr::vector<char> is_border(mesh_.places.size(), 0, array_memory(scratch_));
    for (std::uint32_t i = first_group; i < all.groups.size(); ++i) {
        for (const std::uint32_t member : all.members_of(all.groups[i]))
            for (const VertexTriangle& triangle : triangles_in(all.clusters[member]))
                for (const std::uint32_t corner : triangle) {
                    if (seen[corner] != no_group && seen[corner] != i) is_border[corner] = 1;
                    seen[corner] = i;
                }
        if (i % window_groups == 0) end_window();
    }
    return is_border;
}

// An encoder's: what a group has left, by the numbers of what it uses here.
template <class Coder>
std::vector<GroupMaps::Left> MeshBytesCode<Coder>::left_of(std::uint32_t number,
                                                           std::span<const std::uint32_t> originals) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> numbers;  // of originals
    for (std::uint32_t i = 0; i < originals.size(); ++i)
        numbers.emplace_back(given_original_[originals[i]], i);
    std::sort(numbers.begin(), numbers.end());
    std::vector<GroupMaps::Left> left;
    const ClusterGroup& group = given().groups[number];
    for (std::uint32_t i = 0; i < group.made; ++i) {
        const Cluster& cluster = given().clusters[group.first_made + i];
        for (std::uint32_t k = cluster.first_triangle; k < cluster.first_triangle + cluster.triangles; ++k) {
            const std::uint32_t original = source_->graph.original_of[k];
            const auto found = std::lower_bound(numbers.begin(), numbers.end(), std::pair{original, 0U});
            if (found == numbers.end() || found->first != original) return {};
            GroupMaps::Left one{found->second, {}, i};
            for (std::size_t corner = 0; corner < 3; ++corner)
                one.corners[corner] = leaf_.number_of(
                    source_->graph.triangles[k][(corner + turn_[originals[found->second]]) % 3]);
            left.push_back(one);
        }
    }
    std::sort(left.begin(), left.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    return left;
}

template <class Coder>
std::string MeshBytesCode<Coder>::error(ClusterGroup& group, double least_m) {
    auto bits = std::bit_cast<std::uint64_t>(group.error_m);
    std::uint64_t read = 0;
    for (unsigned shift = 0; shift < 64; shift += 16)
        read |= std::uint64_t{coder_.uniform(1U << 16U, static_cast<std::uint32_t>(bits >> shift & 0xffffU))}
                << shift;
    group.error_m = std::bit_cast<double>(read);
    constexpr double most_m = 1.0e7;
    if (std::isfinite(group.error_m) && group.error_m >= least_m && group.error_m <= most_m) return "";
    char text[120];
    std::snprintf(text, sizeof text, "has an error of %g m over one of %g m", group.error_m, least_m);
    return text;
}

template <class Coder>
std::string MeshBytesCode<Coder>::clusters_of(std::uint32_t number, std::uint32_t made,
                                              std::span<const GroupMaps::Left> left,
                                              std::span<const std::uint32_t> originals) {
    ClusterGroup& group = graph().groups[number];
    group.first_made = static_cast<std::uint32_t>(graph().clusters.size());
    group.made = made;
    std::vector<std::vector<std::uint32_t>> of_cluster(made);
    for (std::uint32_t i = 0; i < left.size(); ++i) of_cluster[left[i].cluster].push_back(i);
    for (const std::vector<std::uint32_t>& of_one : of_cluster) {
        graph().clusters.push_back({static_cast<std::uint32_t>(triangles().size()),
                                    static_cast<std::uint32_t>(of_one.size()), 0, number, no_group});
        for (const std::uint32_t one : of_one) {
            triangles().push_back(left[one].corners);
            originals_of(mesh_).push_back(originals[left[one].number]);
        }
        if (std::string wrong = too_full(graph().clusters.back()); !wrong.empty()) return wrong;
    }
    return "";
}

template <class Coder>
std::string MeshBytesCode<Coder>::group(std::uint32_t number, std::span<const char> is_border,
                                        std::uint32_t groups_above, std::uint32_t first_above) {
    const std::string name = "has a group " + std::to_string(number) + " ";
    std::vector<VertexTriangle> used;
    std::vector<std::uint32_t> used_originals;
    for (const std::uint32_t member : graph().members_of(graph().groups[number])) {
        const Cluster& cluster = graph().clusters[member];
        const auto of_cluster = triangles_in(cluster);
        used.insert(used.end(), of_cluster.begin(), of_cluster.end());
        for (std::uint32_t i = 0; i < cluster.triangles; ++i)
            used_originals.push_back(originals()[cluster.first_triangle + i]);
    }
    if (used.empty() || used.size() > most_used_triangles)
        return name + "of " + std::to_string(used.size()) + " triangles, expected 1 to 4,096";
    std::uint32_t made = 0;
    std::vector<GroupMaps::Left> left;
    if constexpr (Coder::writes) {
        made = given().groups[number].made;
        left = left_of(number, used_originals);
        graph().groups[number].error_m = given().groups[number].error_m;
    }
    made = made_.code(coder_, made);
    if (made > used.size()) return name + "of more clusters than triangles";
    if (!maps_.code(coder_, used, is_border, made, left)) return name + "whose vertices lead nowhere";
    const double least_m = largest_member_error_m(graph(), graph().groups[number]);
    if (std::string wrong = error(graph().groups[number], least_m); !wrong.empty()) return wrong;
    const std::size_t first = graph().clusters.size();
    const std::size_t first_triangle = triangles().size();
    if (std::string wrong = clusters_of(number, made, left, used_originals); !wrong.empty()) return wrong;
    if (has_flat(first_triangle)) return name + "that made a triangle without an area";
    const std::size_t end = graph().clusters.size();
    for (std::size_t i = first; i < end; ++i)
        if (std::string wrong = used_by(i, groups_above, first_above); !wrong.empty()) return name + wrong;
    return "";
}

template <class Coder>
std::string MeshBytesCode<Coder>::level(std::uint32_t number) {
    const auto first_group = static_cast<std::uint32_t>(graph().groups.size());
    const auto first_cluster = static_cast<std::uint32_t>(graph().clusters.size());
    const std::size_t first_triangle = triangles().size();
    begin_groups(number, first_group);
    GraphLevel facts;
    facts.groups = groups_[number];
    const std::pmr::vector<char> is_border = borders(first_group);
    facts.locked = static_cast<std::size_t>(std::count(is_border.begin(), is_border.end(), 1));
    const std::uint32_t above = number + 1 < numbers_.levels ? groups_[number + 1] : 0;
    for (std::uint32_t i = first_group; i < first_group + facts.groups; ++i) {
        const std::size_t before = triangles().size();
        if (std::string wrong = group(i, is_border, above, first_group + groups_[number]); !wrong.empty())
            return wrong;
        if (is_cut_off() || triangles().size() > numbers_.graph_triangles)
            return "is cut off in group " + std::to_string(i);
        std::size_t used = 0;
        for (const std::uint32_t member : graph().members_of(graph().groups[i]))
            used += graph().clusters[member].triangles;
        const std::size_t out = triangles().size() - before;
        facts.triangles_in += used, facts.triangles_out += out;
        facts.largest_group = std::max(facts.largest_group, used);
        facts.stuck_groups += static_cast<double>(out) > stuck_share * static_cast<double>(used) ? 1U : 0U;
        facts.clusters_out += graph().groups[i].made;
        facts.largest_error_m = std::max(facts.largest_error_m, graph().groups[i].error_m);
        if (i % window_groups == 0) end_window();
    }
    end_window();
    if (triangles().size() - first_triangle > facts.triangles_in) return "grows from level to level";
    graph().levels.push_back(facts);
    first_live_ = first_cluster;
    return "";
}

MeshNumbers numbers_of(const MeshToStore& mesh) {
    const ClusterGraph& graph = mesh.graph.clusters;
    MeshNumbers numbers;
    numbers.origin = mesh.origin;
    constexpr std::int64_t far = std::numeric_limits<std::int64_t>::max();
    numbers.least = {far, far, far};
    for (const LatticeSteps& at : mesh.places)
        for (std::size_t i = 0; i < 3; ++i) numbers.least[i] = std::min(numbers.least[i], at[i]);
    numbers.vertices = static_cast<std::uint32_t>(mesh.places.size());
    numbers.labels = mesh.label_count;
    numbers.clusters = static_cast<std::uint32_t>(graph.clusters.size());
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.made_by != no_group) break;
        ++numbers.leaves, numbers.triangles += cluster.triangles;
    }
    numbers.levels = graph.groups.empty() ? 0 : graph.groups.back().level;
    numbers.graph_triangles = static_cast<std::uint32_t>(mesh.graph.triangles.size());
    return numbers;
}

}  // namespace

Result<WrittenMesh> write_mesh(const MeshToStore& mesh, ScratchMemory* scratch, LeavesIn leaves) {
    const MeshNumbers numbers = numbers_of(mesh);
    if (const std::string wrong = implausible(numbers); !wrong.empty())
        return Error{ErrorKind::failed, "", "the mesh " + wrong};
    std::vector<std::uint32_t> groups(numbers.levels, 0);
    for (const ClusterGroup& group : mesh.graph.clusters.groups) ++groups[group.level - 1];
    NumberWriter writer;
    MeshNumbers stated = numbers;
    if (mesh.ground_fingerprint != 0) stated.levels |= has_ground;
    if (leaves == LeavesIn::payloads) stated.levels |= leaves_elsewhere;
    visit_numbers(writer, stated);
    if (mesh.ground_fingerprint != 0) writer(mesh.ground_fingerprint);
    for (const std::uint32_t count : groups) writer(count);
    WrittenMesh written(array_memory(scratch));
    written.origin = mesh.origin, written.label_count = mesh.label_count;
    written.ground_fingerprint = mesh.ground_fingerprint;
    written.bytes.assign(writer.bytes.begin(), writer.bytes.end());
    // Vectors that grow to these would take twice as much for a moment.
    written.places.reserve(numbers.vertices);
    written.triangles.reserve(numbers.graph_triangles), written.original_of.reserve(numbers.graph_triangles);
    written.clusters.clusters.reserve(numbers.clusters);
    written.clusters.groups.reserve(mesh.graph.clusters.groups.size());
    written.clusters.members.reserve(mesh.graph.clusters.members.size());
    RangeEncoder coder;
    MeshBytesCode<RangeEncoder> code(coder, numbers, groups, &mesh, written, scratch, leaves, nullptr);
    if (const std::string wrong = code.code(); !wrong.empty())
        return Error{ErrorKind::failed, "", "the mesh " + wrong};
    const std::vector<std::byte> rest = coder.finish();
    written.bytes.insert(written.bytes.end(), rest.begin(), rest.end());
    return Result<WrittenMesh>(std::move(written));
}

Result<std::vector<std::byte>> mesh_to_bytes(const MeshToStore& mesh) {
    ORO_TRY(const WrittenMesh written, write_mesh(mesh, nullptr));
    return std::vector<std::byte>(written.bytes.begin(), written.bytes.end());
}

bool has_leaves_elsewhere(std::span<const std::byte> bytes) {
    NumberReader reader(bytes);
    MeshNumbers numbers;
    visit_numbers(reader, numbers);
    return (numbers.levels & leaves_elsewhere) != 0;
}

std::optional<std::string> mesh_from_bytes(std::span<const std::byte> bytes, StoredMesh& mesh,
                                           MeshLeaves* leaves) {
    mesh = {};
    NumberReader reader(bytes);
    MeshNumbers numbers;
    visit_numbers(reader, numbers);
    if ((numbers.levels & has_ground) != 0) reader(mesh.ground_fingerprint), numbers.levels &= ~has_ground;
    if (reader.rest().empty()) return "is cut off";
    const LeavesIn leaves_in =
        (numbers.levels & leaves_elsewhere) != 0 ? LeavesIn::payloads : LeavesIn::bytes;
    numbers.levels &= ~leaves_elsewhere;
    if (std::string wrong = implausible(numbers); !wrong.empty()) return wrong;
    std::vector<std::uint32_t> groups(numbers.levels);
    for (std::uint32_t& count : groups) {
        reader(count);
        if (count == 0 || count > numbers.clusters)
            return "has a level of " + std::to_string(count) + " groups";
    }
    mesh.origin = numbers.origin, mesh.label_count = numbers.labels;
    RangeDecoder coder(reader.rest());
    MeshBytesCode<RangeDecoder> code(coder, numbers, groups, nullptr, mesh, nullptr, leaves_in, leaves);
    if (std::string wrong = code.code(); !wrong.empty()) return wrong;
    if (coder.is_wrong()) return "is cut off";
    if (!coder.at_end()) return "goes on after its last group";
    return std::nullopt;
}

}  // namespace oro
