// What a device keeps of one grid to choose the pages of frames by itself, and what it said of the last one.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "core/frame/chosen_pages.h"
#include "core/frame/visibility_feedback.h"
#include "render/device/resources.h"
#include "render/scene/page_store.h"

namespace oro {

class DeviceChoice {
  public:
    // Most bytes that the records of a grid may take, and most pages of a frame.
    static constexpr std::uint64_t most_bytes = 64'000'000;
    static constexpr std::uint32_t most_pages = 8192;

    // Of pages that can_choose_on_device(). They outlive it. Errors: the device; a file that cannot be read.
    static Result<DeviceChoice> create(const Gpu& gpu, const RegionPages& pages);

    // What is on the GPU now: the next plan tells the device what of that it does not know.
    void note_pages(const PageStore& store);
    // Fills what a plan needs so that the device chooses its pages: of a view on the ellipsoid, light going
    // straight. What it says of missing and hidden pages is what is known.
    void plan(const FrameView& view, const ModelView& model, double shading_spacing_px,
              std::uint64_t means_before, GridPlan& plan) const;
    // What a frame has told. True where it lacks other pages than the last one.
    bool apply(const MadeChoice& made, const IsHidden& is_hidden);
    // What a frame has told after which the processor has planned another: which pages the device knows of.
    void apply_changes(const MadeChoice& made);
    // What the last frame that told of it, or the last plan, lacks of what is not here; the last `hidden` of
    // them would not show.
    struct Missing {
        std::vector<PageIndex> pages;
        std::size_t hidden{};
    };
    [[nodiscard]] Missing missing() const;
    // What the processor has planned in its place; how many such plans in a row lacked nothing.
    void note_plan(const GridPlan& plan);
    [[nodiscard]] std::uint32_t whole_plans() const { return whole_plans_; }
    // Each page that a frame wanted and had.
    void for_each_here(const MadeChoice& made, const std::function<void(const PageIndex&)>& visit) const;
    // Whether the last frame has told of all its pages.
    [[nodiscard]] bool is_whole() const { return last_.is_whole; }
    // Whether the last frame had room for all its pages, and the next one is likely to.
    [[nodiscard]] bool has_room() const {
        return last_.is_whole && (capacity_ == known_.size() || 2 * last_.pages_wanted < capacity_);
    }
    [[nodiscard]] std::size_t last_page_count() const { return last_.pages_wanted; }
    void forget() { last_ = {}; }

  private:
    explicit DeviceChoice(const RegionPages& pages)
        : pages_(&pages), numbers_(std::make_shared<PageNumbers>(pages)) {}

    const RegionPages* pages_;
    std::shared_ptr<const PageNumbers> numbers_;
    std::uint32_t capacity_{}, whole_plans_{};
    Buffer records_;
    Buffer tables_;  // blocks, ratings, slots
    // Of each page its block's address, and when it was last found: the pages that were found then.
    struct Known {
        std::uint64_t address{};
        std::uint64_t found{};
    };
    std::vector<Known> known_;
    std::vector<std::uint32_t> here_;
    std::uint64_t turn_{}, bytes_sent_{};
    std::size_t size_{};
    // Changes that no frame has told of yet, in their order, and the number of the last one.
    std::vector<gpu::BlockChange> changes_;
    std::uint64_t change_number_{};
    ChosenPages last_;
};

}  // namespace oro
