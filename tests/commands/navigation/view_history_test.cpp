// Views undone and done again.
#include "apps/navigation/view_history.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/commands/navigation/smooth_world.h"

namespace oro {
namespace {

TEST(ViewHistory, GoesBackAndForwardToTheLastBit) {
    test::RandomEyes eyes(80);
    ViewHistory history;
    std::vector<Camera> views;
    for (int i = 0; i < 5; ++i) {
        views.push_back(eyes.camera());
        history.rested(views.back());
        history.rested(views.back());
    }
    EXPECT_EQ(history.size(), 5U);
    Camera now = views.back();
    now.width_px = 111;
    for (std::size_t i = 4; i-- > 0;) {
        const auto before = history.undone(now);
        ASSERT_TRUE(before);
        EXPECT_TRUE(is_same_view(*before, views[i])) << i;
        EXPECT_EQ(before->width_px, 111);
        now = *before;
    }
    EXPECT_FALSE(history.undone(now));
    for (std::size_t i = 1; i < 5; ++i) {
        const auto next = history.again(now);
        ASSERT_TRUE(next);
        EXPECT_TRUE(is_same_view(*next, views[i])) << i;
        now = *next;
    }
    EXPECT_FALSE(history.again(now));
}

TEST(ViewHistory, AViewThatIsLeftIsRemembered) {
    test::RandomEyes eyes(81);
    const Camera first = eyes.camera(), second = eyes.camera(), third = eyes.camera();
    ViewHistory history;
    history.rested(first);
    EXPECT_TRUE(is_same_view(*history.undone(second), first));
    EXPECT_TRUE(is_same_view(*history.again(first), second));
    EXPECT_TRUE(is_same_view(*history.undone(second), first));
    history.rested(third);  // another way: the second is forgotten
    EXPECT_FALSE(history.again(third));
    EXPECT_TRUE(is_same_view(*history.undone(third), first));
}

TEST(ViewHistory, IsBounded) {
    test::RandomEyes eyes(82);
    ViewHistory history(3);
    std::vector<Camera> views;
    for (int i = 0; i < 10; ++i) {
        views.push_back(eyes.camera());
        history.rested(views.back());
    }
    EXPECT_EQ(history.size(), 3U);
    EXPECT_TRUE(is_same_view(*history.undone(views[9]), views[8]));
    EXPECT_TRUE(is_same_view(*history.undone(views[8]), views[7]));
    EXPECT_FALSE(history.undone(views[7]));
    EXPECT_FALSE(ViewHistory().again(views[0]));
}

}  // namespace
}  // namespace oro
