// A grid's file that a bake left behind: taken when it is what would be baked.
#include "geo/together/baked_parts.h"

#include <gtest/gtest.h>

#include "core/baked/bake.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

TEST(BakedGrid, IsTakenWhereItIsWhatIsToBeBaked) {
    BakeOptions how;
    how.path = test::scratch_folder() / "grid.oro";
    how.fingerprint = 5;
    how.description = "{}";
    ASSERT_TRUE(bake_region(test::rough_field(47.0, 8.0, 40, 50), how).ok());
    EXPECT_TRUE(baked_grid(how.path, 5, "{}"));
    EXPECT_FALSE(baked_grid(how.path, 6, "{}"));
    EXPECT_FALSE(baked_grid(how.path, 5, ""));
}

}  // namespace
}  // namespace oro
