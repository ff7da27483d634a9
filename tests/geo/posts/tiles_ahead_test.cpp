#include "geo/posts/tiles_ahead.h"

#include <gtest/gtest.h>

#include "geo/files/raster_library.h"
#include "geo/files/source_paths.h"
#include "geo/region/region_grid.h"
#include "geo/sources/hgt_source.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

Source tile(const std::filesystem::path& file, const HeightOfPost& height) {
    start_gdal();
    write_hgt(file, 1201, height);
    return inspect_hgt(find_sources({file.string()})->at(0)).value();
}

TEST(TilesAhead, ReadsWhatIsReadWithoutThem) {
    const std::filesystem::path folder = scratch_folder();
    const std::array sources{
        tile(folder / "N46E008.hgt", [](int r, int c) { return (r * 7 + c * 13) % 4000; }),
        tile(folder / "N46E009.hgt", [](int r, int c) { return (r * 11 + c * 3) % 4000; })};
    const PostGrid grid = region_grid(sources, *region_extent(sources, {})).value();
    TilesAhead ahead(grid);
    EXPECT_TRUE(ahead.has_room());
    ahead.begin(sources[1], 0);
    EXPECT_FALSE(ahead.take(sources[0], 0)) << "was never begun";
    EXPECT_FALSE(ahead.take(sources[1], 1)) << "was begun at another turn";
    const auto taken = ahead.take(sources[1], 0);
    ASSERT_TRUE(taken && taken->ok());
    SourceOnGrid alone = SourceOnGrid::create(sources[1], grid, 0).value();
    ASSERT_TRUE(alone.read(alone.rect().first_row, alone.rect().rows).ok());
    EXPECT_EQ((*taken)->block().height_m, alone.block().height_m);
    EXPECT_EQ((*taken)->rect().first_column, 1200);
    EXPECT_FALSE(ahead.take(sources[1], 0)) << "was taken already";
    EXPECT_TRUE(ahead.has_room());
}

TEST(TilesAhead, HandOnWhatIsWrong) {
    const std::filesystem::path folder = scratch_folder();
    const std::array sources{tile(folder / "N46E008.hgt", [](int, int) { return 1; })};
    const PostGrid grid = region_grid(sources, *region_extent(sources, {})).value();
    std::filesystem::resize_file(folder / "N46E008.hgt", 1201 * 2 * 600 + 5);
    TilesAhead ahead(grid);
    ahead.begin(sources[0], 0);
    const auto taken = ahead.take(sources[0], 0);
    ASSERT_TRUE(taken && !taken->ok());
    EXPECT_NE(taken->error().line().find("ends in post row 600"), std::string::npos) << taken->error().line();
}

TEST(TilesAhead, LeaveOtherFormatsToBeReadInTheirTurn) {
    const std::filesystem::path folder = scratch_folder();
    Source raster = tile(folder / "N46E008.hgt", [](int, int) { return 1; });
    raster.kind = SourceKind::raster;
    const PostGrid grid =
        region_grid(std::span(&raster, 1), *region_extent(std::span(&raster, 1), {})).value();
    TilesAhead ahead(grid);
    ahead.begin(raster, 0);
    EXPECT_FALSE(ahead.take(raster, 0));
}

}  // namespace
}  // namespace oro
