// Must hold: a rule is told of a grid only if all its posts are those of the rule.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "core/made/made_heights.h"
#include "geo/opening/made_world.h"
#include "geo/opening/open_region.h"
#include "geo/sources/made_words.h"

namespace oro {
namespace {

Region made_region_opened(RegionRequest request) {
    auto region = open_region(request);
    EXPECT_TRUE(region.ok()) << region.error().line();
    return std::move(region).value();
}

// Posts of a grid that are not the rule's.
std::size_t posts_that_differ(const RegionGrid& grid, const MadeGround& ground, MadeTerrain terrain) {
    terrain.north = ground.north;
    terrain.west = ground.west;
    const auto count = static_cast<std::size_t>(grid.field.grid.columns());
    const std::vector<MadeColumn> columns = made_columns(terrain, 0, static_cast<int>(count));
    std::vector<std::int32_t> steps(count);
    std::size_t differ = 0;
    for (int row = 0; row < grid.field.grid.rows(); ++row) {
        made_row_heights(terrain, ground.rule, row, 0, columns, steps);
        for (std::size_t i = 0; i < count; ++i)
            differ += static_cast<float>(steps[i] * made_step_m) !=
                      grid.field.H_m[static_cast<std::size_t>(row) * count + i];
    }
    return differ;
}

TEST(MadeGroundOf, HasThePlacesOfAGridsPosts) {
    struct Case {
        std::string words;
        std::optional<BoundingBox> box;
        std::int64_t north, west;
    };
    const std::vector<Case> cases{
        {"made:fbm?seed=7&H=-200:4000&spacing=3s&box=8.4,46.4,8.6,46.6", {}, 55920, 10080},
        {"made:checker?H=0:10&spacing=3s&box=8.4,46.4,8.6,46.6", {}, 55920, 10080},
        // What is left of 8.4 to 8.6 E, and of 46.4 to 46.6 N.
        {"made:cone?H=-200:4000&spacing=3s&box=8.4,46.4,8.6,46.6", BoundingBox{8.45, 46.42, 8.55, 46.5},
         55800, 10140},
        // Over 180 degrees, and round the Earth to both poles.
        {"made:ridged?seed=3&H=-200:4000&spacing=9s&box=179.9,-17,-179.9,-16.8", {}, -6720, 71960},
        {"made:fbm?seed=3&H=-200:4000&spacing=1800s&box=-180,-90,180,90", {}, 180, -360}};
    for (const Case& one : cases) {
        RegionRequest request;
        request.paths = {one.words};
        request.box = one.box;
        const Region region = made_region_opened(request);
        const auto ground = made_ground_of(region.grids[0]);
        ASSERT_NE(ground, nullptr) << one.words;
        EXPECT_EQ(ground->north, one.north) << one.words;
        EXPECT_EQ(ground->west, one.west) << one.words;
        EXPECT_EQ(posts_that_differ(region.grids[0], *ground, *made_terrain_of(one.words)), 0U) << one.words;
    }
}

TEST(MadeGroundOf, IsNoneOfOtherGrids) {
    const std::string words = "made:fbm?seed=7&H=-200:4000&spacing=3s&box=8.4,46.4,8.6,46.6";
    RegionRequest request;
    request.paths = {words};
    Region region = made_region_opened(request);
    RegionGrid& grid = region.grids[0];
    ASSERT_NE(made_ground_of(grid), nullptr);
    grid.field.H_m[240 * 241 + 7] += 1.0F;  // of the last row
    EXPECT_EQ(made_ground_of(grid), nullptr);
    grid.field.H_m[240 * 241 + 7] -= 1.0F;
    grid.canopy.emplace();
    EXPECT_EQ(made_ground_of(grid), nullptr);
    request.paths.emplace_back("made:fbm?seed=8&H=-200:4000&spacing=3s&box=8.5,46.4,8.7,46.6");
    EXPECT_EQ(made_ground_of(made_region_opened(request).grids[0]), nullptr);
}

}  // namespace
}  // namespace oro
