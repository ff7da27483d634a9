#include "render/scene/page_store.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstring>
#include <utility>

#include "core/packed/packed_heights.h"

namespace oro {
namespace {

// Buffers become larger as there are more of them: a small region takes little, a large one few buffers.
constexpr std::size_t pages_in_first_chunk = 32;
constexpr std::size_t pages_in_chunk_max = 128;  // 5 to 64 MB: far below every device's limit on one buffer
constexpr std::size_t fewest_in_chunk = 8;       // what is not there for so many is left to others
constexpr std::size_t pages_in_staging = 16;

constexpr std::size_t before_heights = offsetof(gpu::PageBlock, heights);
// Of packed heights in the mountains: 1.5 bytes a post.
constexpr std::size_t usual_packed_bytes = gpu::page_quads * gpu::page_quads * 3 / 2;

std::size_t height_bytes(const HeightQuantization& coding) {
    if (coding.packed) return usual_packed_bytes;
    if (coding.sixteen) return sizeof(std::uint32_t) * ((gpu::page_heights + 1) / 2);
    return sizeof(gpu::PageBlock::heights);
}

// Shaders read blocks at addresses of such multiples.
constexpr std::size_t aligned(std::size_t bytes) {
    return (bytes + 15) / 16 * 16;
}

std::size_t parts_bytes(const PageParts& parts) {
    return (parts.means ? aligned(sizeof(gpu::PageMeans)) : 0) +
           (parts.places ? aligned(sizeof(gpu::PagePlaces)) : 0);
}

}  // namespace

std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts) {
    return parts_bytes(parts) + aligned(before_heights + height_bytes(coding));
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
    store.parts_ = parts;
    store.page_bytes_ = store.most_bytes_ = page_bytes(coding, parts);
    store.block_offset_ = parts_bytes(parts);
    if (parts.places) store.places_before_ = parts_bytes({false, true});
    store.budget_ = std::move(budget);
    store.capacity_ = std::max<std::size_t>(1, store.budget_->bytes() / store.page_bytes_);
    return store;
}

std::uint64_t PageStore::bytes() const {
    std::uint64_t bytes = 0;
    for (const PageChunk& chunk : chunks_) bytes += chunk.buffer().size;
    return bytes;
}

double PageStore::bytes_a_post() const {
    constexpr double posts = gpu::page_quads * gpu::page_quads;
    if (sent_pages_ == 0) return static_cast<double>(oro::height_bytes(coding_)) / posts;
    return static_cast<double>(sent_height_bytes_) / (static_cast<double>(sent_pages_) * posts);
}

double PageStore::means_bytes_a_post() const {
    return static_cast<double>(block_offset_) / (gpu::page_quads * gpu::page_quads);
}

double PageStore::bytes_a_page() const {
    const double all = sent_pages_ == 0 ? static_cast<double>(page_bytes_)
                                        : static_cast<double>(sent_bytes_) / static_cast<double>(sent_pages_);
    return all - static_cast<double>(block_offset_);
}

std::uint64_t PageStore::address(const PageIndex& page) {
    Slot* const slot = shelves_.find({page.level, page.row, page.column});
    if (slot == nullptr) return 0;
    const std::uint64_t frame = shelves_.frame();
    slot->used = frame;
    if (slot->shown != frame) slot->shown_before = std::exchange(slot->shown, frame);
    return chunks_[slot->shelf].buffer().address + slot->place + block_offset_;
}

std::uint64_t PageStore::block_bytes(const PageIndex& page) {
    const Slot* const slot = shelves_.find({page.level, page.row, page.column});
    return slot == nullptr ? 0 : slot->bytes - block_offset_;
}

void PageStore::note_hidden(const PageIndex& page) {
    Slot* const slot = shelves_.find({page.level, page.row, page.column});
    if (slot != nullptr && slot->shown == shelves_.frame()) slot->shown = slot->shown_before;
}

bool PageStore::has_room() const {
    return shelves_.has_room(most_bytes_) || (!full_ && budget_->left() >= most_bytes_);
}

std::size_t PageStore::room() const {
    const std::size_t room =
        shelves_.room(most_bytes_) + (full_ ? 0 : static_cast<std::size_t>(budget_->left()) / most_bytes_);
    return std::max<std::size_t>(room, chunks_.empty() ? 1 : 0);
}

// Room for more pages, one of `least_bytes` among them, where the budget and the device have it. The budget
// is what the device may be asked for; where it has less, the store makes do with fewer pages. The first page
// is always given room for. Errors: the device; there is no room for any.
Result<void> PageStore::add_chunk(std::size_t least_bytes) {
    constexpr VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                                         VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                                         VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    const bool is_first = chunks_.empty();
    if (full_ || (!is_first && budget_->left() < least_bytes)) return {};
    const std::size_t held = static_cast<std::size_t>(bytes()) / page_bytes_;
    const std::size_t left =
        std::max<std::size_t>(static_cast<std::size_t>(budget_->left()) / page_bytes_, 1);
    const std::size_t wanted =
        nearly_full_ ? fewest_in_chunk : std::clamp(held, pages_in_first_chunk, pages_in_chunk_max);
    for (std::size_t count = std::min(wanted, left);; count /= 2) {
        bool no_room = false;
        std::size_t size = std::max(count * page_bytes_, least_bytes);
        if (!is_first) size = std::min(size, static_cast<std::size_t>(budget_->left()));
        auto buffer = create_buffer(*gpu_, size, usage, MemoryKind::device,
                                    "pages " + std::to_string(chunks_.size()), &no_room);
        if (buffer.ok()) {
            chunks_.emplace_back(std::move(buffer).value(), budget_);
            shelves_.add(size);
            return {};
        }
        if (!no_room) return buffer.error();
        nearly_full_ = true;
        if (count > fewest_in_chunk) continue;
        if (is_first) return buffer.error();
        full_ = true;
        capacity_ = held;
        return {};
    }
}

// Where a page may lie: what is free, or what this frame does not use; null when there is none.
Result<PageStore::Slot*> PageStore::find_slot(const LoadedPage& page) {
    const Key key{page.index.level, page.index.row, page.index.column};
    const std::size_t bytes = bytes_of(page);
    Slot* slot = shelves_.take(key, bytes);
    if (slot == nullptr) {
        ORO_CHECK(add_chunk(bytes));
        slot = shelves_.take(key, bytes);
    }
    return slot != nullptr ? slot : shelves_.take_used(key, bytes, page.is_hidden ? shown_lately : 0);
}

bool PageStore::release_unused() {
    const std::vector<bool> stayed = shelves_.release_unused();
    if (std::ranges::find(stayed, false) == stayed.end()) return false;
    std::vector<PageChunk> kept;
    for (std::size_t chunk = 0; chunk < chunks_.size(); ++chunk)
        if (stayed[chunk]) kept.push_back(std::move(chunks_[chunk]));
    chunks_ = std::move(kept);  // the others give back what they took
    full_ = nearly_full_ = false;
    return true;
}

std::size_t PageStore::height_bytes(const LoadedPage& page) const {
    return coding_.packed ? page.heights.size() * sizeof(std::uint32_t) : oro::height_bytes(coding_);
}

std::size_t PageStore::bytes_of(const LoadedPage& page) const {
    return block_offset_ + aligned(before_heights + height_bytes(page));
}

// A page as it lies on the GPU: means, places, then the block, whose heights come last.
void PageStore::stage(const LoadedPage& page, std::byte* to) const {
    if (parts_.means) std::memcpy(to, page.means.get(), sizeof(gpu::PageMeans));
    std::byte* const block = to + block_offset_;
    if (parts_.places) std::memcpy(block - places_before_, page.places.get(), sizeof(gpu::PagePlaces));
    std::memcpy(block, page.block.get(), before_heights);
    std::byte* const heights = block + before_heights;
    if (coding_.packed) {
        std::memcpy(heights, page.heights.data(), height_bytes(page));
    } else if (coding_.sixteen) {
        std::array<std::int16_t, gpu::page_heights + 1> codes{};
        for (std::size_t i = 0; i < gpu::page_heights; ++i) codes[i] = coding_.code(page.block->heights[i]);
        std::memcpy(heights, codes.data(), sizeof(codes));
    } else {
        std::memcpy(heights, page.block->heights, sizeof(page.block->heights));
    }
}

// What sending takes: made when there is something to send, so that a region that nobody looks at takes
// nothing.
Result<void> PageStore::prepare_sending() {
    if (staging_.handle) return {};
    const std::size_t largest =
        coding_.packed ? block_offset_ + aligned(before_heights + sizeof(std::uint32_t) * packed_words_max)
                       : page_bytes_;
    ORO_TRY(commands_, Commands::create(*gpu_, "page upload"));
    ORO_TRY(staging_, create_buffer(*gpu_, std::min(pages_in_staging, capacity_) * largest,
                                    VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryKind::upload, "page staging"));
    return {};
}

Result<std::size_t> PageStore::send(std::span<const LoadedPage> pages) {
    if (pages.empty()) return std::size_t{0};
    ORO_CHECK(prepare_sending());
    std::vector<Slot*> batch;
    Result<std::size_t> sent = send_by_batches(pages, batch);
    if (sent.ok()) return sent;
    // What did not arrive is not here.
    std::vector<Key> lost;
    for (const Slot* const slot : batch) lost.push_back(slot->page);
    for (const Key& page : lost) shelves_.free(page);
    return sent;
}

// `batch`: where pages lie that are staged and not copied yet.
Result<std::size_t> PageStore::send_by_batches(std::span<const LoadedPage> pages, std::vector<Slot*>& batch) {
    std::size_t sent = 0, staged = 0;
    for (const LoadedPage& page : pages) {
        if (Slot* const here = shelves_.find({page.index.level, page.index.row, page.index.column})) {
            here->used = shelves_.frame();
            ++sent;
            continue;
        }
        ORO_TRY(Slot* const slot, find_slot(page));
        if (slot == nullptr) break;
        slot->shown = page.is_hidden ? 0 : shelves_.frame();
        stage(page, staging_.mapped + staged);
        staged += slot->bytes;
        batch.push_back(slot);
        most_bytes_ = std::max(most_bytes_, slot->bytes);
        ++sent_pages_;
        sent_bytes_ += slot->bytes;
        sent_height_bytes_ += height_bytes(page);
        ++sent;
        if (batch.size() == std::min(pages_in_staging, capacity_)) {
            ORO_CHECK(copy(batch));
            batch.clear();
            staged = 0;
        }
    }
    ORO_CHECK(copy(batch));
    return sent;
}

Result<void> PageStore::copy(std::span<Slot* const> slots) {
    if (slots.empty()) return {};
    return commands_.run(*gpu_, [&](VkCommandBuffer commands) {
        std::size_t staged = 0;
        for (const Slot* const slot : slots) {
            const VkBufferCopy copy{staged, slot->place, slot->bytes};
            vkCmdCopyBuffer(commands, staging_.handle.get(), chunks_[slot->shelf].buffer().handle.get(), 1,
                            &copy);
            staged += slot->bytes;
        }
        memory_barrier(commands, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_SHADER_STORAGE_READ_BIT);
    });
}

}  // namespace oro
