// The top row of small windows.
#include "apps/window/panels/top_row.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

// In a window of 330 x 240 the menu began at 310, and its button of 36 pixels was cut; the compass, 52 pixels
// wide and 10 from the side, lay over it.
TEST(TopRow, TheMenuStandsBetweenFieldAndCompass) {
    EXPECT_EQ(top_row(1280.0F).field_width, 270.0F);
    EXPECT_EQ(top_row(1280.0F).buttons_x, 310.0F);
    EXPECT_EQ(top_row(414.0F).buttons_x, 310.0F);
    for (const float width : {220.0F, 330.0F, 400.0F})
        EXPECT_LE(top_row(width).buttons_x + 36.0F, width - 62.0F) << width;
    EXPECT_EQ(top_row(330.0F).field_width, 186.0F);
    EXPECT_EQ(top_row(100.0F).field_width, 60.0F);
}

}  // namespace
}  // namespace oro
