// Which column of a table holds heights over the ground.
#include "geo/vectors/coordinate_columns.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace oro {
namespace {

using Headings = std::vector<std::string>;

TEST(AboveGroundColumn, HasSeveralNames) {
    for (const char* const heading :
         {"above", "Above", "Height", "mast_height", "Above Ground", "AGL", "height_above_ground",
          "HEIGHT (m)", "height_m", "Height [metres]", "Height (m AGL)", "height_agl"})
        EXPECT_EQ(above_ground_column({"name", heading}), std::optional<std::size_t>(1)) << heading;
    EXPECT_EQ(above_ground_column({"Height", "x", "above"}), std::optional<std::size_t>(2));
}

// Heights above the sea and those in feet.
TEST(AboveGroundColumn, IsNoOtherHeight) {
    for (const char* const heading : {"ele", "elevation", "alt", "H", "z", "Height (m a.s.l.)", "Height (ft)",
                                      "above (feet)", "height above sea level", "heights", ""})
        EXPECT_EQ(above_ground_column({"name", heading}), std::nullopt) << heading;
}

// What is a height above the sea in a gazetteer stays one.
TEST(AboveGroundColumn, LeavesColumnsOfPlacesAsTheyAre) {
    EXPECT_EQ(coordinate_columns({"lat", "lon", "height"}).height, std::nullopt);
    EXPECT_EQ(coordinate_columns({"lat", "lon", "ele"}).height, std::optional<std::size_t>(2));
}

}  // namespace
}  // namespace oro
