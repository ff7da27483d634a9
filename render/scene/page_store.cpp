#include "render/scene/page_store.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace oro {
namespace {

constexpr std::size_t pages_per_chunk = 128;  // 10 MB: far below every device's limit on one buffer
constexpr std::size_t fewest_in_chunk = 8;    // what is not there for so many is left to others
constexpr std::size_t pages_in_staging = 64;

}  // namespace

std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts) {
    const std::size_t block = coding.sixteen ? offsetof(gpu::PageBlock, heights) +
                                                   sizeof(std::uint32_t) * ((gpu::page_heights + 1) / 2)
                                             : sizeof(gpu::PageBlock);
    const auto with = [](std::size_t bytes, std::size_t part) { return (bytes + 15) / 16 * 16 + part; };
    const std::size_t placed = parts.places ? with(block, sizeof(gpu::PagePlaces)) : block;
    return parts.means ? with(placed, sizeof(gpu::PageMeans)) : placed;
}

Result<PageStore> PageStore::create(const Gpu& gpu, std::size_t capacity, const HeightQuantization& coding,
                                    const PageParts& parts) {
    PageStore store(gpu);
    store.coding_ = coding;
    store.page_bytes_ = page_bytes(coding, parts);
    if (parts.means) store.means_offset_ = store.page_bytes_ - sizeof(gpu::PageMeans);
    if (parts.places) store.places_offset_ = page_bytes(coding, {false, true}) - sizeof(gpu::PagePlaces);
    store.capacity_ = std::max<std::size_t>(1, capacity);
    ORO_TRY(store.commands_, Commands::create(gpu, "page upload"));
    ORO_TRY(store.staging_,
            create_buffer(gpu, pages_in_staging * store.page_bytes_, VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                          MemoryKind::upload, "page staging"));
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

// Room for pages from slot `first` on. The budget is what the device may be asked for; where it has less, the
// store makes do with fewer pages. Errors: there is no room for any.
Result<void> PageStore::add_chunk(std::size_t first) {
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    for (std::size_t count = std::min(pages_per_chunk, capacity_ - first);; count /= 2) {
        bool full = false;
        auto chunk = create_buffer(*gpu_, count * page_bytes_, usage, MemoryKind::device,
                                   "pages " + std::to_string(chunks_.size()), &full);
        if (chunk.ok()) {
            capacity_ = std::min(capacity_, full_ ? first + count : capacity_);
            chunks_.push_back(std::move(chunk).value());
            return {};
        }
        if (!full) return chunk.error();
        full_ = true;
        if (count > fewest_in_chunk) continue;
        if (first == 0) return chunk.error();
        capacity_ = first;
        return {};
    }
}

// A slot that is free, or was not used for longest and not by this frame; false when there is none.
Result<bool> PageStore::find_slot(std::size_t& slot) {
    if (slots_.size() < capacity_) {
        slot = slots_.size();
        if (slot / pages_per_chunk == chunks_.size()) {
            ORO_CHECK(add_chunk(slot));
            if (slot >= capacity_) return reuse_slot(slot);
        }
        slots_.push_back({{}, frame_});
        return true;
    }
    return reuse_slot(slot);
}

// The slot that was not used for longest; false when this frame uses all.
bool PageStore::reuse_slot(std::size_t& slot) {
    const auto oldest = std::min_element(slots_.begin(), slots_.end(),
                                         [](const Slot& a, const Slot& b) { return a.used < b.used; });
    if (oldest->used >= frame_) return false;
    slot = static_cast<std::size_t>(oldest - slots_.begin());
    const auto holds = slots_of_.find(oldest->page);
    if (holds != slots_of_.end() && holds->second == slot) slots_of_.erase(holds);
    return true;
}

// A page as it lies on the GPU.
void PageStore::stage(const LoadedPage& page, std::byte* to) const {
    const gpu::PageBlock& block = *page.block;
    if (means_offset_ > 0) std::memcpy(to + means_offset_, page.means.get(), sizeof(gpu::PageMeans));
    if (places_offset_ > 0) std::memcpy(to + places_offset_, page.places.get(), sizeof(gpu::PagePlaces));
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
    std::vector<std::size_t> batch;
    Result<std::size_t> sent = send_by_batches(pages, batch);
    if (sent.ok()) return sent;
    // What did not arrive is not here.
    for (const std::size_t slot : batch) slots_of_.erase(slots_[slot].page);
    return sent;
}

// `batch`: slots of the pages that are staged and not copied yet.
Result<std::size_t> PageStore::send_by_batches(std::span<const LoadedPage> pages,
                                               std::vector<std::size_t>& batch) {
    std::size_t sent = 0;
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
        stage(page, staging_.mapped + batch.size() * page_bytes_);
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
