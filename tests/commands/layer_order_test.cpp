// Files over the ground, moved up and down.
#include "apps/window/layer_order.h"

#include <gtest/gtest.h>

namespace {
using Files = std::vector<std::string>;

TEST(LayerOrder, ListsTheTopmostFirst) {
    EXPECT_EQ(oro::layers_from_the_top({"a", "b", "c", "d"}, {"c", "a"}), (Files{"a", "c", "b", "d"}));
    EXPECT_EQ(oro::layers_from_the_top({}, {}), Files());
}

TEST(LayerOrder, MovesByOnePlace) {
    Files on{"a", "b", "c"};
    EXPECT_TRUE(oro::move_layer(on, "a", true));
    EXPECT_EQ(on, (Files{"b", "a", "c"}));
    EXPECT_TRUE(oro::move_layer(on, "c", false));
    EXPECT_EQ(on, (Files{"b", "c", "a"}));
    EXPECT_FALSE(oro::move_layer(on, "a", true)) << "it is on top";
    EXPECT_FALSE(oro::move_layer(on, "b", false)) << "it is the lowest";
    EXPECT_FALSE(oro::move_layer(on, "d", true)) << "it is off";
    EXPECT_EQ(on, (Files{"b", "c", "a"}));
}

}  // namespace
