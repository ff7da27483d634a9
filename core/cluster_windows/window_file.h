// What a window of a region has built, in a file of its own until all windows are put together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/container.h"
#include "core/base/result.h"
#include "core/cluster_file/group_code.h"
#include "core/clusters/group_tiling.h"

namespace oro {

// One of the original's clusters: where it is, counted in leaves, and the tile of the group that uses it.
struct WindowLeaf {
    std::int32_t row;
    std::int32_t column;
    GroupTile user;
};

// A group that a window answers for, known by its level and its tile.
struct WindowGroup {
    std::uint32_t level{};
    GroupTile tile;
    std::uint32_t made{};  // clusters
    std::uint32_t triangles_in{};
    std::uint32_t triangles_out{};
    double error_m{};
    Ecef centre;
    double radius_m{};
    PlaneBox extent;  // of all that it covers
    // Of what it made: the tiles of the groups that use them, but at the last level, then the clusters
    // (word_code below) with the window's own posts.
    std::uint64_t offset{};  // among all groups' bytes
    std::uint32_t bytes{};
    std::uint64_t checksum{};
};

// Vertices among a window's own posts that had to stay at a level (GraphLevel).
struct WindowLocks {
    std::uint64_t locked{};
    std::uint64_t twice{};
};

// All but what groups made. A window that was built out of what an earlier level made tells of the groups of
// that level, too, as the groups of the next say how what they made is split.
struct WindowIndex {
    std::uint64_t plan{};  // tells what was to be built, of what, from anything else
    PostCounts posts;      // of the window
    std::int32_t first_row{};
    std::int32_t first_column{};
    std::vector<WindowLeaf> leaves;
    std::vector<WindowGroup> groups;
    std::vector<WindowLocks> locks;  // by level
};

// A file of a window, whose groups are read one by one.
class WindowFile {
  public:
    // Errors: none that is whole.
    static Result<WindowFile> open(const std::string& path);
    [[nodiscard]] const WindowIndex& index() const { return index_; }
    // What a group made, with posts of the region (`posts`). Errors: damage.
    Result<void> read(const WindowGroup& group, const PostCounts& posts, GroupPart& part) const;
    // The tile of each of these clusters' users; none at the last level.
    Result<void> read_users(const WindowGroup& group, std::vector<GroupTile>& users) const;

  private:
    WindowFile(std::shared_ptr<const Container> container, WindowIndex index, std::uint64_t blocks)
        : container_(std::move(container)), index_(std::move(index)), blocks_(blocks) {}
    [[nodiscard]] std::size_t users_bytes(const WindowGroup& group) const;
    std::shared_ptr<const Container> container_;
    WindowIndex index_;
    std::uint64_t blocks_;  // byte of the file where the groups' bytes begin
};

// The bytes of what a group made. users: none at the last level.
std::vector<std::byte> window_block(const GroupPart& part, std::span<const GroupTile> users,
                                    const PostCounts& posts);
// blocks: of each group, in their order; their places come into the index here. The file takes its name when
// it is whole, on the disk; one of that name is replaced.
Result<void> write_window(const std::string& path, WindowIndex index,
                          std::span<const std::vector<std::byte>> blocks);

// Clusters and triangles in their order, in some 3 bytes a triangle. posts: that vertices are numbered in.
[[nodiscard]] std::vector<std::byte> pack_made(const GroupPart& part, const PostCounts& posts);

// Unpacks what pack_made() has packed, for a part whose group.made is known. Any bytes may be given: false
// where they are no such clusters.
[[nodiscard]] bool unpack_made(std::span<const std::byte> bytes, const PostCounts& posts, GroupPart& part);

}  // namespace oro
