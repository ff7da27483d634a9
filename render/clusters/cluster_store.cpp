#include "render/clusters/cluster_store.h"

#include <algorithm>
#include <cstring>
#include <memory>

namespace oro {
namespace {

constexpr std::size_t slot_bytes = sizeof(gpu::ClusterBlock);
static_assert(slot_bytes % 16 == 0);

// Buffers of 8 MB, and 1 MB on its way.
CacheLayout cluster_cache_layout() {
    constexpr std::size_t slots_in_buffer = 4096, slots_in_staging = 512;
    return {.name = "clusters",
            .item_bytes = slot_bytes,
            .first_buffer = slots_in_buffer,
            .largest_buffer = slots_in_buffer,
            .smallest_buffer = slots_in_buffer,
            .staging_bytes = slots_in_staging * slot_bytes};
}

}  // namespace

ClusterStore::ClusterStore(const Gpu& gpu, std::uint64_t bytes)
    : cache_(gpu, cluster_cache_layout(),
             std::make_shared<MemoryBudget>(std::max<std::uint64_t>(1, bytes / slot_bytes) * slot_bytes)) {}

ClusterStore::Held ClusterStore::use(std::uint32_t cluster) {
    const Cache::Handle handle = cache_.items().find(cluster);
    cache_.items().use(handle);
    return {cache_.address(handle), cache_.items().at(handle).value.counts};
}

void ClusterStore::mark_occluded(std::uint32_t cluster, bool is_hidden) {
    const Cache::Handle handle = cache_.items().find(cluster);
    if (handle != none) cache_.items().set_rank(handle, is_hidden ? 0 : 1);
}

Result<void> ClusterStore::hold(std::span<const std::uint32_t> clusters, const Fill& fill) {
    for (const std::uint32_t cluster : clusters)
        if (is_here(cluster)) use(cluster);
    gpu::ClusterBlock block{};
    for (const std::uint32_t cluster : clusters) {
        if (is_here(cluster)) continue;
        const Result<std::uint32_t> filled = fill(cluster, block);
        // What was added is uploaded first: it counts as being here.
        if (!filled.ok()) ORO_CHECK(cache_.upload());
        ORO_TRY(const std::uint32_t counts, filled);
        ORO_TRY(const bool is_added, add({cluster, counts, &block}));
        if (is_added) continue;
        ORO_CHECK(cache_.upload());
        return Error{ErrorKind::failed, "the GPU", "has too little memory for the clusters of one frame"};
    }
    return cache_.upload();
}

Result<void> ClusterStore::send(std::span<const Loaded> clusters) {
    for (const Loaded& cluster : clusters) {
        if (is_here(cluster.cluster)) {
            use(cluster.cluster);
            continue;
        }
        ORO_TRY(const bool is_added, add(cluster));
        if (!is_added) break;
    }
    return cache_.upload();
}

Result<bool> ClusterStore::add(const Loaded& loaded) {
    ORO_TRY(const Cache::Added added, cache_.add(loaded.cluster, slot_bytes));
    if (added.bytes == nullptr) return false;
    std::memcpy(added.bytes, loaded.block, slot_bytes);
    cache_.items().value(added.handle).counts = loaded.counts;
    cache_.items().set_rank(added.handle, 1);
    return true;
}

}  // namespace oro
