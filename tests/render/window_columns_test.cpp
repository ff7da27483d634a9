// Columns of pictures in a window: whole, in halves, and left and right of a line.
#include "render/window_columns.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace {

using oro::shown_columns;
using oro::ShownColumns;

TEST(ShownColumnsOfPictures, OneAloneFillsTheWindow) {
    EXPECT_EQ(shown_columns(640, 640, 0, 640, false), (ShownColumns{0, 640, 0, 640}));
    EXPECT_EQ(shown_columns(230, 640, 0, 640, false), (ShownColumns{0, 230, 0, 640}));
}

TEST(ShownColumnsOfPictures, HalvesAreScaledToTheirSides) {
    EXPECT_EQ(shown_columns(320, 641, 0, 320, false), (ShownColumns{0, 320, 0, 320}));
    EXPECT_EQ(shown_columns(321, 641, 320, 641, false), (ShownColumns{0, 321, 320, 641}));
    EXPECT_EQ(shown_columns(116, 641, 320, 641, false), (ShownColumns{0, 116, 320, 641}));
}

TEST(ShownColumnsOfPictures, ALinePartsThemWithoutAShift) {
    for (std::uint32_t line = 0; line <= 640; ++line) {
        const ShownColumns left = shown_columns(640, 640, 0, line, true);
        const ShownColumns right = shown_columns(640, 640, line, 640, true);
        const auto at = static_cast<std::int32_t>(line);
        ASSERT_EQ(left, (ShownColumns{0, at, 0, at}));
        ASSERT_EQ(right, (ShownColumns{at, 640, at, 640}));
        EXPECT_EQ(left.is_empty(), line == 0);
        EXPECT_EQ(right.is_empty(), line == 640);
    }
}

// Pictures of fewer pixels, while the eye moves: no column is left out or shown twice, and none is moved by
// more than half of one.
TEST(ShownColumnsOfPictures, CoarserOnesMeetAtTheNearestColumn) {
    constexpr std::uint32_t picture = 230, window = 640;
    for (std::uint32_t line = 0; line <= window; ++line) {
        const ShownColumns left = shown_columns(picture, window, 0, line, true);
        const ShownColumns right = shown_columns(picture, window, line, window, true);
        ASSERT_EQ(left.from_end_px, right.from_px);
        ASSERT_EQ(right.from_end_px, 230);
        EXPECT_LE(2 * std::abs(left.from_end_px * 640 - static_cast<int>(line) * 230), 640);
    }
}

}  // namespace
