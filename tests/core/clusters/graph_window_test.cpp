// A window of a region: its whole groups are the region's own, to the bit.
#include <gtest/gtest.h>

#include <string>

#include "tests/core/clusters/cluster_terrain.h"

namespace oro {
namespace {

using namespace test;

DrawnHeights part_of(const DrawnHeights& heights, int first_row, int first_column, int rows, int columns) {
    DrawnHeights part;
    part.rows = rows;
    part.columns = columns;
    for (int row = first_row; row < first_row + rows; ++row)
        part.steps.insert(part.steps.end(), heights.row(row) + first_column,
                          heights.row(row) + first_column + columns);
    part.highest_steps = heights.highest_steps;
    if (heights.diagonals)
        part.diagonals = heights.diagonals->part(first_row, first_column, rows - 1, columns - 1);
    return part;
}

// Its triangles by places, in order, its error and its sphere's radius.
using GroupContent = std::pair<std::vector<std::array<std::int32_t, 6>>, std::array<double, 2>>;
GroupContent content_of(const ClusterGraph& graph, const OriginalSurface& surface,
                        const ClusterGroup& group) {
    GroupContent all{{}, {group.error_m, group.radius_m}};
    for (std::uint32_t i = group.first_made; i < group.first_made + group.made; ++i) {
        for (const VertexTriangle& triangle : graph.triangles_of(graph.clusters[i])) {
            const SurfaceVertex a = surface.vertex(triangle[0]), b = surface.vertex(triangle[1]),
                                c = surface.vertex(triangle[2]);
            all.first.push_back({a.row, a.column, b.row, b.column, c.row, c.column});
        }
    }
    // How what a group made is split is known where the groups that use it are.
    std::sort(all.first.begin(), all.first.end());
    return all;
}

// Levels that have whole groups, and how many groups are whole.
std::pair<std::uint32_t, std::size_t> expect_groups_of(const ClusterTerrain& region, const GridWindow& window,
                                                       int rows, int columns) {
    const DrawnHeights heights =
        part_of(region.heights, window.first_row, window.first_column, rows, columns);
    const GridSurface surface(heights, window);
    const ClusterGraph graph = build_cluster_graph(surface, region.bounds, {.threads = 2});
    std::set<std::pair<std::uint32_t, GroupContent>> groups;
    for (const ClusterGroup& group : region.graph.groups)
        groups.insert({group.level, content_of(region.graph, region.surface, group)});
    std::uint32_t levels = 0;
    std::size_t whole = 0;
    for (const ClusterGroup& group : graph.groups) {
        if (!group.complete) continue;
        ++whole;
        levels = std::max(levels, group.level);
        EXPECT_TRUE(groups.contains({group.level, content_of(graph, surface, group)}))
            << "level " << group.level;
    }
    return {levels, whole};
}

TEST(GraphWindow, WholeGroupsAreThoseOfTheRegion) {
    const ClusterTerrain region(holed_field(500, 520, 3));
    for (const ClusterGroup& group : region.graph.groups) EXPECT_TRUE(group.complete);
    const auto [levels, whole] = expect_groups_of(region, {104, 96, true, true, true, true}, 300, 290);
    EXPECT_EQ(levels, 5U);
    EXPECT_GT(whole, 100U);
}

TEST(GraphWindow, AtTheRegionsOwnRimNothingIsOpen) {
    const ClusterTerrain region(rough_field(47.0, 8.0, 500, 400));
    const auto [levels, whole] = expect_groups_of(region, {0, 0, false, false, true, false}, 321, 400);
    EXPECT_GE(levels, 5U);
    EXPECT_GT(whole, 200U);
}

// Both halves, with what they share, have every group of the first levels between them.
TEST(GraphWindow, OverlappingWindowsHaveAllOfTheFirstLevels) {
    const ClusterTerrain region(rough_field(47.0, 8.0, 420, 200));
    std::map<std::uint32_t, std::set<GroupContent>> found;
    for (const GridWindow& window :
         {GridWindow{0, 0, false, false, true, false}, GridWindow{120, 0, true, false, false, false}}) {
        const DrawnHeights heights = part_of(region.heights, window.first_row, 0, 300, 200);
        const GridSurface surface(heights, window);
        const ClusterGraph graph = build_cluster_graph(surface, region.bounds);
        for (const ClusterGroup& group : graph.groups) {
            if (group.complete) found[group.level].insert(content_of(graph, surface, group));
        }
    }
    for (const std::uint32_t level : {1U, 2U, 3U})
        EXPECT_EQ(found[level].size(), region.graph.levels[level - 1].groups) << level;
}

}  // namespace
}  // namespace oro
