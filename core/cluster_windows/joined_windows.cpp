#include "core/cluster_windows/joined_windows.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace oro {
namespace {

Error differ(const std::string& what) {
    return {ErrorKind::failed, "windows of clusters", what};
}

}  // namespace

Result<JoinedWindows> JoinedWindows::join(std::vector<WindowFile> windows, const PostCounts& posts,
                                          int levels) {
    JoinedWindows joined;
    joined.windows_ = std::move(windows);
    joined.posts_ = posts;
    joined.levels_.resize(static_cast<std::size_t>(levels));
    ORO_CHECK(joined.number_groups());
    ORO_CHECK(joined.link());
    ORO_CHECK(joined.report());
    return joined;
}

// By level and tile; what each made follows what the one before it made.
Result<void> JoinedWindows::number_groups() {
    for (const WindowFile& window : windows_) {
        for (const WindowGroup& group : window.index().groups) {
            if (group.level < 1 || group.level > levels_.size())
                return differ("have a group of level " + std::to_string(group.level));
            // A window that went on from there tells it again.
            if (group.level == window.index().locks.size() && group.level < levels_.size()) continue;
            groups_.push_back({&group, &window});
        }
    }
    const auto key = [](const Entry& entry) { return std::pair(entry.group->level, entry.group->tile); };
    std::ranges::sort(groups_, {}, key);
    if (std::ranges::adjacent_find(groups_, {}, key) != groups_.end()) return differ("have a group twice");
    for (std::size_t level = 1; level <= levels_.size() + 1; ++level)
        first_groups_.push_back(static_cast<std::uint32_t>(
            std::ranges::lower_bound(groups_, level, {},
                                     [](const Entry& entry) { return std::size_t{entry.group->level}; }) -
            groups_.begin()));
    std::vector<const WindowLeaf*> leaves;
    for (const WindowFile& window : windows_)
        for (const WindowLeaf& leaf : window.index().leaves) leaves.push_back(&leaf);
    std::ranges::sort(leaves, {}, [](const WindowLeaf* leaf) { return std::pair(leaf->row, leaf->column); });
    for (const WindowLeaf* const leaf : leaves) {
        ORO_TRY(const std::uint32_t user, number_of(1, leaf->user));
        leaf_users_.push_back(user);
    }
    std::uint32_t next = this->leaves();
    for (const Entry& entry : groups_) {
        first_made_.push_back(next);
        if (entry.group->level < levels_.size()) next += entry.group->made;
    }
    first_made_.push_back(next);
    return {};
}

Result<std::uint32_t> JoinedWindows::number_of(std::size_t level, const GroupTile& tile) const {
    const auto first = groups_.begin() + first_groups_[level - 1],
               last = groups_.begin() + first_groups_[level];
    const auto found =
        std::ranges::lower_bound(first, last, tile, {}, [](const Entry& entry) { return entry.group->tile; });
    if (found == last || found->group->tile != tile)
        return differ("use a group of level " + std::to_string(level) + " that none of them has");
    return static_cast<std::uint32_t>(found - groups_.begin());
}

// Which group uses each cluster, and so which clusters each group uses.
Result<void> JoinedWindows::link() {
    std::vector<GroupTile> tiles;
    for (const Entry& entry : groups_) {
        if (entry.group->level == levels_.size()) break;
        ORO_CHECK(entry.window->read_users(*entry.group, tiles));
        for (const GroupTile& tile : tiles) {
            ORO_TRY(const std::uint32_t user, number_of(entry.group->level + 1, tile));
            users_.push_back(user);
        }
    }
    first_members_.assign(groups_.size() + 1, 0);
    const auto count = [&](const std::vector<std::uint32_t>& users) {
        for (const std::uint32_t user : users) ++first_members_[user + 1];
    };
    count(leaf_users_);
    count(users_);
    std::partial_sum(first_members_.begin(), first_members_.end(), first_members_.begin());
    members_.resize(leaf_users_.size() + users_.size());
    std::vector<std::uint64_t> next(first_members_.begin(), first_members_.end() - 1);
    std::uint32_t cluster = 0;
    for (const auto* const users : {&leaf_users_, &users_})
        for (const std::uint32_t user : *users) members_[next[user]++] = cluster++;
    return {};
}

// What was done at each level, as the builder tells it.
Result<void> JoinedWindows::report() {
    for (std::uint32_t i = 0; i < groups(); ++i) {
        const WindowGroup& group = *groups_[i].group;
        if (first_members_[i] == first_members_[i + 1]) return differ("have a group that uses nothing");
        GraphLevel& level = levels_[group.level - 1];
        level.triangles_in += group.triangles_in;
        level.triangles_out += group.triangles_out;
        ++level.groups;
        if (group.level < levels_.size()) level.clusters_out += group.made;
        level.stuck_groups += group.triangles_out > stuck_share * group.triangles_in ? 1U : 0U;
        level.largest_group = std::max<std::size_t>(level.largest_group, group.triangles_in);
        level.largest_error_m = std::max(level.largest_error_m, group.error_m);
    }
    for (const WindowFile& window : windows_) {
        for (std::size_t i = 0; i < std::min(levels_.size(), window.index().locks.size()); ++i) {
            levels_[i].locked += window.index().locks[i].locked;
            levels_[i].locked_twice += window.index().locks[i].twice;
        }
    }
    for (std::size_t i = 1; i < levels_.size(); ++i)
        if (levels_[i].triangles_in != levels_[i - 1].triangles_out)
            return differ("lose triangles between levels " + std::to_string(i) + " and " +
                          std::to_string(i + 1));
    return {};
}

Result<void> JoinedWindows::read(std::uint32_t number, GroupPart& part) const {
    const Entry& entry = groups_[number];
    ORO_CHECK(entry.window->read(*entry.group, posts_, part));
    part.number = number;
    part.group.first_made = first_made_[number];
    part.members.assign(members_.begin() + static_cast<std::ptrdiff_t>(first_members_[number]),
                        members_.begin() + static_cast<std::ptrdiff_t>(first_members_[number + 1]));
    part.group.members = static_cast<std::uint32_t>(part.members.size());
    const bool is_last = entry.group->level == levels_.size();
    for (std::uint32_t i = 0; i < part.made.size(); ++i) {
        part.made[i].made_by = number;
        part.made[i].used_by = is_last ? no_group : users_[first_made_[number] + i - leaves()];
    }
    return {};
}

}  // namespace oro
