// Slots for pages: never more than the budget, and the longest unused goes first.
#include "render/scene/page_store.h"

#include <algorithm>
#include <map>
#include <random>

#include "tests/support/gpu_fixture.h"

namespace oro {
namespace {

class Store : public test::GpuTest {
  protected:
    static std::shared_ptr<MemoryBudget> budget_of(std::size_t count) {
        return std::make_shared<MemoryBudget>(count * sizeof(gpu::PageBlock));
    }
    static std::vector<LoadedPage> some(int first, int count, bool hidden = false) {
        std::vector<LoadedPage> pages;
        for (int i = first; i < first + count; ++i)
            pages.push_back({{0, i, 0}, std::make_unique<gpu::PageBlock>(), nullptr, nullptr, hidden});
        return pages;
    }
};

TEST_F(Store, NeverHoldsMoreThanItsCapacity) {
    PageStore store(*gpu_, budget_of(150));
    EXPECT_EQ(*store.send(some(0, 100)), 100U);
    store.begin_frame();
    EXPECT_EQ(*store.send(some(100, 100)), 100U);
    EXPECT_EQ(store.size(), 150U);
    EXPECT_EQ(store.bytes(), 150 * sizeof(gpu::PageBlock));
    for (int i = 0; i < 50; ++i) EXPECT_EQ(store.address({0, i, 0}), 0U) << "the oldest were evicted: " << i;
    for (int i = 50; i < 200; ++i) EXPECT_NE(store.address({0, i, 0}), 0U) << i;
    EXPECT_EQ(*store.send(some(300, 5)), 0U) << "all are in use by this frame";
    store.begin_frame();
    EXPECT_NE(store.address({0, 60, 0}), 0U);
    EXPECT_EQ(*store.send(some(300, 149)), 149U);
    EXPECT_NE(store.address({0, 60, 0}), 0U) << "it is in use";
    EXPECT_EQ(*store.send(some(300, 1)), 1U) << "it is here already";
}

TEST_F(Store, TellsWhatMeansTakeBesides) {
    const PageStore plain(*gpu_, budget_of(5)), with(*gpu_, budget_of(5), {}, {.means = true});
    EXPECT_EQ(plain.means_bytes_a_post(), 0.0);
    EXPECT_EQ(with.means_bytes_a_post(), 136.0 * 136 * 12 / (128 * 128)) << "136 x 136 squares of 12 bytes";
    EXPECT_EQ(with.bytes_a_post(), plain.bytes_a_post());
}

// What other ground hides is evicted before what shows, and evicts nothing that was shown lately.
TEST_F(Store, EvictsHiddenPagesFirst) {
    PageStore store(*gpu_, budget_of(20));
    EXPECT_EQ(*store.send(some(0, 20)), 20U);
    EXPECT_FALSE(store.has_capacity());
    for (int frame = 0; frame < 5; ++frame) {
        store.begin_frame();
        for (int i = 0; i < 20; ++i) EXPECT_NE(store.address({0, i, 0}), 0U);
        for (int i = 10; i < 15; ++i) store.mark_occluded({0, i, 0});
    }
    EXPECT_EQ(*store.send(some(100, 1)), 0U) << "the frame uses all, hidden ones, too";
    store.begin_frame();
    EXPECT_EQ(*store.send(some(100, 5)), 5U);
    for (int i = 0; i < 20; ++i) EXPECT_EQ(store.address({0, i, 0}) != 0, i < 10 || i >= 15) << "page " << i;
    store.begin_frame();
    EXPECT_EQ(*store.send(some(200, 5, true)), 0U) << "all were shown a frame ago";
    EXPECT_EQ(*store.send(some(300, 5)), 5U) << "what shows evicts them";
    for (std::uint64_t i = 0; i < PageStore::shown_lately; ++i) store.begin_frame();
    EXPECT_EQ(*store.send(some(400, 5, true)), 5U) << "that was long ago";
    store.begin_frame();
    EXPECT_EQ(*store.send(some(500, 5)), 5U);
    for (int i = 400; i < 405; ++i) EXPECT_EQ(store.address({0, i, 0}), 0U) << "never shown: first to go";
}

// Packed heights take as many bytes as they need: 13,340 before them, and addresses at multiples of 16.
TEST_F(Store, HoldsPagesOfSeveralSizes) {
    constexpr std::uint64_t budget = 1'000'000;
    const HeightQuantization packed{false, 0, 0, true};
    PageStore store(*gpu_, std::make_shared<MemoryBudget>(budget), packed);
    std::mt19937 random(77);
    std::vector<std::size_t> words(400);
    for (std::size_t& count : words) count = 1158 + random() % 17000;
    std::size_t most = 0;
    for (int first = 0; first < 400; first += 10) {
        store.begin_frame();
        std::vector<LoadedPage> pages = some(first, 10);
        for (int i = 0; i < 10; ++i)
            pages[static_cast<std::size_t>(i)].heights.resize(words[static_cast<std::size_t>(first + i)]);
        EXPECT_EQ(*store.send(pages), 10U) << "at most 820,000 bytes";
        std::map<std::uint64_t, std::uint64_t> ends;
        for (int i = 0; i < first + 10; ++i) {
            const std::uint64_t from = store.address({0, i, 0});
            if (from == 0) continue;
            EXPECT_EQ(from % 16, 0U);
            ends[from] = from + 13340 + 4 * words[static_cast<std::size_t>(i)];
        }
        ASSERT_EQ(ends.size(), store.size());
        std::uint64_t last = 0;
        for (const auto& [from, end] : ends) {
            EXPECT_GE(from, last);
            last = end;
        }
        most = std::max(most, ends.size());
        EXPECT_LE(store.bytes(), budget);
    }
    EXPECT_GT(most, 18U) << "47,000 bytes each";
    EXPECT_NEAR(store.bytes_a_post(), 4.0 * (1158 + 8500) / 16384, 0.15);
}

// Two regions' pages in the memory of one: who looks elsewhere leaves it to the other.
TEST_F(Store, SharesItsBudgetWithOthers) {
    const auto budget = budget_of(64);
    PageStore one(*gpu_, budget), other(*gpu_, budget);
    EXPECT_EQ(one.capacity(), 64U);
    EXPECT_EQ(*one.send(some(0, 64)), 64U);
    EXPECT_EQ(budget->left(), 0U);
    EXPECT_EQ(*other.send(some(0, 20)), 1U) << "the first buffer is made whatever is left";
    one.begin_frame();
    EXPECT_NE(one.address({0, 3, 0}), 0U);
    other.begin_frame();
    EXPECT_TRUE(one.release_unused()) << "the second of its buffers";
    EXPECT_FALSE(one.release_unused());
    EXPECT_EQ(one.size(), 32U);
    EXPECT_NE(one.address({0, 3, 0}), 0U) << "it is in use";
    EXPECT_NE(one.address({0, 31, 0}), 0U) << "it lies beside one in use";
    EXPECT_EQ(one.address({0, 32, 0}), 0U);
    EXPECT_EQ(*other.send(some(0, 40)), 32U);
    EXPECT_LE(one.bytes() + other.bytes(), budget->bytes() + sizeof(gpu::PageBlock));
    // What is left goes on as before.
    one.begin_frame();
    EXPECT_EQ(*one.send(some(100, 32)), 32U);
    for (int i = 100; i < 132; ++i) EXPECT_NE(one.address({0, i, 0}), 0U) << i;
}

}  // namespace
}  // namespace oro
