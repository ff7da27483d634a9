#include "core/cluster_file/cluster_format.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/base/checksum.h"
#include "core/base/little_endian.h"

namespace oro::cluster_format {
namespace {

// Puts or gets numbers one after another; visit() names them once for both ways.
class Putter {
  public:
    explicit Putter(std::byte* at) : at_(at) {}
    template <class T>
    void operator()(const T& number) {
        to_little_endian(number, at_);
        at_ += sizeof(T);
    }

  private:
    std::byte* at_;
};
class Getter {
  public:
    explicit Getter(const std::byte* at) : at_(at) {}
    template <class T>
    void operator()(T& number) {
        number = from_little_endian<T>(at_);
        at_ += sizeof(T);
    }

  private:
    const std::byte* at_;
};

template <class Visit, class HeaderOf>
void visit_header(Visit& visit, HeaderOf& header) {
    visit(header.file_bytes);
    visit(header.outline.fingerprint);
    visit(header.outline.posts.rows);
    visit(header.outline.posts.columns);
    visit(header.outline.leaves);
    visit(header.outline.clusters);
    visit(header.outline.groups);
    visit(header.levels);
    visit(header.outline.members);
    visit(header.outline.triangles);
    visit(header.levels_checksum);
}
constexpr std::size_t at_numbers = 16;  // after magic, version and the header's size
static_assert(header_bytes == at_numbers + 2 * 8 + 6 * 4 + 3 * 8 + 8);

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

HeaderBytes header_to_bytes(const Header& header) {
    HeaderBytes bytes{};
    std::memcpy(bytes.data(), magic.data(), magic.size());
    to_little_endian(version, &bytes[8]);
    to_little_endian(static_cast<std::uint32_t>(header_bytes), &bytes[12]);
    Putter put(&bytes[at_numbers]);
    visit_header(put, header);
    to_little_endian(xxh64(std::span(bytes).first(header_bytes - 8)), &bytes[header_bytes - 8]);
    return bytes;
}

Header header_from_bytes(const HeaderBytes& bytes) {
    Header header;
    Getter get(&bytes[at_numbers]);
    visit_header(get, header);
    return header;
}

std::vector<std::byte> levels_to_bytes(std::span<const GraphLevel> levels) {
    std::vector<std::byte> bytes(levels.size() * level_bytes);
    Putter put(bytes.data());
    for (const GraphLevel& level : levels) visit_level(put, level);
    return bytes;
}

std::vector<GraphLevel> levels_from_bytes(std::span<const std::byte> bytes) {
    std::vector<GraphLevel> levels(bytes.size() / level_bytes);
    Getter get(bytes.data());
    for (GraphLevel& level : levels) visit_level(get, level);
    return levels;
}

Offsets offsets_of(const Header& header) {
    const std::uint64_t records = header_bytes + std::uint64_t{header.levels} * level_bytes;
    return {records, records + std::uint64_t{header.outline.groups} * record_bytes};
}

RecordBytes record_to_bytes(const StoredGroup& stored, std::uint32_t number) {
    RecordBytes bytes{};
    Putter put(bytes.data());
    std::uint32_t whole = stored.group.whole ? 1 : 0;
    visit_record(put, stored, whole);
    to_little_endian(xxh64(std::span(bytes).first(record_bytes - 8), number), &bytes[record_bytes - 8]);
    return bytes;
}

StoredGroup record_from_bytes(const RecordBytes& bytes) {
    StoredGroup stored;
    Getter get(bytes.data());
    std::uint32_t whole = 0;
    visit_record(get, stored, whole);
    stored.group.whole = whole != 0;
    return stored;
}

std::optional<std::string> wrong_checksum(std::span<const std::byte> bytes, std::uint64_t seed) {
    const std::size_t without = bytes.size() - 8;
    const auto stored = from_little_endian<std::uint64_t>(&bytes[without]);
    const std::uint64_t computed = xxh64(bytes.first(without), seed);
    if (computed == stored) return std::nullopt;
    return differ("has checksum", computed, stored);
}

std::optional<std::string> implausible(const Header& header) {
    const ClusterOutline& outline = header.outline;
    const PostCounts& posts = outline.posts;
    if (posts.rows < 2 || posts.columns < 2 ||
        static_cast<std::uint64_t>(posts.rows) * static_cast<std::uint64_t>(posts.columns) > no_group)
        return "says " + std::to_string(posts.rows) + " x " + std::to_string(posts.columns) +
               " posts, expected 2 x 2 to 2^32 - 1 in all";
    if (header.levels > most_levels)
        return "says " + std::to_string(header.levels) + " levels, expected at most " +
               std::to_string(most_levels);
    const Offsets offsets = offsets_of(header);
    if (offsets.payloads > header.file_bytes)
        return differ("says " + std::to_string(outline.groups) + " groups; their records end at byte",
                      offsets.payloads, header.file_bytes) +
               " at most";
    if (outline.clusters == no_group || outline.leaves > outline.clusters)
        return "says " + std::to_string(outline.leaves) + " leaves of " + std::to_string(outline.clusters) +
               " clusters";
    // All clusters but those of the last level are used, each once.
    if (outline.members > outline.clusters)
        return "says " + std::to_string(outline.members) + " members, but has " +
               std::to_string(outline.clusters) + " clusters";
    if ((header.levels == 0) != (outline.groups == 0))
        return "says " + std::to_string(outline.groups) + " groups in " + std::to_string(header.levels) +
               " levels";
    return std::nullopt;
}

std::optional<std::string> implausible(const Header& header, std::span<const GraphLevel> levels) {
    const ClusterOutline& outline = header.outline;
    std::uint64_t groups = 0, clusters = outline.leaves, triangles = 0;
    // What is left of the original's triangles: nothing makes more of them.
    std::uint64_t left = 2 * static_cast<std::uint64_t>(outline.posts.rows - 1) *
                         static_cast<std::uint64_t>(outline.posts.columns - 1);
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const GraphLevel& level = levels[i];
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
    if (groups != outline.groups) return differ("have groups:", groups, outline.groups);
    if (clusters != outline.clusters) return differ("have clusters:", clusters, outline.clusters);
    if (triangles != outline.triangles) return differ("have triangles:", triangles, outline.triangles);
    return std::nullopt;
}

std::optional<std::string> implausible(const StoredGroup& stored, const Header& header) {
    const ClusterGroup& group = stored.group;
    for (const double number :
         {group.error_m, group.centre.m.x, group.centre.m.y, group.centre.m.z, group.radius_m}) {
        if (!std::isfinite(number)) return "has a number that is not finite";
    }
    if (group.error_m < 0.0 || group.radius_m < 0.0)
        return "has error " + std::to_string(group.error_m) + " m and radius " +
               std::to_string(group.radius_m) + " m, expected none below 0";
    if (group.members < 1 || group.members > most_group_members || group.members > header.outline.members)
        return "says " + std::to_string(group.members) + " members, expected 1 to " +
               std::to_string(std::min<std::uint64_t>(most_group_members, header.outline.members));
    if (group.made < 1 || group.made > stored.triangles || stored.triangles > most_group_triangles)
        return "says " + std::to_string(stored.triangles) + " triangles in " + std::to_string(group.made) +
               " clusters, expected 1 to " + std::to_string(most_group_triangles);
    if (group.first_made < header.outline.leaves ||
        std::uint64_t{group.first_made} + group.made > header.outline.clusters)
        return "made clusters " + std::to_string(group.first_made) + " to " +
               std::to_string(std::uint64_t{group.first_made} + group.made - 1) + ", expected some of " +
               std::to_string(header.outline.leaves) + " to " + std::to_string(header.outline.clusters - 1);
    const std::uint64_t first = offsets_of(header).payloads;
    if (stored.payload_offset < first || stored.payload_offset > header.file_bytes ||
        stored.payload_bytes > header.file_bytes - stored.payload_offset)
        return "has its payload at byte " + std::to_string(stored.payload_offset) + ", " +
               std::to_string(stored.payload_bytes) + " bytes long, expected it within bytes " +
               std::to_string(first) + " to " + std::to_string(header.file_bytes);
    return std::nullopt;
}

}  // namespace oro::cluster_format
