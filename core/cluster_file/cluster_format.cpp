#include "core/cluster_file/cluster_format.h"

#include <algorithm>
#include <cmath>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace oro::cluster_format {
namespace {

template <class Visit, class Outline>
void visit_outline(Visit& visit, Outline& outline) {
    visit(outline.fingerprint);
    visit(outline.posts.rows);
    visit(outline.posts.columns);
    visit(outline.leaves);
    visit(outline.clusters);
    visit(outline.groups);
    visit(outline.members);
    visit(outline.triangles);
}
static_assert(outline_bytes == 3 * 8 + 5 * 4);

// Counts as 64 bits, whatever std::size_t has.
template <class Visit, class Level>
void visit_level(Visit& visit, Level& level) {
    const auto count = [&](auto& number) {
        auto wide = static_cast<std::uint64_t>(number);
        visit(wide);
        if constexpr (!std::is_const_v<std::remove_reference_t<decltype(number)>>)
            number = static_cast<std::size_t>(wide);
    };
    count(level.triangles_in);
    count(level.triangles_out);
    count(level.groups);
    count(level.clusters_out);
    count(level.stuck_groups);
    count(level.largest_group);
    visit(level.largest_error_m);
    count(level.locked);
    count(level.locked_twice);
}

template <class Visit, class Stored>
void visit_record(Visit& visit, Stored& stored, std::uint32_t& whole) {
    visit(stored.group.error_m);
    visit(stored.group.centre.m.x);
    visit(stored.group.centre.m.y);
    visit(stored.group.centre.m.z);
    visit(stored.group.radius_m);
    visit(stored.payload_offset);
    visit(stored.payload_checksum);
    visit(stored.payload_bytes);
    visit(stored.group.members);
    visit(stored.group.first_made);
    visit(stored.group.made);
    visit(stored.triangles);
    visit(whole);
}
static_assert(record_bytes == 5 * 8 + 2 * 8 + 6 * 4 + 8);

std::string differ(const std::string& what, std::uint64_t found, std::uint64_t expected) {
    return what + " " + std::to_string(found) + ", expected " + std::to_string(expected);
}

}  // namespace

std::vector<std::byte> outline_to_bytes(const ClusterOutline& outline) {
    NumberWriter put;
    visit_outline(put, outline);
    for (const GraphLevel& level : outline.levels) visit_level(put, level);
    return std::move(put.bytes);
}

ClusterOutline outline_from_bytes(std::span<const std::byte> bytes) {
    ClusterOutline outline;
    NumberReader get(bytes);
    visit_outline(get, outline);
    outline.levels.resize(get.rest().size() / level_bytes);
    for (GraphLevel& level : outline.levels) visit_level(get, level);
    return outline;
}

std::vector<std::byte> record_to_bytes(const StoredGroup& stored, std::uint32_t number) {
    NumberWriter put;
    std::uint32_t whole = stored.group.complete ? 1 : 0;
    visit_record(put, stored, whole);
    put(xxh64(put.bytes, number));
    return std::move(put.bytes);
}

StoredGroup record_from_bytes(std::span<const std::byte> bytes) {
    StoredGroup stored;
    NumberReader get(bytes);
    std::uint32_t whole = 0;
    visit_record(get, stored, whole);
    stored.group.complete = whole != 0;
    return stored;
}

namespace {

// What building did, against the outline.
std::optional<std::string> implausible_levels(const ClusterOutline& outline) {
    std::uint64_t groups = 0, clusters = outline.leaves, triangles = 0;
    // What is left of the original's triangles: nothing makes more of them.
    std::uint64_t left = 2 * static_cast<std::uint64_t>(outline.posts.rows - 1) *
                         static_cast<std::uint64_t>(outline.posts.columns - 1);
    for (std::size_t i = 0; i < outline.levels.size(); ++i) {
        const GraphLevel& level = outline.levels[i];
        const std::string name = "level " + std::to_string(i + 1);
        if (level.triangles_in > left || level.triangles_out > level.triangles_in ||
            (i > 0 && level.triangles_in != left))
            return name + ": says " + std::to_string(level.triangles_out) + " triangles of " +
                   std::to_string(level.triangles_in) + ", where " + std::to_string(left) + " are left";
        if (level.groups == 0 || level.groups > outline.groups || level.clusters_out > level.triangles_out ||
            level.groups > level.clusters_out)
            return name + ": says " + std::to_string(level.groups) + " groups that made " +
                   std::to_string(level.clusters_out) + " clusters";
        if (!std::isfinite(level.largest_error_m)) return name + ": has an error that is not finite";
        left = level.triangles_out;
        groups += level.groups;
        clusters += level.clusters_out;
        triangles += level.triangles_out;
    }
    if (groups != outline.groups) return differ("its levels have groups:", groups, outline.groups);
    if (clusters != outline.clusters) return differ("its levels have clusters:", clusters, outline.clusters);
    if (triangles != outline.triangles)
        return differ("its levels have triangles:", triangles, outline.triangles);
    return std::nullopt;
}

}  // namespace

std::optional<std::string> implausible(const ClusterOutline& outline, std::uint64_t groups_bytes) {
    const PostCounts& posts = outline.posts;
    const std::size_t levels = outline.levels.size();
    if (posts.rows < 2 || posts.columns < 2 ||
        static_cast<std::uint64_t>(posts.rows) * static_cast<std::uint64_t>(posts.columns) > no_group)
        return "says " + std::to_string(posts.rows) + " x " + std::to_string(posts.columns) +
               " posts, expected 2 x 2 to 2^32 - 1 in all";
    if (levels > most_levels)
        return "has " + std::to_string(levels) + " levels, expected at most " + std::to_string(most_levels);
    if (const std::uint64_t bytes = std::uint64_t{outline.groups} * record_bytes; bytes != groups_bytes)
        return differ("says " + std::to_string(outline.groups) + " groups; bytes of their records:",
                      groups_bytes, bytes);
    if (outline.clusters == no_group || outline.leaves > outline.clusters)
        return "says " + std::to_string(outline.leaves) + " leaves of " + std::to_string(outline.clusters) +
               " clusters";
    // All clusters but those of the last level are used, each once.
    if (outline.members > outline.clusters)
        return "says " + std::to_string(outline.members) + " members, but has " +
               std::to_string(outline.clusters) + " clusters";
    if ((levels == 0) != (outline.groups == 0))
        return "says " + std::to_string(outline.groups) + " groups in " + std::to_string(levels) + " levels";
    return implausible_levels(outline);
}

std::optional<std::string> implausible(const StoredGroup& stored, const ClusterOutline& outline,
                                       std::uint64_t meshes_bytes) {
    const ClusterGroup& group = stored.group;
    for (const double number :
         {group.error_m, group.centre.m.x, group.centre.m.y, group.centre.m.z, group.radius_m}) {
        if (!std::isfinite(number)) return "has a number that is not finite";
    }
    if (group.error_m < 0.0 || group.radius_m < 0.0)
        return "has error " + std::to_string(group.error_m) + " m and radius " +
               std::to_string(group.radius_m) + " m, expected none below 0";
    if (group.members < 1 || group.members > most_group_members || group.members > outline.members)
        return "says " + std::to_string(group.members) + " members, expected 1 to " +
               std::to_string(std::min<std::uint64_t>(most_group_members, outline.members));
    if (group.made < 1 || group.made > stored.triangles || stored.triangles > most_group_triangles)
        return "says " + std::to_string(stored.triangles) + " triangles in " + std::to_string(group.made) +
               " clusters, expected 1 to " + std::to_string(most_group_triangles);
    if (group.first_made < outline.leaves || std::uint64_t{group.first_made} + group.made > outline.clusters)
        return "made clusters " + std::to_string(group.first_made) + " to " +
               std::to_string(std::uint64_t{group.first_made} + group.made - 1) + ", expected some of " +
               std::to_string(outline.leaves) + " to " + std::to_string(outline.clusters - 1);
    if (stored.payload_offset > meshes_bytes || stored.payload_bytes > meshes_bytes - stored.payload_offset)
        return "has its payload at byte " + std::to_string(stored.payload_offset) + " of the meshes, " +
               std::to_string(stored.payload_bytes) + " bytes long, but these have " +
               std::to_string(meshes_bytes);
    if (const std::uint64_t most = most_group_bytes(stored.triangles, group.made, group.members);
        stored.payload_bytes > most)
        return "says " + std::to_string(stored.triangles) + " triangles in a payload of " +
               std::to_string(stored.payload_bytes) + " bytes, expected at most " + std::to_string(most);
    return std::nullopt;
}

}  // namespace oro::cluster_format
