// What frames have shown of a region's pages: a page is hidden where it was asked for and neither it nor what
// lies beside a node of it has shown; what one view has shown stays shown while the view stays.
#include "core/frame/visibility_feedback.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>

namespace oro {
namespace {

// 16 x 16 pages of level 0, and four levels above them.
class EvenPages : public RegionPages {
  public:
    EvenPages()
        : RegionPages({{{1200.0, 47 * 1200, 0, -1, 2049}, {1200.0, 8 * 1200, 0, 1, 2049}}, {}, {}, 1}) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex&) const override { return PageRecord{}; }
    Result<void> load(const PageIndex&, gpu::PageBlock&) const override { return {}; }
};

void set(FrameFeedback& feedback, std::size_t page, int row, int column, bool shown) {
    const auto node =
        static_cast<std::size_t>(row) * gpu::meshlets_per_side + static_cast<std::size_t>(column);
    gpu::uint* const words = &feedback.words[page * gpu::feedback_words];
    words[node / 32] |= 1U << (node % 32);
    if (shown) words[gpu::accepted_words + node / 32] |= 1U << (node % 32);
}

// One page of which all nodes were asked for.
FrameFeedback asked(const PageIndex& page, float eye_x = 0.0F) {
    FrameFeedback feedback;
    feedback.pages = {page};
    feedback.words.resize(gpu::feedback_words);
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column) set(feedback, 0, row, column, false);
    feedback.view.eye_high.x = eye_x;
    return feedback;
}

TEST(VisibilityFeedback, WhatNobodyAskedForMayShow) {
    const EvenPages pages;
    VisibilityFeedback seen(pages);
    EXPECT_EQ(pages.levels(), 5);
    EXPECT_FALSE(seen.is_hidden({3, 3, 0}));
}

TEST(VisibilityFeedback, APageIsHiddenWithAllThatLiesInIt) {
    const EvenPages pages;
    VisibilityFeedback seen(pages);
    EXPECT_TRUE(seen.add(asked({1, 1, 2})));
    EXPECT_FALSE(seen.add(asked({1, 1, 2}))) << "it is no news";
    EXPECT_TRUE(seen.is_hidden({1, 1, 2}));
    EXPECT_TRUE(seen.is_hidden({0, 0, 3})) << "nothing in it has shown";
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column)
            EXPECT_EQ(seen.is_hidden({row, column, 0}), row / 4 == 1 && column / 4 == 1)
                << row << ", " << column;
}

// A node that shows needs its neighbours, which decide how its edges are drawn: in its page and beside it.
TEST(VisibilityFeedback, ANodeShowsWithThoseAroundIt) {
    const EvenPages pages;
    for (const auto& [row, column] :
         {std::pair{0, 0}, {0, 7}, {0, 15}, {8, 15}, {15, 15}, {15, 3}, {9, 0}, {6, 9}}) {
        VisibilityFeedback seen(pages);
        FrameFeedback feedback;
        for (int r = 4; r < 7; ++r)
            for (int c = 4; c < 7; ++c) {
                const FrameFeedback one = asked({r, c, 1});
                feedback.pages.push_back(one.pages.front());
                feedback.words.insert(feedback.words.end(), one.words.begin(), one.words.end());
            }
        set(feedback, 4, row, column, true);
        EXPECT_TRUE(seen.add(feedback));
        for (int r = 4; r < 7; ++r)
            for (int c = 4; c < 7; ++c) {
                const bool adjacent = r * 16 <= 80 + row + 1 && r * 16 + 16 >= 80 + row &&
                                      c * 16 <= 80 + column + 1 && c * 16 + 16 >= 80 + column;
                EXPECT_EQ(seen.is_hidden({r, c, 1}), !adjacent)
                    << "node " << row << ", " << column << " in " << r << ", " << c;
            }
        // Of the pages below those over it or beside it: each has 8 x 8 of these nodes.
        for (int r = 8; r < 14; ++r)
            for (int c = 8; c < 14; ++c) {
                const bool adjacent = r * 8 <= 80 + row + 1 && r * 8 + 8 >= 80 + row &&
                                      c * 8 <= 80 + column + 1 && c * 8 + 8 >= 80 + column;
                EXPECT_EQ(seen.is_hidden({r, c, 0}), !adjacent) << r << ", " << c;
            }
        EXPECT_FALSE(seen.is_hidden({5 / 2, 5 / 2, 2}));
        EXPECT_FALSE(seen.is_hidden({0, 0, 4}));
    }
}

// Far below a node: by where it lies in it.
TEST(VisibilityFeedback, PagesFarBelowAreAskedByTheirPlace) {
    const EvenPages pages;
    VisibilityFeedback seen(pages);
    FrameFeedback feedback = asked({0, 0, 4});
    set(feedback, 0, 5, 11, true);
    seen.add(feedback);
    for (int row = 0; row < 16; ++row)
        for (int column = 0; column < 16; ++column)
            EXPECT_EQ(seen.is_hidden({row, column, 0}), std::abs(row - 5) > 1 || std::abs(column - 11) > 1);
}

// In whose place something coarser showed, once it was hidden: it stays, so that it does not come and go.
TEST(VisibilityFeedback, WhatWasHiddenAndShowsStaysShown) {
    const EvenPages pages;
    VisibilityFeedback seen(pages);
    FrameFeedback shows = asked({2, 2, 0});
    set(shows, 0, 3, 3, true);
    seen.add(shows);
    EXPECT_FALSE(seen.is_hidden({2, 2, 0}));
    EXPECT_TRUE(seen.add(asked({2, 2, 0})));
    EXPECT_TRUE(seen.is_hidden({2, 2, 0})) << "of what has shown once the last frame decides";
    seen.add(shows);
    EXPECT_FALSE(seen.is_hidden({2, 2, 0}));
    for (int frame = 0; frame < 3 * VisibilityFeedback::views_kept; ++frame) seen.add(asked({2, 2, 0}));
    EXPECT_FALSE(seen.is_hidden({2, 2, 0})) << "while the view stays";
    int views = 0;
    while (!seen.is_hidden({2, 2, 0}) && views < 100) seen.add(asked({2, 2, 0}, static_cast<float>(++views)));
    EXPECT_EQ(views, VisibilityFeedback::views_kept + 1);
}

// A page that is not there is hidden where that is sure of all that may be in its place, or where it was
// drawn and hidden while the same ground showed.
TEST(VisibilityFeedback, WhatStandsForAPageMayHideThatItShows) {
    const EvenPages pages;
    VisibilityFeedback seen(pages);
    FrameFeedback coarse = asked({1, 1, 1});
    seen.add(coarse);
    EXPECT_TRUE(seen.is_hidden({2, 2, 0})) << "even all that it may be";
    for (int word = 0; word < 8; ++word) coarse.words[2 * gpu::accepted_words + word] = ~0U;
    seen.add(coarse);
    EXPECT_FALSE(seen.is_hidden({2, 2, 0})) << "it may be higher than what stands for it";
    FrameFeedback fine = asked({2, 2, 0});
    seen.add(fine);
    EXPECT_TRUE(seen.is_hidden({2, 2, 0}));
    seen.add(coarse);
    EXPECT_TRUE(seen.is_hidden({2, 2, 0})) << "it was looked at";
    EXPECT_FALSE(seen.is_hidden({3, 2, 0})) << "nobody has looked at that one";
    // Something else shows now.
    FrameFeedback other = coarse;
    other.pages.push_back({8, 8, 0});
    const FrameFeedback beyond = asked({8, 8, 0});
    other.words.insert(other.words.end(), beyond.words.begin(), beyond.words.end());
    set(other, 1, 7, 7, true);
    seen.add(other);
    EXPECT_FALSE(seen.is_hidden({2, 2, 0})) << "other ground may hide less";
}

// The same by sets of nodes and of pages, and by where they lie: slow.
class SeenByPlace {
  public:
    explicit SeenByPlace(const RegionPages& pages) : pages_(pages) {}
    bool add(const FrameFeedback& feedback) {
        if (feedback.view.eye_high.x != eye_x_) {
            eye_x_ = feedback.view.eye_high.x;
            hidden_.clear();
            if (++views_ > VisibilityFeedback::views_kept) {
                were_hidden_.clear();
                came_back_.clear();
                views_ = 1;
            }
        }
        const Seen before = std::exchange(seen_, {});
        const std::size_t hidden = hidden_.size();
        for (std::size_t i = 0; i < feedback.pages.size(); ++i) {
            add_nodes(feedback, i, 0, 0, seen_.asked);
            add_nodes(feedback, i, 1, 1, seen_.shown);
            add_nodes(feedback, i, 2, 1, seen_.finer);
        }
        for (const Node& node : seen_.shown) {
            const PageIndex page{node.row / 16, node.column / 16, node.level};
            seen_.drawn[page] = std::ranges::find(feedback.pages, page) != feedback.pages.end();
        }
        if (seen_.shown != before.shown || seen_.drawn != before.drawn) hidden_.clear();
        for (const PageIndex& page : feedback.pages)
            if (any_over(seen_.asked, page) && !any_over(seen_.shown, page) && !any_over(seen_.finer, page))
                hidden_.insert(page);
        return seen_ != before || hidden_.size() != hidden;
    }
    bool is_hidden(const PageIndex& page) {
        if (came_back_.contains(page)) return false;
        if (any_over(seen_.shown, page)) {
            if (were_hidden_.contains(page)) came_back_.insert(page);
            return false;
        }
        if (!hidden_.contains(page) && (any_over(seen_.finer, page) || !any_over(seen_.asked, page)))
            return false;
        were_hidden_.insert(page);
        return true;
    }

  private:
    struct Node {
        int level, row, column;
        auto operator<=>(const Node&) const = default;
    };
    using Nodes = std::set<Node>;
    struct Seen {
        Nodes asked, shown, finer;
        std::map<PageIndex, bool> drawn;
        bool operator==(const Seen&) const = default;
    };
    void add_nodes(const FrameFeedback& feedback, std::size_t page, std::size_t which, int around,
                   Nodes& nodes) const {
        const PageIndex& index = feedback.pages[page];
        const PageLayout layout = pages_.layout(index.level);
        const gpu::uint* const words =
            &feedback.words[page * gpu::feedback_words + which * gpu::accepted_words];
        for (int node = 0; node < 256; ++node) {
            if ((words[node / 32] >> (node % 32) & 1U) == 0) continue;
            for (int down = -around; down <= around; ++down)
                for (int right = -around; right <= around; ++right) {
                    const int row = 16 * index.row + node / 16 + down;
                    const int column = 16 * index.column + node % 16 + right;
                    if (row < 0 || row >= 16 * layout.rows || column < 0 || column >= 16 * layout.columns)
                        continue;
                    nodes.insert({index.level, row, column});
                }
        }
    }
    static bool any_over(const Nodes& nodes, const PageIndex& page) {
        const int size = 16 << page.level;
        return std::ranges::any_of(nodes, [&](const Node& node) {
            const int own = 1 << node.level;
            return node.row * own < (page.row + 1) * size && (node.row + 1) * own > page.row * size &&
                   node.column * own < (page.column + 1) * size &&
                   (node.column + 1) * own > page.column * size;
        });
    }

    const RegionPages& pages_;
    Seen seen_;
    std::set<PageIndex> hidden_, were_hidden_, came_back_;
    int views_{};
    float eye_x_{};
};

TEST(VisibilityFeedback, IsThatOfSetsOfNodes) {
    constexpr unsigned seed = 5116;
    std::mt19937_64 random(seed);
    const auto below = [&](int count) { return static_cast<int>(random() % static_cast<unsigned>(count)); };
    const EvenPages pages;
    VisibilityFeedback seen(pages);
    SeenByPlace expected(pages);
    int hidden = 0, news = 0;
    FrameFeedback feedback;
    for (int i = 0; i < 400; ++i) {
        if (i == 0 || below(3) > 0) {  // else the same once more
            feedback.pages.clear();
            for (int j = 1 + below(12); j > 0; --j) {
                const int level = below(5);
                const PageIndex page{below(16 >> level), below(16 >> level), level};
                if (std::ranges::find(feedback.pages, page) == feedback.pages.end())
                    feedback.pages.push_back(page);
            }
            feedback.words.assign(feedback.pages.size() * gpu::feedback_words, 0);
            for (std::size_t word = 0; word < feedback.words.size(); ++word) {
                const bool is_asked = word % gpu::feedback_words < gpu::accepted_words;
                if (below(is_asked ? 2 : 40) == 0) feedback.words[word] = 1U << below(32);
            }
        }
        if (below(4) == 0) feedback.view.eye_high.x += 1.0F;
        SCOPED_TRACE("seed " + std::to_string(seed) + ", frame " + std::to_string(i));
        const bool is_new = expected.add(feedback);
        ASSERT_EQ(seen.add(feedback), is_new);
        news += is_new ? 1 : 0;
        for (int j = 0; j < 60; ++j) {
            const int level = below(5);
            const PageIndex page{below(16 >> level), below(16 >> level), level};
            const bool is_hidden = expected.is_hidden(page);
            ASSERT_EQ(seen.is_hidden(page), is_hidden) << page.row << ", " << page.column << ", " << level;
            hidden += is_hidden ? 1 : 0;
        }
    }
    std::printf("seed %u: %d of 400 frames tell something new, %d of 24000 pages hidden\n", seed, news,
                hidden);
    EXPECT_GT(hidden, 500);
    EXPECT_LT(news, 400);
}

}  // namespace
}  // namespace oro
