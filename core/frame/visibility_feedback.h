// Which of a region's ground frames have shown, and which they were asked for and have not: other ground hid
// it. It decides what is brought first and what gives way, nothing of what a picture shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/frame/region_pages.h"
#include "core/terrain/page_table.h"
#include "shaders/plan/shared_choice.h"
#include "shaders/shared.h"

namespace oro {

// What a frame tells of a choice of pages that the device has made (DevicePlan::chooses).
struct MadeChoice {
    gpu::ChoiceCounts counts{};
    std::vector<gpu::WantedPage> wanted;  // DevicePlan::pages_read of them, or fewer
    std::uint64_t change_number{};        // DevicePlan::change_number: the device knows of those changes
};

// What a frame tells of the nodes of its pages: gpu::feedback_words for each of them, see
// gpu::FrameConstants::feedback. Without pages it tells nothing; of clusters, a word of gpu::cluster_...
// each.
struct FrameFeedback {
    std::vector<PageIndex> pages;
    std::vector<gpu::DrawnCluster> clusters;
    std::vector<gpu::uint> words;
    gpu::FrameConstants view{};  // by which the frame was drawn
    std::optional<MadeChoice> choice;
};

// Whether two frames look from one place to the same part of a picture; their samples may differ.
bool is_same_view(const gpu::FrameConstants& one, const gpu::FrameConstants& other);

// Pages. Emptied in no time, and it keeps its room.
class PageSet {
  public:
    void clear();
    // Whether it was not there.
    bool insert(const PageIndex& page) { return number_of(page).second; }
    [[nodiscard]] bool contains(const PageIndex& page) const { return find(page) != PageTable::none; }
    // Pages are numbered from 0 in the order in which they came in.
    [[nodiscard]] std::size_t size() const { return pages_.size(); }
    [[nodiscard]] const PageIndex& operator[](std::size_t number) const { return pages_[number]; }
    // PageTable::none where it is not there.
    [[nodiscard]] std::uint32_t find(const PageIndex& page) const;
    // Its number, and whether it came in just now.
    std::pair<std::uint32_t, bool> number_of(const PageIndex& page);

  private:
    std::vector<PageTable> levels_;
    std::vector<PageIndex> pages_;
};

// What the last frame has shown, and which pages were drawn and hidden while what shows was the same.
class VisibilityFeedback {
  public:
    // `pages` outlive it.
    explicit VisibilityFeedback(const RegionPages& pages) : pages_(&pages) {}
    // True where these tell something else than those before.
    bool add(const FrameFeedback& feedback);
    // None of the page shows, nor would, and nothing that stands for it does: so what shows is drawn the same
    // with the page as without. A page that was hidden, and in whose place something coarser then showed, is
    // taken to show from then on, for some views: so it does not come and go.
    [[nodiscard]] bool is_hidden(const PageIndex& page);
    // Views after which that is forgotten.
    static constexpr int views_kept = 32;

  private:
    using Bits =
        std::array<std::uint16_t, gpu::meshlets_per_side>;  // a row of nodes each, the first the lowest bit
    // Pages with bits, and with these all above them.
    struct Nodes {
        PageSet pages;
        std::vector<Bits> bits;  // of each
        PageSet below;
        void clear();
        // Null where it has none.
        [[nodiscard]] const Bits* bits_of(const PageIndex& page) const;
        [[nodiscard]] bool is_same(const Nodes& other) const;
    };
    void mark(Nodes& nodes, const PageIndex& page, const Bits& bits) const;
    void mark_grown(Nodes& nodes, const PageIndex& page, const Bits& bits) const;
    // Whether there are any over a page: its own, finer ones, or coarser ones that lie over it.
    [[nodiscard]] bool any_over(const Nodes& nodes, const PageIndex& page) const;

    const RegionPages* pages_;
    // Of the last frame; the last two with those around them.
    struct Seen {
        Nodes asked, shown, finer;
        // Of each of shown.pages, pages with nodes that show, or beside such nodes, whether the frame has
        // drawn it. While these stay as they are the same ground hides the same.
        std::vector<char> drawn;
        [[nodiscard]] bool is_drawn_same(const Seen& other) const;
    };
    void find_seen(const FrameFeedback& feedback);
    Seen seen_, before_;  // the latter of the frame before
    // Pages that what shows was seen to hide, that did so in the last views, and that came back.
    PageSet hidden_, were_hidden_, came_back_;
    int views_{};
    gpu::FrameConstants last_{};
};

}  // namespace oro
