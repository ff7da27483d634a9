// How far windows reach beyond what they own: as far as what is not whole comes, by the lines of the levels.
#include "core/cluster_windows/window_margins.h"

#include <gtest/gtest.h>

namespace oro {
namespace {

WindowMargins columns_of(int above, int levels) {
    WindowSizes sizes;
    sizes.above = above;
    sizes.levels = levels;
    return {WindowMargins::Along::columns, sizes};
}

// Lines of level 1 are at whole 24 posts. A group is whole where none of its posts is on the window's end.
TEST(WindowMargins, OfOneLevelAreALeaf) {
    const WindowMargins margins = columns_of(0, 1);
    EXPECT_EQ(margins.begin(240), 232);
    EXPECT_EQ(margins.end(239), 248);
    // The tile 240 .. 264 has its middle at 252, and is no longer owned at 253; but a leaf at 256 goes there.
    EXPECT_EQ(margins.begin(256), 232);
}

// Lines of level 2 are at 12 + whole 48 posts. What begins at 300 goes, for triangles that lie across lines,
// to the tile from 252 on, too. It is whole if groups of level 1 that are not reach no farther than 240, less
// a quarter of a tile for the same reason.
TEST(WindowMargins, OfTwoLevelsComeToTheNextLine) {
    const WindowMargins margins = columns_of(0, 2);
    EXPECT_EQ(margins.begin(300), 208);
    EXPECT_EQ(margins.end(299), 344);
}

TEST(WindowMargins, AreWideEnoughAnywhere) {
    for (const auto& [above, levels] : {std::pair{0, 4}, {4, 8}, {0, 8}, {8, 12}}) {
        const WindowMargins margins = columns_of(above, levels);
        const int most = margins.most();
        for (int own = 8000; own < 20000; own += 104) {
            EXPECT_LT(margins.begin(own), own);
            EXPECT_GT(margins.end(own - 1), own - 1);
            EXPECT_LE(own - margins.begin(own), most) << above << " to " << levels << " at " << own;
            EXPECT_LE(margins.end(own - 1) - own + 1, most);
            EXPECT_EQ(margins.begin(own) % leaf_side, 0);
            EXPECT_EQ(margins.end(own - 1) % leaf_side, 0);
        }
    }
}

}  // namespace
}  // namespace oro
