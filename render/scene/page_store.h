// Pages in GPU memory: as many as a budget allows, in a few large buffers, reached by device address.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/frame/height_quantization.h"
#include "core/terrain/page.h"
#include "render/device/resources.h"
#include "render/scene/page_budget.h"
#include "render/scene/page_shelves.h"

namespace oro {

// A page on its way to the GPU.
struct LoadedPage {
    PageIndex index;
    std::unique_ptr<gpu::PageBlock> block;
    std::unique_ptr<gpu::PageMeans> means;    // where the store keeps them
    std::unique_ptr<gpu::PagePlaces> places;  // likewise
    bool is_hidden{};                         // other ground hides it, as far as is known
    std::vector<std::uint32_t> heights{};     // packed, where the store keeps them so
};

// What a store keeps of pages beside their blocks.
struct PageParts {
    bool means{};
    bool places{};
};
// Bytes that a page takes on the GPU. Pages of packed heights take more or less: this is what one of
// mountains takes whose heights are whole metres.
std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts = {});

// The pages of one region that are on the GPU. Of those that the current frame does not use, the one that has
// not been shown for longest makes room for what comes.
class PageStore {
  public:
    // At most `capacity` pages (of page_bytes()), at least 1, and fewer where the device has no room for
    // them; their heights lie there as `coding` says, with their means before them where these are wanted.
    // Buffers are made when they are needed.
    static Result<PageStore> create(const Gpu& gpu, std::size_t capacity,
                                    const HeightQuantization& coding = {}, const PageParts& parts = {});
    // As many as fit into a budget beside what others take of it, and at least 1.
    static Result<PageStore> create(const Gpu& gpu, std::shared_ptr<PageBudget> budget,
                                    const HeightQuantization& coding = {}, const PageParts& parts = {});
    PageStore(PageStore&&) noexcept = default;
    PageStore& operator=(PageStore&&) noexcept = default;
    PageStore(const PageStore&) = delete;
    PageStore& operator=(const PageStore&) = delete;
    ~PageStore() = default;

    // Device address of a page's block, 0 where it is not here. Asking counts as use in the current frame,
    // and as being shown by it.
    std::uint64_t address(const PageIndex& page);
    // What a page that is here takes without means and places, bytes; 0 for one that is not. Asking does not
    // count as use.
    [[nodiscard]] std::uint64_t block_bytes(const PageIndex& page);
    // The current frame uses it, and does not show it: other ground hides it.
    void note_hidden(const PageIndex& page);
    // How far before a page's block its means lie, bytes; 0 where none are kept.
    [[nodiscard]] std::uint64_t means_before() const { return parts_.means ? block_offset_ : 0; }
    // The same of its places.
    [[nodiscard]] std::uint64_t places_before() const { return places_before_; }
    // From here on pages count as used by another frame: those of earlier ones may make room.
    void begin_frame() { shelves_.begin_frame(); }

    // Sends pages, in their order, until one finds no room that the current frame does not use; number of
    // those sent. A hidden one takes no room of a page that was shown in the last `shown_lately` frames.
    // Waits for the GPU. Errors: the device; no room for any page at all.
    Result<std::size_t> send(std::span<const LoadedPage> pages);
    static constexpr std::uint64_t shown_lately = 64;
    // Whether there is room for some more without taking any page's;
    [[nodiscard]] bool has_room() const;
    // ... for how many at least, were all as large as the largest so far, where pages that this frame does
    // not use make room.
    [[nodiscard]] std::size_t room() const;

    // Whether pages differ in size, so that what is free may lie in pieces that are too short for one.
    [[nodiscard]] bool has_pieces() const { return coding_.packed; }
    // No page is here any more; those that come next lie without gaps. No frame is being drawn.
    void forget_pages() { shelves_.free_all(); }

    // Lets go of buffers whose pages the current frame does not use, for others that share the budget: true
    // where there were any. No frame is being drawn.
    bool release_unused();

    [[nodiscard]] std::size_t size() const { return shelves_.pages(); }
    // The most pages (of page_bytes()) that it may hold, with the whole budget to itself.
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint64_t bytes() const;  // of the buffers
    [[nodiscard]] std::uint64_t bytes_sent() const { return sent_bytes_; }
    // In the mean over the pages that were sent, without means and places: of a page; of heights for each of
    // its 128 x 128 posts, bounds of nodes apart.
    [[nodiscard]] double bytes_a_page() const;
    [[nodiscard]] double bytes_a_post() const;
    // What a page keeps besides, means of the ground and places on a net, for each of those posts.
    [[nodiscard]] double means_bytes_a_post() const;
    [[nodiscard]] const HeightQuantization& coding() const { return coding_; }

  private:
    using Key = PageShelves::Key;
    using Slot = PageShelves::Slot;
    explicit PageStore(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> prepare_sending();
    Result<Slot*> find_slot(const LoadedPage& page);
    Result<void> add_chunk(std::size_t least_bytes);
    Result<std::size_t> send_by_batches(std::span<const LoadedPage> pages, std::vector<Slot*>& batch);
    Result<void> copy(std::span<Slot* const> slots);
    void stage(const LoadedPage& page, std::byte* to) const;
    [[nodiscard]] std::size_t height_bytes(const LoadedPage& page) const;
    [[nodiscard]] std::size_t bytes_of(const LoadedPage& page) const;

    const Gpu* gpu_;
    HeightQuantization coding_;
    PageParts parts_;
    std::size_t page_bytes_{};
    std::size_t most_bytes_{};  // of a page so far, at least page_bytes_
    std::size_t places_before_{};
    std::size_t block_offset_{};  // from a page's begin to its block: means, then places
    Commands commands_;
    Buffer staging_;
    std::shared_ptr<PageBudget> budget_;
    std::vector<PageChunk> chunks_;
    PageShelves shelves_;  // one for each chunk
    std::size_t capacity_{};
    bool nearly_full_{false};  // the device had no room for a buffer of the usual size
    bool full_{false};         // ... nor for a small one
    std::uint64_t sent_pages_{};
    std::uint64_t sent_bytes_{};
    std::uint64_t sent_height_bytes_{};
};

}  // namespace oro
