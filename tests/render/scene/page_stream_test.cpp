// Pages that come in the background: order, limits, errors, and threads that end.
#include "render/scene/page_stream.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <new>
#include <set>

namespace oro {
namespace {

constexpr int too_large_row = 77;

// Pages of nothing, that count how many are loaded at a time; one of them cannot be read.
class CountingPages : public RegionPages {
  public:
    explicit CountingPages(int unreadable_row)
        : RegionPages({{{1200.0, 47.0, 0, -1, 2000}, {1200.0, 8.0, 0, 1, 2000}}, {}, {}, 1}),
          unreadable_row_(unreadable_row) {}
    [[nodiscard]] Result<PageRecord> record(const PageIndex&) const override { return PageRecord{}; }
    Result<void> load(const PageIndex& page, gpu::PageBlock& block) const override {
        most_at_a_time = std::max(most_at_a_time.load(), ++at_a_time_);
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        block.heights[0] = page.row * 100 + page.column;
        --at_a_time_;
        ++loaded;
        if (page.row == too_large_row) throw std::bad_alloc();
        if (page.row == unreadable_row_) return Error{ErrorKind::failed, "made.oro", "damaged"};
        return {};
    }
    mutable std::atomic<int> most_at_a_time{0};
    mutable std::atomic<int> loaded{0};

  private:
    int unreadable_row_;
    mutable std::atomic<int> at_a_time_{0};
};

std::vector<PageIndex> row_of_pages(int row, int count) {
    std::vector<PageIndex> pages;
    for (int column = 0; column < count; ++column) pages.push_back({row, column, 0});
    return pages;
}

TEST(PageStream, BringsWhatIsWantedOnce) {
    const CountingPages pages(-1);
    PageStream stream(pages, 4, 3);
    stream.want(row_of_pages(1, 12));
    std::set<int> came;
    while (came.size() < 12) {
        auto some = stream.take(true);
        ASSERT_TRUE(some.ok());
        ASSERT_FALSE(some->empty());
        EXPECT_LE(some->size(), 3U);
        for (const LoadedPage& page : *some) {
            EXPECT_EQ(page.block->heights[0], 100 + page.index.column);
            EXPECT_TRUE(came.insert(page.index.column).second) << "came twice";
        }
    }
    EXPECT_TRUE(stream.idle());
    EXPECT_EQ(pages.loaded, 12);
    EXPECT_LE(pages.most_at_a_time, 3);
    auto none = stream.take(true);
    ASSERT_TRUE(none.ok());
    EXPECT_TRUE(none->empty()) << "does not wait for what will never come";
}

// In a thread of its own it would end the program.
TEST(PageStream, ThrowsToItsCallerWhatAThreadThrew) {
    const CountingPages pages(-1);
    PageStream stream(pages, 2, 3);
    stream.want(row_of_pages(too_large_row, 1));
    EXPECT_THROW((void)stream.take(true), std::bad_alloc);
    stream.want(row_of_pages(1, 1));
    EXPECT_TRUE(stream.take(true).ok()) << "goes on afterwards";
}

TEST(PageStream, DropsWhatIsNoLongerWanted) {
    const CountingPages pages(-1);
    PageStream stream(pages, 1, 2);
    stream.want(row_of_pages(1, 500));
    stream.want(row_of_pages(2, 3));
    std::set<int> rows;
    for (int came = 0; came < 3;) {
        auto some = stream.take(true);
        ASSERT_TRUE(some.ok());
        for (const LoadedPage& page : *some) {
            rows.insert(page.index.row);
            came += page.index.row == 2 ? 1 : 0;
        }
    }
    EXPECT_TRUE(rows.contains(2));
    EXPECT_LE(pages.loaded, 3 + 3) << "at most what was under way besides";
}

TEST(PageStream, TellsAnErrorOnceAndGoesOn) {
    const CountingPages pages(5);
    PageStream stream(pages, 2, 8);
    stream.want(row_of_pages(5, 1));
    const auto failed = stream.take(true);
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().line(), "made.oro: damaged");
    stream.want(row_of_pages(6, 2));
    std::size_t came = 0;
    while (came < 2) {
        const auto some = stream.take(true);
        ASSERT_TRUE(some.ok());
        came += some->size();
    }
}

TEST(PageStream, EndsWhileItIsBusy) {
    const CountingPages pages(-1);
    for (int i = 0; i < 20; ++i) {
        PageStream stream(pages, 3, 50);
        stream.want(row_of_pages(i, 200));
        if (i % 2 == 0) {
            ASSERT_TRUE(stream.take(true).ok());
        }
    }
    EXPECT_LT(pages.loaded, 20 * 200);
}

}  // namespace
}  // namespace oro
