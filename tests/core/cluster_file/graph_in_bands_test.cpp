// A graph that is built some levels at a time, with a file in between: the same bytes as in one go.
#include "tests/core/cluster_file/made_cluster_file.h"

namespace oro {
namespace {

using namespace test;

// Stops after each of some levels, writes, reads, and goes on from what was read.
std::string bytes_in_bands(const ClusterTerrain& terrain, const GridSurface& surface,
                           const std::vector<int>& stops, int threads) {
    const fs::path folder = scratch_folder();
    ClusterGraph graph;
    for (const int stop : stops) {
        graph = continue_cluster_graph(surface, terrain.bounds, std::move(graph),
                                       {.threads = threads, .last_level = stop});
        const fs::path path = folder / ("until-" + std::to_string(stop));
        const auto written = write_cluster_graph(path, graph, posts_of(terrain), cluster_fingerprint, true);
        EXPECT_TRUE(written.ok()) << written.error().line();
        const auto file = ClusterFile::open(path);
        EXPECT_TRUE(file.ok()) << file.error().line();
        EXPECT_LE(file->outline().levels.size(), static_cast<std::size_t>(stop));
        const auto read = file->graph(surface, terrain.bounds);
        EXPECT_TRUE(read.ok()) << read.error().line();
        if (!read.ok()) return "";
        graph = *read;
    }
    return bytes_of(folder / ("until-" + std::to_string(stops.back())));
}

void expect_same_in_bands(const ClusterTerrain& terrain, const GridSurface& surface) {
    const std::string in_one_go = bytes_in_bands(terrain, surface, {80}, 2);
    ASSERT_FALSE(in_one_go.empty());
    const std::vector<std::vector<int>> bands = {{1, 80}, {2, 80}, {3, 6, 80}, {5, 80}, {80, 80}};
    for (const auto& stops : bands)
        EXPECT_TRUE(bytes_in_bands(terrain, surface, stops, 1) == in_one_go) << stops.front();
}

TEST(GraphInBands, RoughGround) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 260, 250));
    ASSERT_GE(terrain.graph.levels.size(), 8U);
    expect_same_in_bands(terrain, terrain.surface);
}

TEST(GraphInBands, GroundWithHoles) {
    const ClusterTerrain terrain(holed_field(190, 200, 7));
    expect_same_in_bands(terrain, terrain.surface);
}

TEST(GraphInBands, EachLevelByItself) {
    const ClusterTerrain terrain(holed_field(120, 110, 3));
    std::vector<int> stops;
    for (int level = 1; level <= static_cast<int>(terrain.graph.levels.size()) + 1; ++level)
        stops.push_back(level);
    EXPECT_TRUE(bytes_in_bands(terrain, terrain.surface, stops, 2) ==
                bytes_in_bands(terrain, terrain.surface, {80}, 1));
}

// What is whole is still known after a break.
TEST(GraphInBands, WindowOfARegion) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 240, 230), {.threads = 2, .last_level = 1});
    const GridSurface window(terrain.heights, {0, 0, true, false, true, true, false});
    const ClusterGraph graph = build_cluster_graph(window, terrain.bounds);
    ASSERT_GE(graph.levels.size(), 4U);
    const auto whole = std::count_if(graph.groups.begin(), graph.groups.end(),
                                     [](const ClusterGroup& group) { return group.complete; });
    EXPECT_GT(whole, 100);
    EXPECT_LT(whole, static_cast<std::ptrdiff_t>(graph.groups.size()) - 20);
    expect_same_in_bands(terrain, window);
}

}  // namespace
}  // namespace oro
