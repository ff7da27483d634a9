// Which of a region's ground frames have shown, and which they were asked for and have not: other ground hid
// it. It decides what is brought first and what gives way, nothing of what a picture shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "core/frame/region_pages.h"
#include "shaders/shared.h"

namespace oro {

// What a frame tells of the nodes of its pages: gpu::feedback_words for each of them, see
// gpu::FrameConstants::feedback. Without pages it tells nothing; of clusters, a word of gpu::cluster_...
// each.
struct FrameFeedback {
    std::vector<PageIndex> pages;
    std::vector<gpu::DrawnCluster> clusters;
    std::vector<gpu::uint> words;
    gpu::FrameConstants view{};  // by which the frame was drawn
};

// Whether two frames look from one place to the same part of a picture; their samples may differ.
bool is_same_view(const gpu::FrameConstants& one, const gpu::FrameConstants& other);

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
    using Key = std::tuple<int, int, int>;  // level, row, column
    using Bits =
        std::array<std::uint16_t, gpu::meshlets_per_side>;  // a row of nodes each, the first the lowest bit
    using PageBits = std::map<Key, Bits>;
    // Bits of pages, and the pages with any of them, with all above these.
    struct Nodes {
        PageBits bits;
        std::set<Key> below;
    };
    void mark(Nodes& nodes, const PageIndex& page, const Bits& bits) const;
    void mark_grown(Nodes& nodes, const PageIndex& page, const Bits& bits) const;
    // Whether there are any over a page: its own, finer ones, or coarser ones that lie over it.
    [[nodiscard]] bool any_over(const Nodes& nodes, const PageIndex& page) const;

    const RegionPages* pages_;
    Nodes asked_, shown_, finer_;  // the last two with those around them
    // Pages with nodes that show, or beside such nodes; 1 where the frame has drawn them. While these stay as
    // they are the same ground hides the same, and hidden_ are pages that it was seen to hide.
    std::map<Key, bool> drawn_;
    std::set<Key> hidden_, were_hidden_, came_back_;
    int views_{};
    gpu::FrameConstants last_{};
};

}  // namespace oro
