// Pages in GPU memory: as many as a budget allows, in a few large buffers, reached by device address.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/cache/loader.h"
#include "core/frame/height_quantization.h"
#include "core/frame/region_pages.h"
#include "core/made_pages/page_source.h"
#include "core/terrain/page.h"
#include "render/device/buffer_cache.h"
#include "render/made/page_heights.h"

template <>
struct std::hash<oro::PageIndex> {
    std::size_t operator()(const oro::PageIndex& page) const noexcept {
        const std::uint64_t place = std::uint64_t{static_cast<std::uint32_t>(page.row)} << 32U |
                                    static_cast<std::uint32_t>(page.column);
        const std::uint64_t mixed =
            (place + static_cast<std::uint64_t>(page.level) * 0x100000001b3ULL) * 0x9e3779b97f4a7c15ULL;
        return static_cast<std::size_t>(mixed ^ mixed >> 32U);
    }
};

namespace oro {

// A page on its way to the GPU.
struct LoadedPage {
    PageIndex index;
    std::unique_ptr<gpu::PageBlock> block;
    std::unique_ptr<gpu::PageMeans> means;    // where the store keeps them
    std::unique_ptr<gpu::PagePlaces> places;  // likewise
    bool is_hidden{};                         // other ground hides it, as far as is known
    std::vector<std::uint32_t> heights{};     // packed, where the store keeps them so; words of meshes
    // Where the GPU makes the block's heights: what from; the block has none then.
    std::unique_ptr<gpu::MadePageSource> source{};
};

// What a store keeps of pages beside their blocks.
struct PageParts {
    bool means{};
    bool places{};
};
// Bytes that a page takes on the GPU. Pages of packed heights take more or less: this is what one of
// mountains takes whose heights are whole metres.
std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts = {});

// The cache of one region's pages on the GPU. Of those that no frame uses, the one that has not been shown
// for longest is evicted first.
class PageStore {
  public:
    // As many pages as fit into a budget beside what others take of it, and at least 1; fewer where the
    // device has too little memory. Their heights lie there as `coding` says, with `parts` before them.
    // heights: makes those of pages that come with a source; null: none do.
    PageStore(const Gpu& gpu, std::shared_ptr<MemoryBudget> budget, const HeightQuantization& coding = {},
              const PageParts& parts = {}, std::shared_ptr<const MadePageHeights> heights = nullptr);

    // Device address of a page's block, 0 where it is not here. Asking counts as use in the current frame,
    // and as being shown by it.
    std::uint64_t address(const PageIndex& page);
    // Whether a page is here. Asking does not count as use.
    [[nodiscard]] bool has(const PageIndex& page) const {
        return cache_.items().find(page) != decltype(cache_)::Items::none;
    }
    // What a page that is here takes without means and places, bytes; 0 for one that is not. Asking does not
    // count as use.
    [[nodiscard]] std::uint64_t block_bytes(const PageIndex& page) const;
    // The current frame uses it, and does not show it: other ground hides it.
    void mark_occluded(const PageIndex& page);
    // How far before a page's block its means lie, bytes; 0 where none are kept.
    [[nodiscard]] std::uint64_t means_offset() const { return parts_.means ? block_offset_ : 0; }
    // How far before a page's block its places lie, bytes; 0 where none are kept.
    [[nodiscard]] std::uint64_t places_before() const { return places_before_; }
    // From here on pages are used by the next frame. What is sent lands after all frames before.
    void begin_frame() { cache_.items().begin_frame(); }
    [[nodiscard]] std::uint64_t frame() const { return cache_.items().frame(); }

    // Uploads pages, in their order, until one finds no capacity that the current frame does not use; number
    // of those uploaded. A hidden one evicts no page that was shown in the last `shown_lately` frames, unless
    // all that the current frame does not use may be evicted. evictions: none: it ends where a page finds no
    // memory that is free. Errors: the device; it has no memory for any page at all.
    enum class Evictions { none, of_unused, of_all_unused };
    Result<std::size_t> send(std::span<const LoadedPage> pages, Evictions evictions = Evictions::of_unused);
    static constexpr std::uint64_t shown_lately = 64;
    // Whether some more find capacity without an eviction;
    [[nodiscard]] bool has_capacity() const { return cache_.has_free(most_bytes_); }
    // ... how many do at least, were all as large as the largest so far, where pages that this frame does not
    // use are evicted.
    [[nodiscard]] std::size_t free_capacity() const { return cache_.fitting(most_bytes_); }

    // Whether pages differ in size, so that what is free may lie in pieces that are too short for one.
    [[nodiscard]] bool has_pieces() const { return coding_.packed; }
    // No page is here any more; those that come next lie without gaps. No frame is being drawn.
    void clear() { cache_.items().clear(); }
    // Destroys buffers whose pages the current frame does not use, for others that share the budget: true
    // where there were any. No frame is being drawn.
    bool release_unused() { return cache_.release_unused(); }

    // Bytes of a page's block as they lie on the GPU.
    struct KeptBlock {
        PageIndex index;
        std::vector<std::byte> bytes;
    };
    // Of all pages that are here, in no order; waits for the device. For measuring. Errors: the device.
    Result<std::vector<KeptBlock>> read_blocks(const Gpu& gpu) const;
    // Of each page that is here its block's address. Asking does not count as use.
    template <class Visit>
    void for_each(const Visit& visit) const {
        cache_.items().for_each(
            [&](const auto& slot) { visit(slot.key, cache_.address(slot) + block_offset_); });
    }

    [[nodiscard]] std::size_t size() const { return cache_.items().size(); }
    // The most pages (of page_bytes()) that it may hold, with the whole budget to itself.
    [[nodiscard]] std::size_t capacity() const { return cache_.capacity(); }
    [[nodiscard]] std::uint64_t bytes() const { return cache_.bytes(); }  // of the buffers
    [[nodiscard]] std::uint64_t bytes_sent() const { return cache_.bytes_uploaded(); }
    // Pages that were sent, and those of them whose heights the GPU made.
    [[nodiscard]] std::uint64_t pages_sent() const { return sent_pages_; }
    [[nodiscard]] std::uint64_t pages_made() const { return made_pages_; }
    // In the mean over the pages that were sent, without means and places: bytes of a page;
    [[nodiscard]] double bytes_a_page() const;
    // ... of heights for each of its 128 x 128 posts, bounds of nodes apart.
    [[nodiscard]] double bytes_a_post() const;
    // What a page keeps besides, means of the ground and places on a net, for each of those posts.
    [[nodiscard]] double means_bytes_a_post() const;
    [[nodiscard]] const HeightQuantization& coding() const { return coding_; }

  private:
    // A page's rank is the frame that showed it last.
    struct ShownBefore {
        std::uint64_t frame{};  // the last one before that
    };
    void stage(const LoadedPage& page, std::byte* to) const;
    [[nodiscard]] std::size_t height_bytes(const LoadedPage& page) const;
    [[nodiscard]] std::size_t bytes_of(const LoadedPage& page) const;
    [[nodiscard]] BufferCache<PageIndex, ShownBefore>::SentPart sent_of(const LoadedPage& page) const;

    HeightQuantization coding_;
    PageParts parts_;
    std::size_t block_offset_;   // from a page's begin to its block: means, then places
    std::size_t places_before_;  // from its places to its block
    std::size_t most_bytes_;     // of a page so far, at least page_bytes()
    BufferCache<PageIndex, ShownBefore> cache_;
    std::uint64_t sent_pages_{}, made_pages_{};
    std::uint64_t stored_bytes_{};  // of all pages that were sent
    std::uint64_t sent_height_bytes_{};
};

using PageLoader = Loader<PageIndex, LoadedPage>;

// `capacity`: pages that may be under way or ready at a time, at least 1; 80 KB each. `pages` outlives the
// loader. parts: pages come with these, too; means are 222 KB more, places 200 KB. packs: they come with
// packed heights. with_sources: they come with what the GPU makes their heights from, and without these;
// the pages have a made_ground(). Errors of take(): a page that could not be read.
std::unique_ptr<PageLoader> page_loader(const RegionPages& pages, int threads, std::size_t capacity,
                                        const PageParts& parts = {}, bool packs = false,
                                        bool with_sources = false);

}  // namespace oro
