// Places of pages of several sizes: none over another, what is free grows together, the longest unseen goes
// first.
#include "render/scene/page_shelves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

namespace oro {
namespace {

using Key = PageShelves::Key;

Key key(int number) {
    return {0, number, 0};
}

TEST(PageShelves, FillsWhatIsFree) {
    PageShelves shelves;
    EXPECT_EQ(shelves.take(key(0), 10), nullptr);
    shelves.add(100);
    for (int i = 0; i < 3; ++i) {
        const auto* const slot = shelves.take(key(i), 30);
        ASSERT_NE(slot, nullptr);
        EXPECT_EQ(slot->place, 30U * static_cast<std::size_t>(i));
    }
    EXPECT_EQ(shelves.take(key(3), 30), nullptr) << "10 bytes are left";
    EXPECT_TRUE(shelves.has_room(10));
    EXPECT_FALSE(shelves.has_room(11));
    shelves.free(key(0));
    shelves.free(key(1));
    EXPECT_TRUE(shelves.has_room(60)) << "both together";
    EXPECT_EQ(shelves.take(key(4), 60)->place, 0U);
    EXPECT_EQ(shelves.find(key(1)), nullptr);
    EXPECT_EQ(shelves.find(key(4))->bytes, 60U);
    EXPECT_EQ(shelves.pages(), 2U);
    shelves.free_all();
    EXPECT_EQ(shelves.pages(), 0U);
    EXPECT_TRUE(shelves.has_room(100)) << "in one piece";
}

// A page of 50 bytes takes the place of the two of 30 that lie beside each other and have not been shown
// longest.
TEST(PageShelves, TakesTheLongestUnseenThatLieTogether) {
    PageShelves shelves;
    shelves.add(150);
    for (int i = 0; i < 5; ++i) shelves.take(key(i), 30);
    const auto show = [&](int number) {
        auto* const slot = shelves.find(key(number));
        slot->used = slot->shown = shelves.frame();
    };
    for (const int number : {2, 4, 1, 0, 3}) {  // each a frame later
        shelves.begin_frame();
        show(number);
    }
    EXPECT_EQ(shelves.room(30), 4U) << "the frame uses 3";
    EXPECT_EQ(shelves.room(50), 1U);
    EXPECT_EQ(shelves.take_used(key(9), 100, 0), nullptr) << "90 bytes before the one in use";
    auto* const slot = shelves.take_used(key(5), 50, 0);
    ASSERT_NE(slot, nullptr);
    slot->shown = shelves.frame();
    EXPECT_EQ(slot->place, 30U) << "1 and 2 were seen last before 0";
    EXPECT_EQ(shelves.find(key(1)), nullptr);
    EXPECT_EQ(shelves.find(key(2)), nullptr);
    for (const int there : {0, 3, 4}) EXPECT_NE(shelves.find(key(there)), nullptr) << there;
    EXPECT_TRUE(shelves.has_room(10));
    shelves.begin_frame();
    EXPECT_EQ(shelves.take_used(key(6), 50, 64), nullptr) << "all were shown in the last 64 frames";
}

TEST(PageShelves, LetsGoOfWholeShelves) {
    PageShelves shelves;
    for (int i = 0; i < 3; ++i) {
        shelves.add(60);
        for (int page = 0; page < 2; ++page) shelves.take(key(2 * i + page), 30);
    }
    EXPECT_EQ(shelves.release_unused(), (std::vector<bool>{true, true, true}));
    shelves.begin_frame();
    shelves.find(key(3))->used = shelves.frame();
    EXPECT_EQ(shelves.release_unused(), (std::vector<bool>{false, true, false}));
    EXPECT_EQ(shelves.pages(), 2U);
    EXPECT_EQ(shelves.find(key(3))->shelf, 0U) << "numbered anew";
    EXPECT_EQ(shelves.find(key(3))->place, 30U);
    EXPECT_EQ(shelves.find(key(0)), nullptr);
}

// Random pages of random sizes, held against a list of all that is there.
TEST(PageShelves, NeverPutsOnePageOverAnother) {
    std::mt19937 random(75);
    PageShelves shelves;
    std::size_t placed = 0, refused = 0;
    for (int i = 0; i < 3; ++i) shelves.add(1000);
    for (int i = 0; i < 20000; ++i) {
        if (random() % 8 == 0) shelves.begin_frame();
        const Key page = key(static_cast<int>(random() % 200));
        if (auto* const here = shelves.find(page)) {
            if (random() % 3 == 0)
                shelves.free(page);
            else
                here->used = here->shown = shelves.frame();
            continue;
        }
        const std::size_t bytes = 1 + random() % 120;
        auto* slot = shelves.take(page, bytes);
        if (slot == nullptr) slot = shelves.take_used(page, bytes, random() % 2 ? 0 : 3);
        slot == nullptr ? ++refused : ++placed;
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> ends;
        std::size_t held = 0;
        for (int number = 0; number < 200; ++number) {
            const auto* const one = shelves.find(key(number));
            if (one == nullptr) continue;
            ASSERT_TRUE(ends.emplace(std::pair(one->shelf, one->place), one->place + one->bytes).second);
            ++held;
        }
        ASSERT_EQ(held, shelves.pages());
        std::pair<std::size_t, std::size_t> last{0, 0};
        for (const auto& [from, end] : ends) {
            ASSERT_TRUE(from.first != last.first || from.second >= last.second) << "place " << i;
            ASSERT_LE(end, 1000U);
            last = {from.first, end};
        }
    }
    EXPECT_GT(placed, 8000U);
    EXPECT_GT(refused, 10U);
}

}  // namespace
}  // namespace oro
