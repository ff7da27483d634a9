// A grid's file that a bake left behind: taken when it is what would be baked.
#include "geo/together/baked_grids.h"

#include <gtest/gtest.h>

#include "core/baked/bake.h"
#include "tests/support/rough_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

TEST(BakedGrid, IsTakenWhereItsCellsAreSplitAlike) {
    HeightField field = test::rough_field(47.0, 8.0, 40, 50);
    const std::filesystem::path folder = test::scratch_folder();
    for (const CellSplit split : {CellSplit::all_fall, CellSplit::by_posts}) {
        field.grid.split = split;
        BakeOptions how;
        how.path = folder / "grid.oro";
        how.fingerprint = 5;
        how.description = "{}";
        how.overwrite = true;
        ASSERT_TRUE(bake_region(field, how).ok());
        EXPECT_TRUE(is_baked_grid(how.path, 5, "{}", split));
        EXPECT_FALSE(is_baked_grid(how.path, 6, "{}", split));
        EXPECT_FALSE(is_baked_grid(how.path, 5, "", split));
        const bool falls = split == CellSplit::all_fall;
        EXPECT_FALSE(is_baked_grid(how.path, 5, "{}", falls ? CellSplit::by_posts : CellSplit::all_fall));
    }
}

}  // namespace
}  // namespace oro
