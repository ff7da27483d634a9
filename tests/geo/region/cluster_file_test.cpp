// The cluster graph of real ground in a file and back, to the bit.
#include "core/cluster_file/cluster_file.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstring>
#include <optional>

#include "core/clusters/graph_builder.h"
#include "core/surface/grid_surface.h"
#include "core/terrain/drawn_heights.h"
#include "tests/geo/written_terrain.h"
#include "tests/support/open_grid.h"
#include "tests/support/test_data.h"

namespace oro {
namespace {

using namespace test;

// most_bits: a triangle above the leaves, records and all.
void expect_back(const std::filesystem::path& source, double most_bits,
                 const std::optional<BoundingBox>& box = std::nullopt) {
    RegionRequest request = request_for({source.string()});
    request.box = box;
    const auto region = test::open_grid(request);
    ASSERT_TRUE(region.ok()) << region.error().line();
    const HeightField& field = region->field;
    const DrawnHeights heights = drawn_heights(field, 1.0, 2);
    const GridSurface surface(heights);
    const GridBounds bounds(field.grid, heights.highest_steps);
    const ClusterGraph graph = build_cluster_graph(surface, bounds, {.threads = 2});
    const std::string path = (scratch_folder() / "a.oroc").string();
    const auto written = write_cluster_graph(path, graph, {heights.rows, heights.columns}, 0, false, 2);
    ASSERT_TRUE(written.ok()) << written.error().line();
    const auto file = ClusterFile::open(path);
    ASSERT_TRUE(file.ok()) << file.error().line();
    std::printf("%.2f bits\n",
                8.0 * static_cast<double>(file->bytes()) / static_cast<double>(file->outline().triangles));
    EXPECT_LT(8.0 * static_cast<double>(file->bytes()),
              most_bits * static_cast<double>(file->outline().triangles));
    const auto read = file->graph(surface, bounds, 2);
    ASSERT_TRUE(read.ok()) << read.error().line();
    EXPECT_EQ(read->triangles, graph.triangles);
    EXPECT_EQ(read->members, graph.members);
    ASSERT_EQ(read->clusters.size(), graph.clusters.size());
    EXPECT_EQ(
        std::memcmp(read->clusters.data(), graph.clusters.data(), graph.clusters.size() * sizeof(Cluster)),
        0);
    ASSERT_EQ(read->groups.size(), graph.groups.size());
    for (std::size_t i = 0; i < graph.groups.size(); ++i) {
        EXPECT_EQ(read->groups[i].error_m, graph.groups[i].error_m);
        EXPECT_EQ(read->groups[i].centre.m, graph.groups[i].centre.m);
        EXPECT_EQ(read->groups[i].radius_m, graph.groups[i].radius_m);
    }
}

// As measured: 6.4 bits.
TEST(ClusterFileOfRealGround, Jacksboro) {
    expect_back(bundled_data() / "jacksboro.tif", 6.6);
}

// As measured: 6.2 bits, 3.97 MB of the whole tile, and 6.1 bits of its middle, which is held here.
TEST(ClusterFileOfRealGround, N46E008) {
    const auto tile = real_data("alps/N46E008.SRTMGL3.hgt.zip");
    if (!tile) GTEST_SKIP() << "needs N46E008";
    expect_back(*tile, 6.4, BoundingBox{8.25, 46.25, 8.75, 46.75});
}

}  // namespace
}  // namespace oro
