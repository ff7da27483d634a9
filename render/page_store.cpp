#include "render/page_store.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace oro {
namespace {

constexpr std::size_t pages_per_chunk = 128;  // 10 MB: far below every device's limit on one buffer
constexpr std::size_t pages_in_staging = 64;

}  // namespace

std::size_t page_bytes(const HeightCoding& coding) {
    if (!coding.sixteen) return sizeof(gpu::PageBlock);
    return offsetof(gpu::PageBlock, heights) + sizeof(std::uint32_t) * ((gpu::page_heights + 1) / 2);
}

Result<PageStore> PageStore::create(const Gpu& gpu, std::size_t capacity, const HeightCoding& coding) {
    PageStore store(gpu);
    store.coding_ = coding;
    store.page_bytes_ = page_bytes(coding);
    store.capacity_ = std::max<std::size_t>(1, capacity);
    ORO_TRY(store.commands_, Commands::create(gpu, "page upload"));
    ORO_TRY(store.staging_,
            create_buffer(gpu, pages_in_staging * store.page_bytes_, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          BufferPlace::upload, "page staging"));
    return store;
}

std::uint64_t PageStore::bytes() const {
    std::uint64_t bytes = 0;
    for (const Buffer& chunk : chunks_) bytes += chunk.size;
    return bytes;
}

std::uint64_t PageStore::address(const PageIndex& page) {
    const auto found = slots_of_.find({page.level, page.row, page.column});
    if (found == slots_of_.end()) return 0;
    const std::size_t slot = found->second;
    slots_[slot].used = frame_;
    return chunks_[slot / pages_per_chunk].address + slot % pages_per_chunk * page_bytes_;
}

// A slot that is free, or was not used for longest and not by this frame; false when there is none.
Result<bool> PageStore::find_slot(std::size_t& slot) {
    if (slots_.size() < capacity_) {
        slot = slots_.size();
        if (slot / pages_per_chunk == chunks_.size()) {
            constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                                 VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
            const std::size_t count = std::min(pages_per_chunk, capacity_ - slot);
            ORO_TRY(Buffer chunk, create_buffer(*gpu_, count * page_bytes_, usage, BufferPlace::device,
                                                "pages " + std::to_string(chunks_.size())));
            chunks_.push_back(std::move(chunk));
        }
        slots_.push_back({{}, frame_});
        return true;
    }
    const auto oldest = std::min_element(slots_.begin(), slots_.end(),
                                         [](const Slot& a, const Slot& b) { return a.used < b.used; });
    if (oldest->used >= frame_) return false;
    slots_of_.erase(oldest->page);
    slot = static_cast<std::size_t>(oldest - slots_.begin());
    return true;
}

// A page as it lies on the GPU.
void PageStore::stage(const gpu::PageBlock& block, std::byte* to) const {
    if (!coding_.sixteen) {
        std::memcpy(to, &block, sizeof(block));
        return;
    }
    std::memcpy(to, &block, offsetof(gpu::PageBlock, heights));
    std::array<std::int16_t, gpu::page_heights + 1> codes{};
    for (std::size_t i = 0; i < gpu::page_heights; ++i) codes[i] = coding_.code(block.heights[i]);
    std::memcpy(to + offsetof(gpu::PageBlock, heights), codes.data(), sizeof(codes));
}

Result<std::size_t> PageStore::send(std::span<const LoadedPage> pages) {
    std::size_t sent = 0;
    std::vector<std::size_t> batch;
    for (const LoadedPage& page : pages) {
        const Key key{page.index.level, page.index.row, page.index.column};
        if (slots_of_.contains(key)) {
            ++sent;
            continue;
        }
        std::size_t slot = 0;
        ORO_TRY(const bool found, find_slot(slot));
        if (!found) break;
        slots_[slot] = {key, frame_};
        slots_of_[key] = slot;
        stage(*page.block, staging_.mapped + batch.size() * page_bytes_);
        batch.push_back(slot);
        ++sent;
        if (batch.size() == pages_in_staging) {
            ORO_CHECK(copy(batch));
            batch.clear();
        }
    }
    ORO_CHECK(copy(batch));
    return sent;
}

Result<void> PageStore::copy(std::span<const std::size_t> slots) {
    if (slots.empty()) return {};
    return commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        for (std::size_t i = 0; i < slots.size(); ++i) {
            const VkBufferCopy copy{i * page_bytes_, slots[i] % pages_per_chunk * page_bytes_, page_bytes_};
            vkCmdCopyBuffer(commands, staging_.handle.get(), chunks_[slots[i] / pages_per_chunk].handle.get(),
                            1, &copy);
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
}

}  // namespace oro
