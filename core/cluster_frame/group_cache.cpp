#include "core/cluster_frame/group_cache.h"

#include <utility>

namespace oro {

std::uint64_t held_bytes(const GroupPart& part) {
    // Beside its lists: itself, its place in the order, and what the allocator takes for each.
    constexpr std::uint64_t overhead = sizeof(GroupPart) + 160;
    return overhead + part.members.capacity() * sizeof(std::uint32_t) +
           part.made.capacity() * sizeof(Cluster) + part.triangles.capacity() * sizeof(VertexTriangle);
}

void GroupCache::make_places(std::size_t groups, std::size_t clusters, std::uint32_t leaves) {
    held_.resize(groups);
    reaches_.resize(clusters);
    users_.assign(leaves, no_group);
}

void GroupCache::begin_frame() {
    ++frame_;
    for (const std::uint32_t group : hidden_)
        if (group < held_.size() && held_[group]) order_.splice(order_.begin(), order_, held_[group]->place);
}

const GroupPart* GroupCache::use(std::uint32_t group) {
    Held* const held = held_[group].get();
    if (held == nullptr) return nullptr;
    if (held->used < frame_) {
        held->used = frame_;
        order_.splice(order_.end(), order_, held->place);
    }
    return held->part.get();
}

std::shared_ptr<const GroupPart> GroupCache::share(std::uint32_t group) const {
    const std::scoped_lock lock(mutex_);
    return held_[group] ? held_[group]->part : nullptr;
}

const GroupPart* GroupCache::put(std::uint32_t group, std::unique_ptr<GroupPart> part) {
    if (const GroupPart* const here = use(group)) return here;
    const std::uint64_t bytes = held_bytes(*part);
    evict_unused(bytes);
    for (const std::uint32_t member : part->members)
        if (member < users_.size()) users_[member] = group;
    auto held = std::make_unique<Held>();
    held->part = std::move(part);
    held->used = frame_;
    held->place = order_.insert(order_.end(), group);
    bytes_ += bytes;
    const std::scoped_lock lock(mutex_);
    held_[group] = std::move(held);
    return held_[group]->part.get();
}

void GroupCache::put_reach(std::uint32_t cluster, std::uint32_t maker, const ClusterReach& reach) {
    if (const std::uint32_t group = keeper(cluster, maker);
        group == no_group ? !held_.empty() : use(group) == nullptr)
        return;
    if (reaches_[cluster]) return;
    evict_unused(held_reach_bytes);
    reaches_[cluster] = std::make_unique<ClusterReach>(reach);
    bytes_ += held_reach_bytes;
}

void GroupCache::evict_unused(std::uint64_t more) {
    // The frame's own are the last.
    while (bytes_ + more > most_bytes_ && !order_.empty() && held_[order_.front()]->used < frame_)
        drop(order_.front());
}

void GroupCache::drop(std::uint32_t group) {
    std::unique_ptr<Held> held;
    {
        const std::scoped_lock lock(mutex_);
        held = std::move(held_[group]);
    }
    const GroupPart& part = *held->part;
    for (std::uint32_t i = 0; i < part.group.made; ++i) drop_reach(part.group.first_made + i);
    for (const std::uint32_t member : part.members)
        if (member < users_.size() && users_[member] == group) drop_reach(member);
    bytes_ -= held_bytes(part);
    order_.erase(held->place);
}

void GroupCache::drop_reach(std::uint32_t cluster) {
    if (!reaches_[cluster]) return;
    reaches_[cluster].reset();
    bytes_ -= held_reach_bytes;
}

}  // namespace oro
