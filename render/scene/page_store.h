// Pages in GPU memory: as many slots as a budget allows, in a few large buffers, reached by device address.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <vector>

#include "core/terrain/height_quantization.h"
#include "core/terrain/page.h"
#include "render/device/resources.h"
#include "render/scene/page_budget.h"

namespace oro {

// A page on its way to the GPU.
struct LoadedPage {
    PageIndex index;
    std::unique_ptr<gpu::PageBlock> block;
    std::unique_ptr<gpu::PageMeans> means;    // where the store keeps them
    std::unique_ptr<gpu::PagePlaces> places;  // likewise
    bool is_hidden{};                         // other ground hides it, as far as is known
};

// What a store keeps of pages beside their blocks.
struct PageParts {
    bool means{};
    bool places{};
};
// Bytes that a page takes on the GPU.
std::size_t page_bytes(const HeightQuantization& coding, const PageParts& parts = {});
// Of these those of heights, for each of a page's 128 x 128 posts.
double bytes_a_post(const HeightQuantization& coding);

// The pages of one region that are on the GPU. Of those that the current frame does not use, the one that has
// not been shown for longest makes room for what comes.
class PageStore {
  public:
    // At most `capacity` pages, at least 1, and fewer where the device has no room for them; their heights
    // lie there as `coding` says, with their means behind them where these are wanted. Buffers are made when
    // they are needed.
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
    // The current frame uses it, and does not show it: other ground hides it.
    void note_hidden(const PageIndex& page);
    // From a page's block to its means, bytes; 0 where none are kept.
    [[nodiscard]] std::uint64_t means_offset() const { return means_offset_; }
    // The same to its places.
    [[nodiscard]] std::uint64_t places_offset() const { return places_offset_; }
    // From here on pages count as used by another frame: those of earlier ones may make room.
    void begin_frame() { ++frame_; }

    // Sends pages, in their order, until no slot is left that the current frame does not use; number of those
    // sent. A hidden one takes no slot of a page that was shown in the last `shown_lately` frames. Waits for
    // the GPU. Errors: the device; no room for any page at all.
    Result<std::size_t> send(std::span<const LoadedPage> pages);
    static constexpr std::uint64_t shown_lately = 64;
    // Whether there is room for some more without taking any page's slot;
    [[nodiscard]] bool has_room() const;
    // ... for how many, where pages that this frame does not use make room.
    [[nodiscard]] std::size_t room() const;

    // Lets go of buffers whose pages the current frame does not use, for others that share the budget: true
    // where there were any. No frame is being drawn.
    bool release_unused();

    [[nodiscard]] std::size_t size() const { return slots_of_.size(); }
    // The most pages that it may hold, with the whole budget to itself.
    [[nodiscard]] std::size_t capacity() const { return capacity_; }
    [[nodiscard]] std::uint64_t bytes() const;  // of the buffers
    [[nodiscard]] const HeightQuantization& coding() const { return coding_; }

  private:
    using Key = std::tuple<int, int, int>;  // level, row, column
    struct Slot {
        Key page;
        std::uint64_t used{};   // frame; 0: no page is there
        std::uint64_t shown{};  // the last frame that showed it, and the last before this one
        std::uint64_t shown_before{};
        std::size_t chunk{};
        std::size_t place{};  // in the chunk
    };
    explicit PageStore(const Gpu& gpu) : gpu_(&gpu) {}
    Result<void> prepare_sending();
    Result<bool> find_slot(bool for_hidden, std::size_t& slot);
    bool reuse_slot(bool for_hidden, std::size_t& slot);
    Result<void> add_chunk();
    void add_slots(std::size_t chunk, std::size_t count);
    Result<std::size_t> send_by_batches(std::span<const LoadedPage> pages, std::vector<std::size_t>& batch);
    Result<void> copy(std::span<const std::size_t> slots);
    void stage(const LoadedPage& page, std::byte* to) const;

    const Gpu* gpu_;
    HeightQuantization coding_;
    std::size_t page_bytes_{sizeof(gpu::PageBlock)};
    std::size_t means_offset_{};
    std::size_t places_offset_{};
    Commands commands_;
    Buffer staging_;
    std::shared_ptr<PageBudget> budget_;
    std::vector<PageChunk> chunks_;
    std::size_t capacity_{};
    bool nearly_full_{false};        // the device had no room for a buffer of the usual size
    bool full_{false};               // ... nor for a small one
    std::size_t held_{};             // slots of all chunks that are there
    std::vector<Slot> slots_;        // of all chunks that ever were
    std::vector<std::size_t> free_;  // of them those without a page; the last is the next
    std::map<Key, std::size_t> slots_of_;
    std::uint64_t frame_{1};
};

}  // namespace oro
