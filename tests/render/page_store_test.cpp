// Slots for pages: never more than the budget, and the longest unused goes first.
#include "render/scene/page_store.h"

#include "tests/support/gpu_fixture.h"

namespace oro {
namespace {

class Store : public test::GpuTest {
  protected:
    static std::vector<LoadedPage> some(int first, int count) {
        std::vector<LoadedPage> pages;
        for (int i = first; i < first + count; ++i)
            pages.push_back({{0, i, 0}, std::make_unique<gpu::PageBlock>(), nullptr, nullptr});
        return pages;
    }
};

TEST_F(Store, NeverHoldsMoreThanItsCapacity) {
    auto store = PageStore::create(*gpu_, 150);
    ASSERT_TRUE(store.ok()) << store.error().line();
    EXPECT_EQ(*store->send(some(0, 100)), 100U);
    store->begin_frame();
    EXPECT_EQ(*store->send(some(100, 100)), 100U);
    EXPECT_EQ(store->size(), 150U);
    EXPECT_EQ(store->bytes(), 150 * sizeof(gpu::PageBlock));
    for (int i = 0; i < 50; ++i) EXPECT_EQ(store->address({0, i, 0}), 0U) << "the oldest made room: " << i;
    for (int i = 50; i < 200; ++i) EXPECT_NE(store->address({0, i, 0}), 0U) << i;
    EXPECT_EQ(*store->send(some(300, 5)), 0U) << "all are in use by this frame";
    store->begin_frame();
    EXPECT_NE(store->address({0, 60, 0}), 0U);
    EXPECT_EQ(*store->send(some(300, 149)), 149U);
    EXPECT_NE(store->address({0, 60, 0}), 0U) << "it is in use";
    EXPECT_EQ(*store->send(some(300, 1)), 1U) << "it is here already";
}

}  // namespace
}  // namespace oro
