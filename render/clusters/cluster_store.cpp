#include "render/clusters/cluster_store.h"

#include <algorithm>
#include <cstring>
#include <string>

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

// A slot that nothing of this frame is in.
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
            return slots_[a].used != slots_[b].used ? slots_[a].used > slots_[b].used : a > b;
        });
    }
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

Result<std::vector<ClusterStore::Held>> ClusterStore::hold(std::span<const std::uint32_t> clusters,
                                                           const Fill& fill) {
    if (clusters.size() > capacity_)
        return Error{ErrorKind::failed, "--gpu-memory",
                     "is too small for this view's clusters: they take " +
                         std::to_string((clusters.size() * slot_bytes + 999'999) / 1'000'000) + " MB, and " +
                         std::to_string(capacity_ * slot_bytes / 1'000'000) +
                         " MB are there for them (half of all); a larger --tau takes fewer"};
    ++frame_;
    unused_.clear();
    for (const std::uint32_t cluster : clusters) {
        if (cluster >= slot_of_.size()) slot_of_.resize(cluster + std::size_t{1}, no_slot);
        if (slot_of_[cluster] != no_slot) slots_[slot_of_[cluster]].used = frame_;
    }
    std::vector<Held> held;
    std::vector<std::size_t> batch;
    gpu::ClusterBlock block{};
    for (const std::uint32_t cluster : clusters) {
        if (slot_of_[cluster] == no_slot) {
            const Result<std::uint32_t> filled = fill(cluster, block);
            // What is staged goes first: it counts as being here.
            if (!filled.ok()) ORO_CHECK(copy(batch));
            ORO_TRY(const std::uint32_t counts, filled);
            const Result<std::size_t> free = free_slot();
            if (!free.ok()) ORO_CHECK(copy(batch));
            ORO_TRY(const std::size_t slot, free);
            std::memcpy(staging_.mapped + batch.size() * slot_bytes, &block, slot_bytes);
            slots_[slot] = {cluster, counts, frame_};
            slot_of_[cluster] = slot;
            ++held_;
            batch.push_back(slot);
            if (batch.size() == slots_in_staging) {
                ORO_CHECK(copy(batch));
                batch.clear();
            }
        }
        held.push_back({address(slot_of_[cluster]), slots_[slot_of_[cluster]].counts});
    }
    ORO_CHECK(copy(batch));
    return held;
}

// What does not arrive is not here.
Result<void> ClusterStore::copy(std::span<const std::size_t> slots) {
    if (slots.empty()) return {};
    const Result<void> copied = commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const VkBufferCopy region{i * slot_bytes, slots[i] % slots_per_chunk * slot_bytes, slot_bytes};
            vkCmdCopyBuffer(commands, staging_.handle.get(), chunks_[slots[i] / slots_per_chunk].handle.get(),
                            1, &region);
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
    for (std::size_t i = 0; !copied.ok() && i < slots.size(); ++i) forget(slots_[slots[i]].cluster);
    sent_ += slots.size();
    return copied;
}

}  // namespace oro
