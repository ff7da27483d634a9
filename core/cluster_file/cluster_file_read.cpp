#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "core/base/checksum.h"
#include "core/base/parallel.h"
#include "core/cluster_file/cluster_format.h"
#include "core/cluster_file/sound_graph.h"
#include "core/surface/distinct_vertices.h"

namespace oro {
namespace {

using namespace cluster_format;

Result<StoredGroup> read_record(const Container& container, const ClusterOutline& outline,
                                const Chunk& groups, const Chunk& meshes, std::uint32_t number) {
    const OpenFile& file = container.file();
    const std::uint64_t offset = groups.offset + std::uint64_t{number} * record_bytes;
    const std::string name = "the record of group " + std::to_string(number) + " ";
    std::array<std::byte, record_bytes> stored;
    ORO_CHECK(file.read(offset, stored));
    if (const auto wrong = wrong_checksum(stored, number)) return file.damaged(offset, name + *wrong);
    const StoredGroup record = record_from_bytes(stored);
    if (const auto wrong = implausible(record, outline, meshes.bytes))
        return file.damaged(offset, name + *wrong);
    return record;
}

}  // namespace

Result<ClusterFile> ClusterFile::open(const std::string& path) {
    ORO_TRY(std::shared_ptr<const Container> container, Container::open(path));
    return open(std::move(container), 0);
}

ClusterFile::ClusterFile(std::shared_ptr<const Container> container, ClusterOutline outline)
    : container_(std::move(container)), outline_(std::move(outline)) {
    std::uint32_t last = 0;
    for (const GraphLevel& level : outline_.levels)
        last_groups_.push_back(last += static_cast<std::uint32_t>(level.groups));
}

std::uint64_t ClusterFile::record_offset(std::uint32_t number) const {
    return groups_.offset + std::uint64_t{number} * record_bytes;
}

std::uint32_t ClusterFile::level_of(std::uint32_t number) const {
    return 1 + static_cast<std::uint32_t>(std::upper_bound(last_groups_.begin(), last_groups_.end(), number) -
                                          last_groups_.begin());
}

Result<ClusterFile> ClusterFile::open(std::shared_ptr<const Container> container, std::uint32_t grid) {
    const OpenFile& file = container->file();
    ORO_TRY(const Chunk graph, container->chunk(ChunkType::graph, grid));
    ORO_TRY(const Chunk groups, container->chunk(ChunkType::groups, grid));
    ORO_TRY(const Chunk meshes, container->chunk(ChunkType::meshes, grid));
    if (graph.bytes < outline_bytes || graph.bytes > outline_bytes + most_levels * level_bytes ||
        (graph.bytes - outline_bytes) % level_bytes != 0)
        return file.damaged(graph.offset, "the outline of clusters has " + std::to_string(graph.bytes) +
                                              " bytes, expected " + std::to_string(outline_bytes) + " and " +
                                              std::to_string(level_bytes) + " for each of at most " +
                                              std::to_string(most_levels) + " levels");
    ORO_TRY(const std::vector<std::byte> bytes,
            container->read(graph, outline_bytes + most_levels * level_bytes));
    ClusterOutline outline = outline_from_bytes(bytes);
    if (const auto wrong = implausible(outline, groups.bytes))
        return file.damaged(graph.offset, "the outline of clusters " + *wrong);
    ClusterFile clusters(std::move(container), std::move(outline));
    clusters.graph_ = graph;
    clusters.groups_ = groups;
    clusters.meshes_ = meshes;
    clusters.bytes_ =
        ChunkTable::header_bytes + 3 * ChunkTable::entry_bytes + graph.bytes + groups.bytes + meshes.bytes;
    return clusters;
}

Result<ClusterGroup> ClusterFile::group(std::uint32_t number) const {
    assert(number < outline_.groups);
    Result<StoredGroup> stored = read_record(*container_, outline_, groups_, meshes_, number);
    ORO_CHECK(container_->check_unchanged());
    if (!stored.ok()) return stored.error();
    stored->group.level = level_of(number);
    return stored->group;
}

Result<void> ClusterFile::part(std::uint32_t number, GroupPart& part) const {
    assert(number < outline_.groups);
    const Result<void> read = read_part(number, part);
    ORO_CHECK(container_->check_unchanged());
    return read;
}

Result<void> ClusterFile::read_part(std::uint32_t number, GroupPart& part) const {
    ORO_TRY(const StoredGroup stored, read_record(*container_, outline_, groups_, meshes_, number));
    std::vector<std::byte> payload(stored.payload_bytes);
    const OpenFile& file = container_->file();
    const std::uint64_t offset = meshes_.offset + stored.payload_offset;
    ORO_CHECK(file.read(offset, payload));
    const auto damaged = [&](const std::string& what) {
        return file.damaged(offset, "the payload of group " + std::to_string(number) + " " + what);
    };
    if (const std::uint64_t computed = xxh64(payload, number); computed != stored.payload_checksum)
        return damaged(other_checksum(computed, stored.payload_checksum));
    part.number = number;
    part.group = stored.group;
    const std::uint32_t level = part.group.level = level_of(number);
    if (const auto wrong = decode_group(payload, outline_.posts, outline_.clusters, part))
        return damaged(*wrong);
    if (part.triangles.size() != stored.triangles)
        return damaged("has " + std::to_string(part.triangles.size()) + " triangles, expected " +
                       std::to_string(stored.triangles));
    for (const std::uint32_t member : part.members) {
        if (member >= part.group.first_made || (level == 1) != (member < outline_.leaves))
            return damaged("uses cluster " + std::to_string(member) + ", expected one of level " +
                           std::to_string(level - 1));
    }
    for (const Cluster& cluster : part.made) {
        const bool last = level == outline_.levels.size();
        if (last ? cluster.used_by != no_group
                 : cluster.used_by == no_group || cluster.used_by >= outline_.groups ||
                       level_of(cluster.used_by) != level + 1)
            return damaged(
                "has a cluster used by group " + std::to_string(cluster.used_by) +
                (last ? ", expected none" : ", expected one of level " + std::to_string(level + 1)));
    }
    return {};
}

namespace {

// That the graph is over what lies before us. triangles: of the leaves.
Result<void> check_surface(const ClusterFile& file, const OriginalSurface& surface, std::size_t leaves,
                           std::size_t triangles) {
    const ClusterOutline& outline = file.outline();
    if (surface.vertex_count() !=
            static_cast<std::size_t>(outline.posts.rows) * static_cast<std::size_t>(outline.posts.columns) ||
        leaves != outline.leaves)
        return fault(file.path(), "was made over " + std::to_string(outline.posts.rows) + " x " +
                                      std::to_string(outline.posts.columns) + " posts with " +
                                      std::to_string(outline.leaves) + " leaves; here are " +
                                      std::to_string(surface.vertex_count()) + " posts with " +
                                      std::to_string(leaves) + " leaves");
    if (!outline.levels.empty() && outline.levels.front().triangles_in != triangles)
        return fault(file.path(), "was made over " + std::to_string(outline.levels.front().triangles_in) +
                                      " triangles; here are " + std::to_string(triangles));
    return {};
}

// Leaves, and room for the rest.
Result<ClusterGraph> begin_graph(const ClusterFile& file, const OriginalSurface& surface) {
    const auto leaves = surface.leaves();
    std::size_t triangles = 0;
    for (const auto& leaf : leaves) triangles += leaf.size();
    ORO_CHECK(check_surface(file, surface, leaves.size(), triangles));
    ClusterGraph graph;
    graph.levels = file.outline().levels;
    for (const auto& leaf : leaves) {
        graph.clusters.push_back(
            {static_cast<std::uint32_t>(graph.triangles.size()), static_cast<std::uint32_t>(leaf.size()),
             static_cast<std::uint32_t>(distinct_vertices(leaf).size()), no_group, no_group});
        graph.triangles.insert(graph.triangles.end(), leaf.begin(), leaf.end());
    }
    return graph;
}

// Appends a group to those before it.
void append(const GroupPart& part, ClusterGraph& graph) {
    ClusterGroup group = part.group;
    group.first_member = static_cast<std::uint32_t>(graph.members.size());
    graph.members.insert(graph.members.end(), part.members.begin(), part.members.end());
    for (Cluster cluster : part.made) {
        cluster.first_triangle += static_cast<std::uint32_t>(graph.triangles.size());
        graph.clusters.push_back(cluster);
    }
    graph.triangles.insert(graph.triangles.end(), part.triangles.begin(), part.triangles.end());
    graph.groups.push_back(group);
}

// Leaves say which group uses them by what the groups of level 1 say.
void link_leaves(ClusterGraph& graph, std::uint32_t leaves) {
    for (std::uint32_t i = 0; i < graph.groups.size() && graph.groups[i].level == 1; ++i) {
        for (const std::uint32_t member : graph.members_of(graph.groups[i])) {
            if (member < leaves && graph.clusters[member].used_by == no_group)
                graph.clusters[member].used_by = i;
        }
    }
}

}  // namespace

Result<std::vector<ClusterGroup>> ClusterFile::groups() const {
    Result<std::vector<ClusterGroup>> read = read_groups();
    ORO_CHECK(container_->check_unchanged());
    return read;
}

Result<std::vector<ClusterGroup>> ClusterFile::read_groups() const {
    std::vector<ClusterGroup> groups;
    const OpenFile& file = container_->file();
    std::uint64_t next_payload = 0;
    std::uint64_t next_made = outline_.leaves, members = 0;
    std::uint32_t number = 0;
    const auto differ = [&](const std::string& what, std::uint64_t found, std::uint64_t expected) {
        return file.damaged(record_offset(number), "the record of group " + std::to_string(number) + " " +
                                                       what + " " + std::to_string(found) + ", expected " +
                                                       std::to_string(expected));
    };
    for (std::size_t level = 0; level < outline_.levels.size(); ++level) {
        std::uint64_t triangles = 0, made = 0;
        double largest_m = 0.0;
        for (; number < last_groups_[level]; ++number) {
            ORO_TRY(const StoredGroup stored, read_record(*container_, outline_, groups_, meshes_, number));
            if (stored.payload_offset != next_payload)
                return differ("has its payload at byte", stored.payload_offset, next_payload);
            if (stored.group.first_made != next_made)
                return differ("made clusters from number", stored.group.first_made, next_made);
            next_payload += stored.payload_bytes;
            next_made += stored.group.made;
            made += stored.group.made;
            triangles += stored.triangles;
            members += stored.group.members;
            largest_m = std::max(largest_m, stored.group.error_m);
            groups.push_back(stored.group);
            groups.back().level = static_cast<std::uint32_t>(level) + 1;
        }
        const GraphLevel& said = outline_.levels[level];
        if (made != said.clusters_out || triangles != said.triangles_out || largest_m != said.largest_error_m)
            return file.damaged(
                graph_.offset + outline_bytes + level * level_bytes,
                "level " + std::to_string(level + 1) + " says " + std::to_string(said.clusters_out) +
                    " clusters, " + std::to_string(said.triangles_out) + " triangles and " +
                    std::to_string(said.largest_error_m) + " m, but its groups have " + std::to_string(made) +
                    ", " + std::to_string(triangles) + " and " + std::to_string(largest_m));
    }
    if (next_payload != meshes_.bytes)
        return file.damaged(meshes_.offset + next_payload, "the payloads end here, but the meshes have " +
                                                               std::to_string(meshes_.bytes) + " bytes");
    if (members != outline_.members)
        return file.damaged(graph_.offset, "the outline of clusters says " +
                                               std::to_string(outline_.members) +
                                               " members, but the groups have " + std::to_string(members));
    return groups;
}

Error ClusterFile::unsound(std::uint32_t number, const std::string& what) const {
    return container_->file().damaged(record_offset(number), "group " + std::to_string(number) + " " + what);
}

Result<void> ClusterFile::check_chunks() const {
    ORO_CHECK(container_->check(groups_));
    return container_->check(meshes_);
}

Result<ClusterGraph> ClusterFile::graph(const OriginalSurface& surface, const GroundBounds& bounds,
                                        int threads) const {
    ORO_TRY(ClusterGraph graph, begin_graph(*this, surface));
    ORO_CHECK(groups());
    for (std::uint32_t first = 0; first < outline_.groups; first += groups_at_a_time) {
        std::vector<GroupPart> parts(std::min(groups_at_a_time, outline_.groups - first));
        std::vector<Result<void>> read(parts.size());
        in_parallel(static_cast<int>(parts.size()), threads, [&](int i) {
            const auto at = static_cast<std::size_t>(i);
            read[at] = part(first + static_cast<std::uint32_t>(i), parts[at]);
        });
        for (std::size_t i = 0; i < parts.size(); ++i) {
            ORO_CHECK(read[i]);
            append(parts[i], graph);
        }
    }
    link_leaves(graph, outline_.leaves);
    ORO_CHECK(check_sound({.leaf =
                               [&](std::uint32_t leaf) {
                                   const auto all = graph.triangles_of(graph.clusters[leaf]);
                                   return std::vector<VertexTriangle>(all.begin(), all.end());
                               },
                           .part = [&](std::uint32_t number, GroupPart& part) -> Result<void> {
                               part = part_of(graph, number);
                               return {};
                           }},
                          surface, bounds, threads));
    ORO_CHECK(check_chunks());
    return graph;
}

Result<void> ClusterFile::check_sound(GraphByGroups graph, const OriginalSurface& surface,
                                      const GroundBounds& bounds, int threads) const {
    graph.leaves = outline_.leaves;
    graph.clusters = outline_.clusters;
    graph.groups = outline_.groups;
    graph.levels = static_cast<std::uint32_t>(outline_.levels.size());
    ORO_TRY(const std::optional<UnsoundGroup> wrong, unsound_group(graph, surface, bounds, threads));
    if (!wrong) return {};
    return unsound(wrong->group, wrong->what);
}

Result<void> ClusterFile::check(const OriginalSurface& surface, const GroundBounds& bounds,
                                const LeavesOneByOne& leaves, int threads) const {
    std::size_t triangles = 0;
    for (std::uint32_t leaf = 0; leaf < leaves.count; ++leaf) triangles += leaves.triangles(leaf).size();
    ORO_CHECK(check_surface(*this, surface, leaves.count, triangles));
    ORO_CHECK(groups());
    ORO_CHECK(check_sound(
        {.leaf = leaves.triangles,
         .part = [this](std::uint32_t number, GroupPart& part) { return this->part(number, part); }},
        surface, bounds, threads));
    return check_chunks();
}

}  // namespace oro
