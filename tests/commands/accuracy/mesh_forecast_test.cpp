// What plan tells of blocks and clusters, of regions of any size.
#include "apps/accuracy/mesh_forecast.h"
#include "geo/opening/open_region.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>

#include "core/baked/bake.h"
#include "core/baked/file_pages.h"
#include "core/cluster_windows/windowed_graph.h"
#include "geo/region/region_description.h"
#include "geo/together/baked_parts.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

namespace fs = std::filesystem;

Result<Region> opened(const fs::path& path) {
    RegionRequest request;
    request.paths = {path.string()};
    return open_region(request);
}

// The bundled region, its graph built window by window as those of large regions are.
Result<void> bake_in_small_windows(const fs::path& path) {
    ORO_TRY(const Region region, opened(test::bundled_data() / "jacksboro.tif"));
    const fs::path folder = test::scratch_folder();
    BakeOptions grid;
    grid.path = folder / "grid.oro";
    grid.fingerprint = 5;
    grid.description = region_description(region.grids[0]);
    ORO_CHECK(bake_region(region.grids[0].field, grid));
    WindowedBake clusters;
    clusters.path = folder / "grid.oroc";
    clusters.fingerprint = grid.fingerprint;
    clusters.threads = 2;
    clusters.stages = {{3, 70'000}};
    ORO_CHECK(bake_in_windows(region.grids[0].field, clusters));
    return join_parts(path, false, std::array<ContainerPart, 2>{{{grid.path, 0}, {clusters.path, 0}}});
}

View towards_the_fault() {
    View view;
    view.camera.eye = {36.53, -84.35, 1500.0};
    view.camera.attitude = {70.0, -15.0, 0.0};
    view.camera.width_px = 240, view.camera.height_px = 160;
    return view;
}

void expect_same(const MeshForecast& a, const MeshForecast& b) {
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.worst_m, b.worst_m);
    EXPECT_EQ(a.worst_px, b.worst_px);
}

TEST(MeshForecasts, AreTheSameOfPostsReadPageByPage) {
    const fs::path path = test::scratch_folder() / "region.oro";
    const auto baked = bake_in_small_windows(path);
    ASSERT_TRUE(baked.ok()) << baked.error().line();
    const auto region = opened(path);
    ASSERT_TRUE(region.ok()) << region.error().line();
    ASSERT_TRUE(region->grids[0].clusters);
    const auto pages = pages_of_file(region->grids[0].file);
    const auto in_memory = mesh_forecasts(towards_the_fault(), *region, *pages);
    const auto page_by_page = mesh_forecasts(towards_the_fault(), *region, *pages, 1000);
    ASSERT_TRUE(in_memory.ok() && page_by_page.ok() && *in_memory && *page_by_page);
    expect_same((*in_memory)->blocks, (*page_by_page)->blocks);
    expect_same((*in_memory)->clusters, (*page_by_page)->clusters);
    EXPECT_GT((*page_by_page)->clusters.triangles, 1000U);
    EXPECT_LT((*page_by_page)->clusters.triangles, (*page_by_page)->blocks.triangles);
    EXPECT_LE((*page_by_page)->clusters.worst_px, 1.0);
}

TEST(MeshForecasts, AreNotThereWithoutClusters) {
    const auto region = opened(test::bundled_data() / "jacksboro.tif");
    ASSERT_TRUE(region.ok());
    const auto pages = pages_in_memory(region->grids[0].field, 1.0, 2);
    const auto none = mesh_forecasts(towards_the_fault(), *region, *pages);
    ASSERT_TRUE(none.ok());
    EXPECT_FALSE(none->has_value());
}

}  // namespace
}  // namespace oro
