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

// Buffers become larger as there are more of them: a small region takes little, a large one few buffers, of 5
// to 64 MB: far below every device's limit on one.
CacheLayout page_cache_layout(std::uint64_t budget, const HeightQuantization& coding,
                              const PageParts& parts) {
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
            .staging_bytes = staged * largest};
}

}  // namespace

std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts) {
    return parts_bytes(parts) + aligned(before_heights + height_bytes(coding));
}

PageStore::PageStore(const Gpu& gpu, std::shared_ptr<MemoryBudget> budget, const HeightQuantization& coding,
                     const PageParts& parts)
    : coding_(coding),
      parts_(parts),
      block_offset_(parts_bytes(parts)),
      places_before_(parts_bytes({false, parts.places})),
      most_bytes_(page_bytes(coding, parts)),
      cache_(gpu, page_cache_layout(budget->bytes(), coding, parts), budget) {}

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
                           : static_cast<double>(bytes_sent()) / static_cast<double>(sent_pages_);
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

Result<std::size_t> PageStore::send(std::span<const LoadedPage> pages, Evictions evictions) {
    const auto spared = [&](const LoadedPage& page) -> std::uint64_t {
        if (evictions == Evictions::none) return decltype(cache_)::evicts_nothing;
        return page.is_hidden ? shown_lately : 0;
    };
    auto& items = cache_.items();
    std::size_t sent = 0;
    for (const LoadedPage& page : pages) {
        if (const auto here = items.find(page.index); here != items.none) {
            items.use(here);
        } else {
            const std::size_t bytes = bytes_of(page);
            ORO_TRY(const auto added, cache_.add(page.index, bytes, spared(page)));
            if (added.bytes == nullptr) break;
            if (!page.is_hidden) items.set_rank(added.handle, items.frame());
            stage(page, added.bytes);
            most_bytes_ = std::max(most_bytes_, bytes);
            ++sent_pages_;
            sent_height_bytes_ += height_bytes(page);
        }
        ++sent;
    }
    ORO_CHECK(cache_.upload());
    return sent;
}

}  // namespace oro
