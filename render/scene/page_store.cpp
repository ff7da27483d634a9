#include "render/scene/page_store.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <utility>

#include "core/packed/packed_heights.h"

namespace oro {
namespace {

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

// heights_at: where they lie in a page.
WriteItems write_heights(const std::shared_ptr<const MadePageHeights>& heights, std::size_t heights_at) {
    if (!heights) return {};
    return [heights, heights_at](VkCommandBuffer commands, std::span<const ItemInPart> pages) {
        for (const ItemInPart& page : pages) heights->record(commands, page.source, page.item + heights_at);
    };
}

// Buffers become larger as there are more of them: a small region takes little, a large one few buffers, of 5
// to 64 MB: far below every device's limit on one.
CacheLayout page_cache_layout(std::uint64_t budget, const HeightQuantization& coding, const PageParts& parts,
                              const std::shared_ptr<const MadePageHeights>& heights) {
    constexpr std::size_t pages_in_staging = 16;
    const std::size_t usual = page_bytes(coding, parts);
    const std::size_t largest =
        coding.packed
            ? parts_bytes(parts) + aligned(before_heights + sizeof(std::uint32_t) * packed_words_max)
            : usual;
    const std::size_t staged = std::clamp<std::size_t>(budget / usual, 1, pages_in_staging);
    return {.name = "pages",
            .item_bytes = usual,
            .first_buffer = 32,
            .largest_buffer = 128,
            .smallest_buffer = 8,
            .staging_bytes = staged * largest,
            .write_items = write_heights(heights, parts_bytes(parts) + before_heights)};
}

}  // namespace

std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts) {
    return parts_bytes(parts) + aligned(before_heights + height_bytes(coding));
}

PageStore::PageStore(const Gpu& gpu, std::shared_ptr<MemoryBudget> budget, const HeightQuantization& coding,
                     const PageParts& parts, std::shared_ptr<const MadePageHeights> heights)
    : coding_(coding),
      parts_(parts),
      block_offset_(parts_bytes(parts)),
      places_before_(parts_bytes({false, parts.places})),
      most_bytes_(page_bytes(coding, parts)),
      cache_(gpu, page_cache_layout(budget->bytes(), coding, parts, heights), budget) {}

double PageStore::bytes_a_post() const {
    constexpr double posts = gpu::page_quads * gpu::page_quads;
    if (sent_pages_ == 0) return static_cast<double>(oro::height_bytes(coding_)) / posts;
    return static_cast<double>(sent_height_bytes_) / (static_cast<double>(sent_pages_) * posts);
}

double PageStore::means_bytes_a_post() const {
    return static_cast<double>(block_offset_) / (gpu::page_quads * gpu::page_quads);
}

double PageStore::bytes_a_page() const {
    const double all = sent_pages_ == 0
                           ? static_cast<double>(page_bytes(coding_, parts_))
                           : static_cast<double>(stored_bytes_) / static_cast<double>(sent_pages_);
    return all - static_cast<double>(block_offset_);
}

std::uint64_t PageStore::address(const PageIndex& page) {
    auto& items = cache_.items();
    const auto handle = items.find(page);
    if (handle == items.none) return 0;
    items.use(handle);
    if (const std::uint64_t shown = items.at(handle).rank; shown != items.frame()) {
        items.value(handle).frame = shown;
        items.set_rank(handle, items.frame());
    }
    return cache_.address(handle) + block_offset_;
}

std::uint64_t PageStore::block_bytes(const PageIndex& page) const {
    const auto handle = cache_.items().find(page);
    return handle == cache_.items().none ? 0 : cache_.items().at(handle).bytes - block_offset_;
}

void PageStore::mark_occluded(const PageIndex& page) {
    auto& items = cache_.items();
    const auto handle = items.find(page);
    if (handle != items.none && items.at(handle).rank == items.frame())
        items.set_rank(handle, items.value(handle).frame);
}

std::size_t PageStore::height_bytes(const LoadedPage& page) const {
    return coding_.packed ? page.heights.size() * sizeof(std::uint32_t) : oro::height_bytes(coding_);
}

std::size_t PageStore::bytes_of(const LoadedPage& page) const {
    return block_offset_ + aligned(before_heights + height_bytes(page));
}

// All of it, or what is before heights that the GPU makes.
BufferCache<PageIndex, PageStore::ShownBefore>::SentPart PageStore::sent_of(const LoadedPage& page) const {
    if (!page.source) return {bytes_of(page), 0};
    return {block_offset_ + before_heights, sizeof(gpu::MadePageSource)};
}

// A page as it lies on the GPU: means, places, then the block, whose heights come last.
void PageStore::stage(const LoadedPage& page, std::byte* to) const {
    if (parts_.means) std::memcpy(to, page.means.get(), sizeof(gpu::PageMeans));
    std::byte* const block = to + block_offset_;
    if (parts_.places) std::memcpy(block - places_before_, page.places.get(), sizeof(gpu::PagePlaces));
    std::memcpy(block, page.block.get(), before_heights);
    std::byte* const heights = block + before_heights;
    if (page.source) {
        std::memcpy(to + sent_of(page).source_at(), page.source.get(), sizeof(gpu::MadePageSource));
    } else if (coding_.packed) {
        std::memcpy(heights, page.heights.data(), height_bytes(page));
    } else if (coding_.sixteen) {
        std::array<std::int16_t, gpu::page_heights + 1> codes{};
        for (std::size_t i = 0; i < gpu::page_heights; ++i) codes[i] = coding_.code(page.block->heights[i]);
        std::memcpy(heights, codes.data(), sizeof(codes));
    } else {
        std::memcpy(heights, page.block->heights, sizeof(page.block->heights));
    }
}

Result<std::size_t> PageStore::send(std::span<const LoadedPage> pages, Evictions evictions) {
    const auto spared = [&](const LoadedPage& page) -> std::uint64_t {
        if (evictions == Evictions::none) return decltype(cache_)::evicts_nothing;
        return page.is_hidden && evictions == Evictions::of_unused ? shown_lately : 0;
    };
    auto& items = cache_.items();
    std::size_t sent = 0;
    for (const LoadedPage& page : pages) {
        if (const auto here = items.find(page.index); here != items.none) {
            items.use(here);
        } else {
            const std::size_t bytes = bytes_of(page);
            ORO_TRY(const auto added, cache_.add(page.index, bytes, spared(page), sent_of(page)));
            if (added.bytes == nullptr) break;
            if (!page.is_hidden) items.set_rank(added.handle, items.frame());
            stage(page, added.bytes);
            most_bytes_ = std::max(most_bytes_, bytes);
            ++sent_pages_;
            made_pages_ += page.source ? 1 : 0;
            stored_bytes_ += bytes;
            sent_height_bytes_ += height_bytes(page);
        }
        ++sent;
    }
    ORO_CHECK(cache_.upload());
    return sent;
}

Result<std::vector<PageStore::KeptBlock>> PageStore::read_blocks(const Gpu& gpu) const {
    std::vector<KeptBlock> blocks;
    std::size_t all = 0;
    cache_.items().for_each([&](const auto& slot) {
        blocks.push_back({slot.key, std::vector<std::byte>(slot.bytes - block_offset_)});
        all += slot.bytes;
    });
    if (blocks.empty()) return blocks;
    ORO_TRY(const Buffer read,
            create_buffer(gpu, all, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryKind::readback, "pages to read"));
    ORO_TRY(Commands commands, Commands::create(gpu, "pages to read"));
    ORO_CHECK(commands.run(gpu, [&](VkCommandBuffer recorded) {
        wait_for_earlier(recorded);
        std::size_t at = 0;
        cache_.items().for_each([&](const auto& slot) {
            cache_.record_reading(recorded, slot, read, at);
            at += slot.bytes;
        });
        memory_barrier(recorded, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
                       VK_PIPELINE_STAGE_2_HOST_BIT, VK_ACCESS_2_HOST_READ_BIT);
    }));
    std::size_t at = block_offset_;
    for (KeptBlock& block : blocks) {
        std::memcpy(block.bytes.data(), read.mapped + at, block.bytes.size());
        at += block.bytes.size() + block_offset_;
    }
    return blocks;
}

}  // namespace oro
