#include "render/clusters/cluster_store.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <tuple>

namespace oro {
namespace {

constexpr std::size_t slots_per_chunk = 4096;  // 8 MB
constexpr std::size_t slots_in_staging = 512;
constexpr std::size_t slot_bytes = sizeof(gpu::ClusterBlock);
constexpr std::size_t no_slot = ~std::size_t{0};
static_assert(slot_bytes % 16 == 0);

}  // namespace

Result<ClusterStore> ClusterStore::create(const Gpu& gpu, std::uint64_t bytes) {
    ClusterStore store(gpu);
    store.capacity_ = static_cast<std::size_t>(std::max<std::uint64_t>(1, bytes / slot_bytes));
    ORO_TRY(store.commands_, Commands::create(gpu, "cluster upload"));
    ORO_TRY(store.staging_,
            create_buffer(gpu, slots_in_staging * slot_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          MemoryKind::upload, "cluster staging"));
    return store;
}

std::uint64_t ClusterStore::bytes() const {
    std::uint64_t bytes = 0;
    for (const Buffer& chunk : chunks_) bytes += chunk.size;
    return bytes;
}

std::uint64_t ClusterStore::address(std::size_t slot) const {
    return chunks_[slot / slots_per_chunk].address + slot % slots_per_chunk * slot_bytes;
}

// A slot that nothing of this frame is in; no_slot where there is none.
Result<std::size_t> ClusterStore::free_slot() {
    if (slots_.size() < capacity_) {
        const std::size_t slot = slots_.size();
        if (slot / slots_per_chunk == chunks_.size()) {
            const std::size_t count = std::min(slots_per_chunk, capacity_ - slot);
            ORO_TRY(Buffer chunk,
                    create_buffer(*gpu_, count * slot_bytes,
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                      VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT,
                                  MemoryKind::device, "clusters " + std::to_string(chunks_.size())));
            chunks_.push_back(std::move(chunk));
        }
        slots_.push_back({});
        return slot;
    }
    if (unused_.empty()) {
        for (std::size_t i = 0; i < slots_.size(); ++i) {
            if (slots_[i].used < frame_) unused_.push_back(i);
        }
        std::ranges::sort(unused_, [&](std::size_t a, std::size_t b) {
            const auto stays = [&](std::size_t slot) {
                return std::tuple(!slots_[slot].is_hidden, slots_[slot].used, slot);
            };
            return stays(a) > stays(b);
        });
    }
    // What was unused when they were listed may be in use by now.
    while (!unused_.empty() && slots_[unused_.back()].used == frame_) unused_.pop_back();
    if (unused_.empty()) return no_slot;
    const std::size_t slot = unused_.back();
    unused_.pop_back();
    // What never arrived in it may be in another by now.
    if (slot_of_[slots_[slot].cluster] == slot) forget(slots_[slot].cluster);
    return slot;
}

void ClusterStore::forget(std::uint32_t cluster) {
    if (slot_of_[cluster] == no_slot) return;
    slot_of_[cluster] = no_slot;
    --held_;
}

void ClusterStore::forget_clusters() {
    slots_.clear();
    unused_.clear();
    slot_of_.clear();
    held_ = 0;
}

void ClusterStore::begin_frame() {
    ++frame_;
    unused_.clear();
}

bool ClusterStore::is_here(std::uint32_t cluster) const {
    return cluster < slot_of_.size() && slot_of_[cluster] != no_slot;
}

ClusterStore::Held ClusterStore::use(std::uint32_t cluster) {
    const std::size_t slot = slot_of_[cluster];
    slots_[slot].used = frame_;
    return {address(slot), slots_[slot].counts};
}

void ClusterStore::note_hidden(std::uint32_t cluster, bool is_hidden) {
    if (is_here(cluster)) slots_[slot_of_[cluster]].is_hidden = is_hidden;
}

Result<void> ClusterStore::hold(std::span<const std::uint32_t> clusters, const Fill& fill) {
    for (const std::uint32_t cluster : clusters)
        if (is_here(cluster)) use(cluster);
    gpu::ClusterBlock block{};
    for (const std::uint32_t cluster : clusters) {
        if (is_here(cluster)) continue;
        const Result<std::uint32_t> filled = fill(cluster, block);
        // What is staged goes first: it counts as being here.
        if (!filled.ok()) ORO_CHECK(copy_staged());
        ORO_TRY(const std::uint32_t counts, filled);
        ORO_CHECK(stage({cluster, counts, &block}));
        assert(is_here(cluster));
    }
    return copy_staged();
}

Result<void> ClusterStore::send(std::span<const Loaded> clusters) {
    for (const Loaded& cluster : clusters) {
        if (!is_here(cluster.cluster)) ORO_CHECK(stage(cluster));
        if (!is_here(cluster.cluster)) break;
        use(cluster.cluster);
    }
    return copy_staged();
}

// Gives a cluster a slot, where there is one, and copies when enough have come.
Result<void> ClusterStore::stage(const Loaded& loaded) {
    const Result<std::size_t> free = free_slot();
    if (!free.ok()) ORO_CHECK(copy_staged());
    ORO_TRY(const std::size_t slot, free);
    if (slot == no_slot) return {};
    std::memcpy(staging_.mapped + staged_.size() * slot_bytes, loaded.block, slot_bytes);
    slots_[slot] = {loaded.cluster, loaded.counts, frame_, false};
    if (loaded.cluster >= slot_of_.size()) slot_of_.resize(loaded.cluster + std::size_t{1}, no_slot);
    slot_of_[loaded.cluster] = slot;
    ++held_;
    staged_.push_back(slot);
    return staged_.size() == slots_in_staging ? copy_staged() : Result<void>();
}

// What does not arrive is not here.
Result<void> ClusterStore::copy_staged() {
    if (staged_.empty()) return {};
    const Result<void> copied = commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        for (std::size_t i = 0; i < staged_.size(); ++i) {
            const VkBufferCopy region{i * slot_bytes, staged_[i] % slots_per_chunk * slot_bytes, slot_bytes};
            vkCmdCopyBuffer(commands, staging_.handle.get(),
                            chunks_[staged_[i] / slots_per_chunk].handle.get(), 1, &region);
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
    for (std::size_t i = 0; !copied.ok() && i < staged_.size(); ++i) forget(slots_[staged_[i]].cluster);
    sent_ += staged_.size();
    staged_.clear();
    return copied;
}

}  // namespace oro
