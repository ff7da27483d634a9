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
    parts_.resize(groups);
    const auto ring = static_cast<std::uint32_t>(groups);
    places_.assign(groups + 1, {0, ring, ring});
    reaches_.resize(clusters);
    users_.assign(leaves, no_group);
}

void GroupCache::put_before(std::uint32_t next, std::uint32_t group) {
    const std::uint32_t before = places_[next].before;
    places_[group].before = before;
    places_[group].after = next;
    places_[before].after = group;
    places_[next].before = group;
}

void GroupCache::take_out(std::uint32_t group) {
    const Place& place = places_[group];
    places_[place.before].after = place.after;
    places_[place.after].before = place.before;
}

void GroupCache::begin_frame() {
    ++frame_;
    for (const std::uint32_t group : hidden_) {
        if (group >= parts_.size() || !parts_[group]) continue;
        take_out(group);
        put_before(places_[ring()].after, group);
    }
}

const GroupPart* GroupCache::use(std::uint32_t group) {
    const GroupPart* const part = parts_[group].get();
    if (part == nullptr || places_[group].used >= frame_) return part;
    places_[group].used = frame_;
    take_out(group);
    put_before(ring(), group);
    return part;
}

std::shared_ptr<const GroupPart> GroupCache::share(std::uint32_t group) const {
    const std::scoped_lock lock(mutex_);
    return parts_[group];
}

const GroupPart* GroupCache::put(std::uint32_t group, std::unique_ptr<GroupPart> part) {
    if (const GroupPart* const here = use(group)) return here;
    const std::uint64_t bytes = held_bytes(*part);
    evict_unused(bytes);
    for (const std::uint32_t member : part->members)
        if (member < users_.size()) users_[member] = group;
    places_[group].used = frame_;
    put_before(ring(), group);
    ++size_;
    bytes_ += bytes;
    const std::scoped_lock lock(mutex_);
    parts_[group] = std::move(part);
    return parts_[group].get();
}

void GroupCache::put_reach(std::uint32_t cluster, std::uint32_t maker, const ClusterReach& reach) {
    if (const std::uint32_t group = keeper(cluster, maker);
        group == no_group ? !parts_.empty() : use(group) == nullptr)
        return;
    if (reaches_[cluster]) return;
    evict_unused(held_reach_bytes);
    reaches_[cluster] = std::make_unique<ClusterReach>(reach);
    bytes_ += held_reach_bytes;
}

void GroupCache::evict_unused(std::uint64_t more) {
    // The frame's own are the last.
    while (bytes_ + more > most_bytes_) {
        const std::uint32_t first = places_[ring()].after;
        if (first == ring() || places_[first].used >= frame_) return;
        drop(first);
    }
}

void GroupCache::drop(std::uint32_t group) {
    std::shared_ptr<const GroupPart> held;
    {
        const std::scoped_lock lock(mutex_);
        held = std::move(parts_[group]);
    }
    const GroupPart& part = *held;
    for (std::uint32_t i = 0; i < part.group.made; ++i) drop_reach(part.group.first_made + i);
    for (const std::uint32_t member : part.members)
        if (member < users_.size() && users_[member] == group) drop_reach(member);
    bytes_ -= held_bytes(part);
    take_out(group);
    --size_;
}

void GroupCache::drop_reach(std::uint32_t cluster) {
    if (!reaches_[cluster]) return;
    reaches_[cluster].reset();
    bytes_ -= held_reach_bytes;
}

}  // namespace oro
