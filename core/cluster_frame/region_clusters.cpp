#include "core/cluster_frame/region_clusters.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <string>
#include <utility>

#include "core/base/parallel.h"
#include "core/cluster_file/group_growth.h"
#include "core/surface/distinct_vertices.h"

namespace oro {
namespace {

// What is said of the first vertex of which something is. Most triangles share two with that before.
template <class WrongAt>
std::optional<std::string> first_wrong_vertex(std::span<const VertexTriangle> triangles,
                                              const WrongAt& wrong_at) {
    VertexTriangle before{};
    bool is_first = true;
    for (const VertexTriangle& triangle : triangles) {
        for (const VertexNumber vertex : triangle) {
            if (!is_first && std::ranges::find(before, vertex) != before.end()) continue;
            if (auto wrong = wrong_at(vertex)) return wrong;
        }
        before = triangle;
        is_first = false;
    }
    return std::nullopt;
}

Error no_graph(const std::string& what) {
    return {ErrorKind::failed, "clusters", what};
}

// ClusterReach::half_axes_m.
glm::mat3 box_around(const Ecef& centre, std::span<const glm::dvec3> places_m) {
    const Geodetic at = geodetic_from_ecef(centre);
    const glm::dmat3 axes = ecef_from_enu(at.lat_deg, at.lon_deg);
    glm::dvec3 half_m(0.0);
    for (const glm::dvec3& place : places_m)
        half_m = glm::max(half_m, glm::abs(glm::transpose(axes) * (place - centre.m)));
    // As of the radius; and the axes are rounded to floats.
    half_m += 0.01 + 2.0e-6 * glm::length(half_m);
    return {axes[0] * half_m.x, axes[1] * half_m.y, axes[2] * half_m.z};
}

}  // namespace

RegionClusters::RegionClusters(const HeightField& field, const HorizonOccluder& occluder)
    : grid_(field.grid),
      occluder_(occluder),
      heights_(drawn_heights(field, 1.0, thread_count())),
      surface_(heights_, {.wraps_longitude = field.grid.wraps_longitude()}),
      bounds_(grid_, heights_.highest_steps),
      leaf_nodes_(surface_.leaf_nodes()) {}

Result<std::unique_ptr<RegionClusters>> RegionClusters::create(const HeightField& field,
                                                               const HorizonOccluder& occluder,
                                                               std::vector<ClusterGroup> groups,
                                                               std::uint32_t leaves, ReadGroup read,
                                                               UnsoundGroupError unsound) {
    std::unique_ptr<RegionClusters> region(new RegionClusters(field, occluder));
    if (region->leaf_nodes_.size() != leaves)
        return no_graph("are over " + std::to_string(leaves) + " leaves; the region has " +
                        std::to_string(region->leaf_nodes_.size()));
    region->leaves_count_ = leaves;
    std::uint32_t next = leaves, top = 0, number = 0;
    region->makers_.assign(leaves, no_group);
    for (const ClusterGroup& group : groups) {
        if (group.first_made != next)
            return no_graph("begin a group with number " + std::to_string(group.first_made) + ", expected " +
                            std::to_string(next));
        next += group.made;
        region->makers_.resize(next, number++);
        top = std::max(top, group.level);
    }
    for (std::uint32_t i = 0; i < groups.size(); ++i) {
        if (groups[i].level != top) continue;
        for (std::uint32_t j = 0; j < groups[i].made; ++j) region->roots_.push_back(groups[i].first_made + j);
    }
    for (std::uint32_t i = 0; groups.empty() && i < leaves; ++i) region->roots_.push_back(i);
    region->held_.make_places(groups.size(), region->makers_.size(), leaves);
    region->groups_ = std::move(groups);
    region->read_ = std::move(read);
    region->unsound_ = std::move(unsound);
    return region;
}

Result<void> RegionClusters::read_sound(std::uint32_t group, GroupPart& part) const {
    ORO_CHECK(read_(group, part));
    const std::optional<std::string> wrong = wrong_with(part);
    // Read number by number, its lists have room for more.
    part.members.shrink_to_fit();
    part.made.shrink_to_fit();
    part.triangles.shrink_to_fit();
    if (!wrong) return {};
    return unsound_ ? unsound_(group, *wrong)
                    : no_graph("have group " + std::to_string(group) + ", which " + *wrong);
}

std::optional<std::string> RegionClusters::wrong_with(const GroupPart& part) const {
    for (const std::uint32_t member : part.members)
        if (auto wrong = wrong_level(part.group, member, groups_, leaves_count_)) return wrong;
    if (auto wrong = wrong_growth(part, groups_, leaves_count_)) return wrong;
    return wrong_places(part);
}

// What a group made lies in its sphere, and in one of those of the groups below it: that is known of groups
// that nobody may have read. Those of the first level hold their leaves.
std::optional<std::string> RegionClusters::wrong_places(const GroupPart& part) const {
    std::vector<std::uint32_t> below;
    for (const std::uint32_t member : part.members)
        if (maker(member) != no_group && (below.empty() || below.back() != maker(member)))
            below.push_back(maker(member));
    std::size_t holds = 0;  // most vertices are in the same one as that before
    const auto is_in = [&](std::uint32_t group, const Ecef& place) {
        return glm::distance(place.m, groups_[group].centre.m) <= groups_[group].radius_m;
    };
    const auto wrong_at = [&](VertexNumber number) -> std::optional<std::string> {
        const SurfaceVertex vertex = surface_.vertex(number);
        if (vertex.steps == void_height_steps) return std::nullopt;  // fill_with() refuses it
        const Ecef place = bounds_.ecef(vertex);
        if (auto wrong = beyond_sphere(part.group, place)) return wrong;
        if (below.empty() || is_in(below[holds], place)) return std::nullopt;
        for (holds = 0; holds < below.size(); ++holds)
            if (is_in(below[holds], place)) return std::nullopt;
        return "has vertex " + std::to_string(number) + ", which no sphere of a group below it holds";
    };
    if (auto wrong = first_wrong_vertex(part.triangles, wrong_at)) return wrong;
    for (const std::uint32_t member : part.members) {
        if (maker(member) != no_group) break;
        if (auto wrong = first_wrong_vertex(surface_.leaf(leaf_nodes_[member]), wrong_at)) return wrong;
    }
    return std::nullopt;
}

Result<void> RegionClusters::check_coarsest() const {
    std::uint32_t last = no_group;
    for (const std::uint32_t root : roots_) {
        if (maker(root) == last) continue;
        last = maker(root);
        GroupPart part;
        ORO_CHECK(read_sound(last, part));
    }
    return {};
}

Result<const GroupPart*> RegionClusters::part(std::uint32_t group) {
    if (const GroupPart* const here = held_.use(group)) return here;
    auto read = std::make_unique<GroupPart>();
    ORO_CHECK(read_sound(group, *read));
    return held_.put(group, std::move(read));
}

Result<std::span<const std::uint32_t>> RegionClusters::members(std::uint32_t group) {
    ORO_TRY(const GroupPart* const whole, part(group));
    return std::span<const std::uint32_t>(whole->members);
}

Result<std::span<const VertexTriangle>> RegionClusters::triangles(std::uint32_t cluster,
                                                                  std::vector<VertexTriangle>& leaf) {
    const std::uint32_t group = maker(cluster);
    if (group == no_group) return triangles_of(cluster, nullptr, leaf);
    ORO_TRY(const GroupPart* const whole, part(group));
    return triangles_of(cluster, whole, leaf);
}

std::span<const VertexTriangle> RegionClusters::triangles_of(std::uint32_t cluster, const GroupPart* part,
                                                             std::vector<VertexTriangle>& leaf) const {
    if (part == nullptr) {
        leaf = surface_.leaf(leaf_nodes_[cluster]);
        return leaf;
    }
    const Cluster& made = part->made[cluster - part->group.first_made];
    return std::span<const VertexTriangle>(part->triangles).subspan(made.first_triangle, made.triangles);
}

Result<std::uint32_t> RegionClusters::triangle_count(std::uint32_t cluster) {
    std::vector<VertexTriangle> leaf;
    ORO_TRY(const std::span<const VertexTriangle> all, triangles(cluster, leaf));
    return static_cast<std::uint32_t>(all.size());
}

ClusterReach RegionClusters::reach_of(std::span<const VertexTriangle> all) const {
    std::vector<glm::dvec3> places_m;
    ClusterReach reach{{}, 0.0, {}, {}, grid_.rows(), 0, grid_.columns(), 0};
    for (const VertexNumber number : distinct_vertices(all)) {
        const SurfaceVertex vertex = surface_.vertex(number);
        places_m.push_back(bounds_.ecef(vertex).m);
        reach.first_row = std::min(reach.first_row, vertex.row);
        reach.last_row = std::max(reach.last_row, vertex.row);
        reach.first_column = std::min(reach.first_column, vertex.column);
        reach.last_column = std::max(reach.last_column, vertex.column);
    }
    glm::dvec3 lowest = places_m.front(), highest = lowest;
    for (const glm::dvec3& place : places_m) {
        lowest = glm::min(lowest, place);
        highest = glm::max(highest, place);
    }
    reach.centre.m = 0.5 * (lowest + highest);
    for (const glm::dvec3& place : places_m)
        reach.radius_m = std::max(reach.radius_m, glm::distance(reach.centre.m, place));
    // Drawn places are rounded (core/surface/ground_bounds.cpp).
    reach.radius_m += 0.01 + 1.0e-6 * reach.radius_m;
    reach.horizon = horizon_cone(occluder_, places_m);
    reach.half_axes_m = box_around(reach.centre, places_m);
    return reach;
}

Result<ClusterReach> RegionClusters::reach(std::uint32_t cluster) {
    if (const ClusterReach* const known = known_reach(cluster)) return *known;
    std::vector<VertexTriangle> leaf;
    ORO_TRY(const std::span<const VertexTriangle> all, triangles(cluster, leaf));
    const ClusterReach found = reach_of(all);
    held_.put_reach(cluster, maker(cluster), found);
    return found;
}

// What is here comes first: it must not give way to the rest.
Result<void> RegionClusters::read(std::span<const std::uint32_t> groups) {
    std::vector<std::uint32_t> missing;
    std::ranges::copy_if(groups, std::back_inserter(missing),
                         [&](std::uint32_t group) { return held_.use(group) == nullptr; });
    std::vector<Result<void>> done(missing.size());
    std::vector<std::unique_ptr<GroupPart>> parts(missing.size());
    in_parallel(static_cast<int>(missing.size()), thread_count(), [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        auto part = std::make_unique<GroupPart>();
        done[at] = read_sound(missing[at], *part);
        if (done[at].ok()) parts[at] = std::move(part);
    });
    for (std::size_t i = 0; i < missing.size(); ++i)
        if (parts[i]) held_.put(missing[i], std::move(parts[i]));
    for (const Result<void>& one : done) ORO_CHECK(one);
    return {};
}

Result<void> RegionClusters::reach_all(std::span<const std::uint32_t> clusters) {
    std::vector<std::uint32_t> missing, groups;
    for (const std::uint32_t cluster : clusters) {
        const std::uint32_t group = held_.keeper(cluster, maker(cluster));
        if (known_reach(cluster) == nullptr) missing.push_back(cluster);
        if (group != no_group) groups.push_back(group);
    }
    std::ranges::sort(groups);
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
    ORO_CHECK(read(groups));
    std::vector<ClusterReach> found(missing.size());
    in_parallel(static_cast<int>(missing.size()), thread_count(), [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        const std::uint32_t group = maker(missing[at]);
        std::vector<VertexTriangle> leaf;
        found[at] = reach_of(triangles_of(missing[at], group == no_group ? nullptr : read_part(group), leaf));
    });
    for (std::size_t i = 0; i < missing.size(); ++i) held_.put_reach(missing[i], maker(missing[i]), found[i]);
    return {};
}

Result<std::uint32_t> RegionClusters::fill(std::uint32_t cluster, const HeightQuantization& coding,
                                           gpu::ClusterBlock& block) {
    std::vector<VertexTriangle> leaf;
    ORO_TRY(const std::span<const VertexTriangle> all, triangles(cluster, leaf));
    return fill_with(all, level_of(cluster), coding, block);
}

Result<std::uint32_t> RegionClusters::fill_with(std::span<const VertexTriangle> all, std::uint32_t level,
                                                const HeightQuantization& coding,
                                                gpu::ClusterBlock& block) const {
    const std::vector<VertexNumber> vertices = distinct_vertices(all);
    if (all.empty() || all.size() > gpu::cluster_triangles || vertices.size() > gpu::cluster_vertices)
        return no_graph("have one with " + std::to_string(all.size()) + " triangles and " +
                        std::to_string(vertices.size()) + " vertices");
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const SurfaceVertex vertex = surface_.vertex(vertices[i]);
        if (vertex.steps == void_height_steps)
            return no_graph("have a vertex where the region has no height");
        block.vertices[i] = {static_cast<gpu::uint>(vertex.row), static_cast<gpu::uint>(vertex.column),
                             coding.sixteen ? coding.steps(coding.code(vertex.steps)) : vertex.steps};
    }
    const auto place = [&](VertexNumber number) {
        return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, number) - vertices.begin());
    };
    // Clockwise on the map in the graph, the other way round as pages' triangles are.
    for (std::size_t i = 0; i < all.size(); ++i)
        block.corners[i] = place(all[i][0]) | place(all[i][2]) << 8U | place(all[i][1]) << 16U;
    return static_cast<std::uint32_t>(all.size() | vertices.size() << 8U) | level << 16U;
}

Result<RegionClusters::LoadedGroup> RegionClusters::load_group(std::uint32_t group,
                                                               const SeenOfGroup* seen) const {
    LoadedGroup loaded{group, std::make_unique<GroupPart>(), {}, {}};
    ORO_CHECK(read_sound(group, *loaded.part));
    std::vector<VertexTriangle> leaf;
    const auto add = [&](std::uint32_t cluster, const GroupPart* part, bool with_block) -> Result<void> {
        const std::span<const VertexTriangle> all = triangles_of(cluster, part, leaf);
        loaded.reaches.emplace_back(cluster, reach_of(all));
        if (!with_block || !seen->is_seen(loaded.reaches.back().second)) return {};
        ORO_TRY(LoadedCluster one, loaded_cluster(cluster, all, seen->coding));
        one.reach = loaded.reaches.back().second;
        loaded.seen.push_back(std::move(one));
        return {};
    };
    for (std::uint32_t i = 0; i < groups_[group].made; ++i)
        ORO_CHECK(add(groups_[group].first_made + i, loaded.part.get(), seen != nullptr));
    for (const std::uint32_t member : loaded.part->members)
        if (maker(member) == no_group) ORO_CHECK(add(member, nullptr, seen != nullptr && seen->leaves));
    return loaded;
}

// Without its reach.
Result<RegionClusters::LoadedCluster> RegionClusters::loaded_cluster(std::uint32_t cluster,
                                                                     std::span<const VertexTriangle> all,
                                                                     const HeightQuantization& coding) const {
    LoadedCluster loaded{cluster, 0, std::make_unique<gpu::ClusterBlock>(), {}};
    ORO_TRY(loaded.counts, fill_with(all, level_of(cluster), coding, *loaded.block));
    return loaded;
}

Result<RegionClusters::LoadedCluster> RegionClusters::load_cluster(std::uint32_t cluster,
                                                                   const HeightQuantization& coding) const {
    const std::uint32_t group = maker(cluster);
    std::shared_ptr<const GroupPart> part = group == no_group ? nullptr : held_.share(group);
    if (group != no_group && !part) {
        const auto read = std::make_shared<GroupPart>();
        ORO_CHECK(read_sound(group, *read));
        part = read;
    }
    std::vector<VertexTriangle> leaf;
    const std::span<const VertexTriangle> all = triangles_of(cluster, part.get(), leaf);
    ORO_TRY(LoadedCluster loaded, loaded_cluster(cluster, all, coding));
    loaded.reach = reach_of(all);
    return loaded;
}

void RegionClusters::keep(LoadedGroup& group) {
    held_.put(group.number, std::move(group.part));
    for (const auto& [cluster, reach] : group.reaches) keep(cluster, reach);
}

void RegionClusters::keep(std::uint32_t cluster, const ClusterReach& reach) {
    held_.put_reach(cluster, maker(cluster), reach);
}

Result<std::unique_ptr<RegionClusters>> clusters_of_file(std::shared_ptr<const ClusterFile> file,
                                                         std::uint64_t fingerprint, const HeightField& field,
                                                         const HorizonOccluder& occluder) {
    const ClusterOutline& outline = file->outline();
    if (outline.fingerprint != fingerprint || outline.posts.rows != field.grid.rows() ||
        outline.posts.columns != field.grid.columns())
        return Error{ErrorKind::failed, file->path(), "has clusters of another region's posts"};
    ORO_TRY(std::vector<ClusterGroup> groups, file->groups());
    Result<std::unique_ptr<RegionClusters>> region = RegionClusters::create(
        field, occluder, std::move(groups), outline.leaves,
        [file](std::uint32_t number, GroupPart& part) { return file->part(number, part); },
        [file](std::uint32_t number, const std::string& what) { return file->unsound(number, what); });
    if (!region.ok()) return Error{ErrorKind::failed, file->path(), "its clusters " + region.error().what};
    ORO_CHECK((*region)->check_coarsest());
    return region;
}

Result<std::unique_ptr<RegionClusters>> clusters_of_graph(const ClusterGraph& graph, const HeightField& field,
                                                          const HorizonOccluder& occluder) {
    std::uint32_t leaves = 0;
    while (leaves < graph.clusters.size() && graph.clusters[leaves].made_by == no_group) ++leaves;
    return RegionClusters::create(field, occluder, graph.groups, leaves,
                                  [&graph](std::uint32_t number, GroupPart& part) -> Result<void> {
                                      part = part_of(graph, number);
                                      return {};
                                  });
}

}  // namespace oro
