// What a group made, as windows keep it until the region's file is written: quick to read and to write.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/cluster_file/group_code.h"

namespace oro {

// Clusters and triangles in their order, in some 3 bytes a triangle. posts: that vertices are numbered in.
[[nodiscard]] std::vector<std::byte> pack_made(const GroupPart& part, const PostCounts& posts);

// Unpacks what pack_made() has packed, for a part whose group.made is known. Any bytes may be given: false
// where they are no such clusters.
[[nodiscard]] bool unpack_made(std::span<const std::byte> bytes, const PostCounts& posts, GroupPart& part);

}  // namespace oro
