#include "render/scene/page_store.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

namespace oro {
namespace {

// Buffers become larger as there are more of them: a small region takes little, a large one few buffers.
constexpr std::size_t pages_in_first_chunk = 32;
constexpr std::size_t pages_in_chunk_max = 128;  // 10 to 64 MB: far below every device's limit on one buffer
constexpr std::size_t fewest_in_chunk = 8;       // what is not there for so many is left to others
constexpr std::size_t pages_in_staging = 16;

}  // namespace

std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts) {
    const std::size_t block = coding.sixteen ? offsetof(gpu::PageBlock, heights) +
                                                   sizeof(std::uint32_t) * ((gpu::page_heights + 1) / 2)
                                             : sizeof(gpu::PageBlock);
    const auto with = [](std::size_t bytes, std::size_t part) { return (bytes + 15) / 16 * 16 + part; };
    const std::size_t placed = parts.places ? with(block, sizeof(gpu::PagePlaces)) : block;
    return parts.means ? with(placed, sizeof(gpu::PageMeans)) : placed;
}

double bytes_a_post(const HeightQuantization& coding) {
    const std::size_t heights = page_bytes(coding) - offsetof(gpu::PageBlock, heights);
    return static_cast<double>(heights) / (gpu::page_quads * gpu::page_quads);
}

Result<PageStore> PageStore::create(const Gpu& gpu, std::size_t capacity, const HeightQuantization& coding,
                                    const PageParts& parts) {
    return create(
        gpu, std::make_shared<PageBudget>(std::max<std::size_t>(1, capacity) * page_bytes(coding, parts)),
        coding, parts);
}

Result<PageStore> PageStore::create(const Gpu& gpu, std::shared_ptr<PageBudget> budget,
                                    const HeightQuantization& coding, const PageParts& parts) {
    PageStore store(gpu);
    store.coding_ = coding;
    store.page_bytes_ = page_bytes(coding, parts);
    if (parts.means) store.means_offset_ = store.page_bytes_ - sizeof(gpu::PageMeans);
    if (parts.places) store.places_offset_ = page_bytes(coding, {false, true}) - sizeof(gpu::PagePlaces);
    store.budget_ = std::move(budget);
    store.capacity_ = std::max<std::size_t>(1, store.budget_->bytes() / store.page_bytes_);
    return store;
}

std::uint64_t PageStore::bytes() const {
    std::uint64_t bytes = 0;
    for (const PageChunk& chunk : chunks_) bytes += chunk.buffer().size;
    return bytes;
}

std::uint64_t PageStore::address(const PageIndex& page) {
    const auto found = slots_of_.find({page.level, page.row, page.column});
    if (found == slots_of_.end()) return 0;
    Slot& slot = slots_[found->second];
    slot.used = frame_;
    if (slot.shown != frame_) slot.shown_before = std::exchange(slot.shown, frame_);
    return chunks_[slot.chunk].buffer().address + slot.place * page_bytes_;
}

void PageStore::note_hidden(const PageIndex& page) {
    const auto found = slots_of_.find({page.level, page.row, page.column});
    if (found == slots_of_.end()) return;
    Slot& slot = slots_[found->second];
    if (slot.shown == frame_) slot.shown = slot.shown_before;
}

bool PageStore::has_room() const {
    return !free_.empty() || (!full_ && budget_->left() >= page_bytes_);
}

std::size_t PageStore::room() const {
    std::size_t room = free_.size() + (full_ ? 0 : budget_->left() / page_bytes_);
    for (const Slot& slot : slots_) room += slot.used != 0 && slot.used < frame_ ? 1 : 0;
    return std::max<std::size_t>(room, held_ == 0 ? 1 : 0);
}

// Slots of a new chunk, the first of them next.
void PageStore::add_slots(std::size_t chunk, std::size_t count) {
    for (std::size_t place = 0; place < count; ++place) slots_.push_back({{}, 0, 0, 0, chunk, place});
    for (std::size_t place = 0; place < count; ++place) free_.push_back(slots_.size() - 1 - place);
    held_ += count;
}

// Room for more pages, where the budget and the device have it. The budget is what the device may be asked
// for; where it has less, the store makes do with fewer pages. The first page is always given room for.
// Errors: the device; there is no room for any.
Result<void> PageStore::add_chunk() {
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const std::size_t left = std::max<std::size_t>(budget_->left() / page_bytes_, held_ == 0 ? 1 : 0);
    if (full_ || left == 0) return {};
    const std::size_t wanted =
        nearly_full_ ? fewest_in_chunk : std::clamp(held_, pages_in_first_chunk, pages_in_chunk_max);
    for (std::size_t count = std::min(wanted, left);; count /= 2) {
        bool no_room = false;
        auto buffer = create_buffer(*gpu_, count * page_bytes_, usage, MemoryKind::device,
                                    "pages " + std::to_string(chunks_.size()), &no_room);
        if (buffer.ok()) {
            chunks_.emplace_back(std::move(buffer).value(), budget_);
            add_slots(chunks_.size() - 1, count);
            return {};
        }
        if (!no_room) return buffer.error();
        nearly_full_ = true;
        if (count > fewest_in_chunk) continue;
        if (held_ == 0) return buffer.error();
        full_ = true;
        capacity_ = held_;
        return {};
    }
}

// A slot that is free, or one that this frame does not use; false when there is none.
Result<bool> PageStore::find_slot(bool for_hidden, std::size_t& slot) {
    if (free_.empty()) ORO_CHECK(add_chunk());
    if (free_.empty()) return reuse_slot(for_hidden, slot);
    slot = free_.back();
    free_.pop_back();
    return true;
}

// Of the slots that this frame does not use, that whose page was not shown for longest, and of these that
// which was not used for longest.
bool PageStore::reuse_slot(bool for_hidden, std::size_t& slot) {
    std::size_t oldest = slots_.size();
    const auto age = [](const Slot& of) { return std::pair(of.shown, of.used); };
    for (std::size_t i = 0; i < slots_.size(); ++i) {
        const Slot& one = slots_[i];
        if (one.used == 0 || one.used >= frame_) continue;
        if (for_hidden && one.shown != 0 && one.shown + shown_lately >= frame_) continue;
        if (oldest == slots_.size() || age(one) < age(slots_[oldest])) oldest = i;
    }
    if (oldest == slots_.size()) return false;
    slot = oldest;
    const auto holds = slots_of_.find(slots_[oldest].page);
    if (holds != slots_of_.end() && holds->second == slot) slots_of_.erase(holds);
    return true;
}

bool PageStore::release_unused() {
    std::vector<char> is_used(chunks_.size(), 0);
    for (const Slot& slot : slots_)
        if (slot.used >= frame_) is_used[slot.chunk] = 1;
    bool released = false;
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
        if (is_used[chunk] != 0) continue;
        chunks_[chunk].let_go();
        released = true;
    }
    if (!released) return false;
    // What is left is numbered anew.
    std::vector<std::size_t> numbers(chunks_.size());
    std::vector<PageChunk> kept;
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk) {
        if (is_used[chunk] == 0) continue;
        numbers[chunk] = kept.size();
        kept.push_back(std::move(chunks_[chunk]));
    }
    std::vector<Slot> slots;
    slots_of_.clear();
    free_.clear();
    for (Slot slot : slots_) {
        if (is_used[slot.chunk] == 0) continue;
        slot.chunk = numbers[slot.chunk];
        if (slot.used == 0)
            free_.push_back(slots.size());
        else
            slots_of_[slot.page] = slots.size();
        slots.push_back(slot);
    }
    chunks_ = std::move(kept);
    slots_ = std::move(slots);
    held_ = slots_.size();
    full_ = nearly_full_ = false;
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

// What sending takes: made when there is something to send, so that a region that nobody looks at takes
// nothing.
Result<void> PageStore::prepare_sending() {
    if (staging_.handle) return {};
    ORO_TRY(commands_, Commands::create(*gpu_, "page upload"));
    ORO_TRY(staging_, create_buffer(*gpu_, std::min(pages_in_staging, capacity_) * page_bytes_,
                                    VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload, "page staging"));
    return {};
}

Result<std::size_t> PageStore::send(std::span<const LoadedPage> pages) {
    if (pages.empty()) return std::size_t{0};
    ORO_CHECK(prepare_sending());
    std::vector<std::size_t> batch;
    Result<std::size_t> sent = send_by_batches(pages, batch);
    if (sent.ok()) return sent;
    // What did not arrive is not here.
    for (const std::size_t slot : batch) {
        slots_of_.erase(slots_[slot].page);
        slots_[slot].used = 0;
        free_.push_back(slot);
    }
    return sent;
}

// `batch`: slots of the pages that are staged and not copied yet.
Result<std::size_t> PageStore::send_by_batches(std::span<const LoadedPage> pages,
                                               std::vector<std::size_t>& batch) {
    std::size_t sent = 0;
    for (const LoadedPage& page : pages) {
        const Key key{page.index.level, page.index.row, page.index.column};
        if (const auto here = slots_of_.find(key); here != slots_of_.end()) {
            slots_[here->second].used = frame_;
            ++sent;
            continue;
        }
        std::size_t slot = 0;
        ORO_TRY(const bool found, find_slot(page.is_hidden, slot));
        if (!found) break;
        slots_[slot].page = key;
        slots_[slot].used = frame_;
        slots_[slot].shown = page.is_hidden ? 0 : frame_;
        slots_[slot].shown_before = 0;
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
            const Slot& slot = slots_[slots[i]];
            const VkBufferCopy copy{i * page_bytes_, slot.place * page_bytes_, page_bytes_};
            vkCmdCopyBuffer(commands, staging_.handle.get(), chunks_[slot.chunk].buffer().handle.get(), 1,
                            &copy);
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
}

}  // namespace oro
