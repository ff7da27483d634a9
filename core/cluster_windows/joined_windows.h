// Windows put together: their groups and clusters with the numbers that they have in the graph of the region.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "core/cluster_file/cluster_file.h"
#include "core/cluster_windows/window_file.h"

namespace oro {

// Groups of all levels that windows have built, level by level and by tile, as the builder numbers them.
class JoinedWindows {
  public:
    // levels: that windows have; where some go on from what others left, that of the last. Errors: windows
    // that do not agree; damage.
    static Result<JoinedWindows> join(std::vector<WindowFile> windows, const PostCounts& posts, int levels);

    [[nodiscard]] std::uint32_t leaves() const { return static_cast<std::uint32_t>(leaf_users_.size()); }
    // Of the levels, without the clusters of the last.
    [[nodiscard]] const std::vector<GraphLevel>& levels() const { return levels_; }
    [[nodiscard]] std::uint32_t groups() const { return static_cast<std::uint32_t>(groups_.size()); }
    // The number of a level's first group, 1 .. levels; of the level after the last: groups().
    [[nodiscard]] std::uint32_t first_group(std::size_t level) const { return first_groups_[level - 1]; }
    // The first cluster that a group made; of groups(): those of the last level's groups begin with none but
    // what all before it have made.
    [[nodiscard]] std::uint32_t first_made(std::uint32_t group) const { return first_made_[group]; }
    [[nodiscard]] const WindowGroup& group(std::uint32_t number) const { return *groups_[number].group; }
    // All windows, for joining them with more.
    [[nodiscard]] std::vector<WindowFile> take_windows() && { return std::move(windows_); }
    // A group whole, but for what uses the clusters of the last level. From any number of threads.
    Result<void> read(std::uint32_t number, GroupPart& part) const;

  private:
    struct Entry {
        const WindowGroup* group;
        const WindowFile* window;
    };
    Result<std::uint32_t> number_of(std::size_t level, const GroupTile& tile) const;
    Result<void> number_groups();
    Result<void> link();
    Result<void> report();

    std::vector<WindowFile> windows_;
    PostCounts posts_;
    std::vector<Entry> groups_;
    std::vector<std::uint32_t> first_groups_;  // by level, and after the last
    std::vector<std::uint32_t> first_made_;    // by group, and after the last
    std::vector<std::uint32_t> leaf_users_;
    std::vector<std::uint32_t> users_;          // of clusters above the leaves, below the last level's
    std::vector<std::uint64_t> first_members_;  // by group
    std::vector<std::uint32_t> members_;
    std::vector<GraphLevel> levels_;
};

}  // namespace oro
