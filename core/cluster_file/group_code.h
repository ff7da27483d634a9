// One group of a cluster graph as bytes: what it uses, what it made, and the triangles of that.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/clusters/cluster_graph.h"

namespace oro {

// Where vertex numbers lie in a grid: the one place of this folder where a vertex is a post.
struct PostCounts {
    std::int32_t rows{};  // 2 or more, as columns; at most 2^32 - 1 posts
    std::int32_t columns{};

    [[nodiscard]] SurfaceVertex place(VertexNumber number) const {
        const auto across = static_cast<VertexNumber>(columns);
        return {static_cast<std::int32_t>(number / across), static_cast<std::int32_t>(number % across), 0};
    }
    [[nodiscard]] VertexNumber number(std::int32_t row, std::int32_t column) const {
        return static_cast<VertexNumber>(row) * static_cast<VertexNumber>(columns) +
               static_cast<VertexNumber>(column);
    }
};

// A group by itself: all that is known of it without others.
struct GroupPart {
    std::uint32_t number{};  // in the graph
    ClusterGroup group{};    // first_member means nothing
    std::vector<std::uint32_t> members;
    std::vector<Cluster> made;  // first_triangle: in `triangles`
    std::vector<VertexTriangle> triangles;
};

// A group of a graph, by itself.
[[nodiscard]] GroupPart part_of(const ClusterGraph& graph, std::uint32_t number);

// No group that is written has more triangles than this, so none that is read asks for more memory.
inline constexpr std::uint32_t most_group_triangles = 1U << 22U;
inline constexpr std::uint32_t most_group_members = 1U << 20U;
// No group of so many triangles, clusters and members takes more bytes than this: what is written takes some
// 2 a triangle.
[[nodiscard]] constexpr std::uint64_t most_group_bytes(std::uint64_t triangles, std::uint64_t clusters,
                                                       std::uint64_t members) {
    return 64 + 64 * triangles + 64 * clusters + 16 * members;
}

// A group's triangles, members and links in few bytes, the same for the same group. `group` itself lies in
// the group's record (core/cluster_file/cluster_format.h). clusters: of the graph. Errors: a group above the
// limits; triangles that are not in the order of a walk (walk_order), as the builder makes
// them.
[[nodiscard]] Result<std::vector<std::byte>> encode_group(const GroupPart& part, const PostCounts& posts,
                                                          std::uint32_t clusters);

// The inverse, for a part whose `number` and `group` are known. Any bytes may be given: nothing when they are
// such a group, else what is wrong with them, in words that follow "the payload"; `part` is then of no use.
// Posts are in the grid, triangles clockwise, clusters within their limits; what members and links lead to
// is the graph's business (core/cluster_file/sound_graph.h).
[[nodiscard]] std::optional<std::string> decode_group(std::span<const std::byte> bytes,
                                                      const PostCounts& posts, std::uint32_t clusters,
                                                      GroupPart& part);

}  // namespace oro
