// Descriptions of baked grids that tell of other data than the grids have.
#include "geo/region/description_check.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "geo/region/region_fingerprints.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

// A tile of 61 x 81 posts, as a description tells of it.
RegionGrid tile() {
    RegionGrid grid;
    grid.field = test::rough_field(47.0, 8.0, 61, 81);
    const HeightRange range = height_range(grid.field);
    SourceReport& source = grid.sources.emplace_back();
    source.path = "tile.tif";
    source.rows = 61;
    source.columns = 81;
    source.lat_spacing_deg = source.lon_spacing_deg = 1.0 / 1200.0;
    source.box = {8.0, 46.95, 8.0 + 80.0 / 1200.0, 47.0};
    source.lowest_m = static_cast<double>(range.lowest_m);
    source.highest_m = static_cast<double>(range.highest_m);
    source.placement = Placement{Fit::same_posts, 0.0, 1, 1};
    grid.posts_hash = posts_hash(grid.field);
    return grid;
}

std::string refusal(const std::function<void(RegionGrid&)>& change, bool may_be_feathered = false) {
    RegionGrid grid = tile();
    change(grid);
    const auto checked = check_description(grid, may_be_feathered, "grid 2: ");
    return checked.ok() ? "" : checked.error().line();
}
bool says(const std::string& line, const std::string& words) {
    return line.find("grid 2: its description tells " + words) != std::string::npos;
}

TEST(DescriptionCheck, OfAGridsOwnDataFindsNothing) {
    EXPECT_EQ(refusal([](RegionGrid&) {}), "");
    // What is told of the sources is told for more than a part has, and heights may be blended or resampled.
    EXPECT_EQ(refusal([](RegionGrid& grid) {
                  grid.notes = {"cut out of all.oro: sources, seams and filled posts are told for all of it"};
                  grid.sources[0].box = {10.0, 50.0, 11.0, 51.0};
                  grid.sources[0].lowest_m = -900.0;
              }),
              "");
    EXPECT_EQ(refusal([](RegionGrid& grid) { grid.sources[0].highest_m = 5.0e3, grid.posts_hash = 1; }, true),
              "");
    EXPECT_EQ(refusal([](RegionGrid& grid) {
                  grid.sources[0].placement->fit = Fit::elsewhere;
                  grid.sources[0].rows = 500;
                  grid.sources[0].highest_m = 5.0e3;
              }),
              "");
}

TEST(DescriptionCheck, TellsWhatContradictsTheData) {
    EXPECT_TRUE(says(refusal([](RegionGrid& grid) { grid.sources[0].rows = 99; }),
                     "the rows of tile.tif 99, but the data have 61 in its box"));
    EXPECT_TRUE(says(refusal([](RegionGrid& grid) { grid.sources[0].columns = 9; }),
                     "the columns of tile.tif 9, but the data have 81 in its box"));
    EXPECT_TRUE(says(refusal([](RegionGrid& grid) {
                         grid.sources[0].box = {18.0, 46.95, 18.0 + 80.0 / 1200.0, 47.0};
                     }),
                     "the box of tile.tif 18,46.95,"));
    EXPECT_TRUE(says(refusal([](RegionGrid& grid) { grid.sources[0].lat_spacing_deg = 0.01; }),
                     "posts of tile.tif every 0.01, but the data have 0.000833333333 degrees of latitude"));
    EXPECT_TRUE(says(refusal([](RegionGrid& grid) { grid.sources[0].lowest_m = -5000.0; }),
                     "the lowest H in metres of tile.tif -5000, but the data have "));
    EXPECT_TRUE(says(refusal([](RegionGrid& grid) { grid.sources[0].highest_m = 8000.0; }),
                     "the highest H in metres of tile.tif 8000, but the data have "));
    EXPECT_TRUE(says(refusal([](RegionGrid& grid) { grid.posts_hash = 0x1234; }),
                     "the fingerprint of its posts 0000000000001234, but the data have "));
}

TEST(DescriptionCheck, TakesBoxesAcrossTheAntimeridian) {
    RegionGrid grid;
    grid.field = test::rough_field(10.0, 179.9, 61, 241);
    SourceReport& source = grid.sources.emplace_back();
    source.path = "across.tif";
    source.rows = 61;
    source.columns = 241;
    source.lat_spacing_deg = source.lon_spacing_deg = 1.0 / 1200.0;
    source.box = {179.9, 9.95, -179.9, 10.0};
    source.placement = Placement{Fit::same_posts, 0.0, 1, 1};
    const auto checked = check_description(grid, true);
    EXPECT_TRUE(checked.ok()) << checked.error().line();
    source.box.east_deg = 180.1;
    EXPECT_TRUE(check_description(grid, true).ok());
}

}  // namespace
}  // namespace oro
