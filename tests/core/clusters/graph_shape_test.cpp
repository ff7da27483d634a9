// What every cluster graph keeps to, whatever it is built over.
#include <gtest/gtest.h>

#include <cstring>
#include <glm/geometric.hpp>
#include <string>

#include "core/clusters/cluster_split.h"
#include "core/clusters/group_tiling.h"
#include "tests/core/clusters/cluster_terrain.h"

namespace oro {
namespace {

using namespace test;

void expect_limits_and_links(const ClusterGraph& graph) {
    std::size_t next_triangle = 0;
    for (std::uint32_t i = 0; i < graph.clusters.size(); ++i) {
        const Cluster& cluster = graph.clusters[i];
        EXPECT_EQ(cluster.first_triangle, next_triangle);
        next_triangle += cluster.triangles;
        EXPECT_GE(cluster.triangles, 1U);
        EXPECT_LE(cluster.triangles, 128U);
        EXPECT_LE(cluster.vertices, 128U);
        EXPECT_EQ(cluster.vertices, vertex_count(graph.triangles_of(cluster)));
        if (cluster.made_by != no_group) {
            const ClusterGroup& maker = graph.groups.at(cluster.made_by);
            EXPECT_TRUE(i >= maker.first_made && i < maker.first_made + maker.made);
        }
        if (cluster.used_by != no_group) {
            const auto members = graph.members_of(graph.groups.at(cluster.used_by));
            EXPECT_EQ(std::count(members.begin(), members.end(), i), 1);
        }
    }
    EXPECT_EQ(next_triangle, graph.triangles.size());
    std::size_t members = 0, made = 0;
    for (const ClusterGroup& group : graph.groups) {
        members += group.members;
        made += group.made;
        EXPECT_GE(group.members, 1U);
        EXPECT_GE(group.made, 1U);
    }
    EXPECT_EQ(members, graph.members.size());
    const auto leaves = std::count_if(graph.clusters.begin(), graph.clusters.end(),
                                      [](const Cluster& cluster) { return cluster.made_by == no_group; });
    EXPECT_EQ(made + static_cast<std::size_t>(leaves), graph.clusters.size());
}

void expect_growth(const ClusterTerrain& terrain) {
    const ClusterGraph& graph = terrain.graph;
    for (const ClusterGroup& group : graph.groups) {
        EXPECT_GE(group.error_m, 0.0);
        for (const std::uint32_t member : graph.members_of(group)) {
            const Cluster& cluster = graph.clusters[member];
            for (const VertexTriangle& triangle : graph.triangles_of(cluster)) {
                for (const VertexNumber vertex : triangle)
                    EXPECT_LE(
                        glm::distance(terrain.bounds.ecef(terrain.surface.vertex(vertex)).m, group.centre.m),
                        group.radius_m);
            }
            if (cluster.made_by == no_group) continue;
            const ClusterGroup& below = graph.groups[cluster.made_by];
            EXPECT_EQ(below.level + 1, group.level);
            EXPECT_LE(below.error_m, group.error_m);
            EXPECT_LE(glm::distance(below.centre.m, group.centre.m) + below.radius_m, group.radius_m);
        }
    }
}

// Vertices that triangles of two groups have, by level; told by the graph alone.
std::vector<std::set<VertexNumber>> locked_by_level(const ClusterGraph& graph) {
    std::vector<std::set<VertexNumber>> locked(graph.levels.size());
    std::vector<std::map<VertexNumber, std::uint32_t>> seen(graph.levels.size());
    for (const Cluster& cluster : graph.clusters) {
        if (cluster.used_by == no_group) continue;
        const std::size_t level = graph.groups[cluster.used_by].level - 1;
        for (const VertexTriangle& triangle : graph.triangles_of(cluster)) {
            for (const VertexNumber vertex : triangle) {
                const auto known = seen[level].emplace(vertex, cluster.used_by).first;
                if (known->second != cluster.used_by) locked[level].insert(vertex);
            }
        }
    }
    return locked;
}

void expect_no_lock_stays(const ClusterGraph& graph, bool twice_happens) {
    const auto locked = locked_by_level(graph);
    std::size_t twice = 0;
    for (std::size_t level = 0; level < locked.size(); ++level) {
        EXPECT_EQ(locked[level].size(), graph.levels[level].locked);
        for (const VertexNumber vertex : locked[level]) {
            if (level < 1 || !locked[level - 1].contains(vertex)) continue;
            ++twice;
            if (level < 2) continue;
            EXPECT_FALSE(locked[level - 2].contains(vertex)) << vertex << " at level " << level + 1;
        }
    }
    EXPECT_EQ(twice > 0, twice_happens);
}

void expect_sound(const ClusterTerrain& terrain, bool twice_happens) {
    expect_limits_and_links(terrain.graph);
    expect_growth(terrain);
    expect_no_lock_stays(terrain.graph, twice_happens);
}

TEST(ClusterGraph, RoughGround) {
    expect_sound(ClusterTerrain(rough_field(47.0, 8.0, 260, 230)), true);
}

TEST(ClusterGraph, GroundWithHoles) {
    expect_sound(ClusterTerrain(holed_field(200, 190, 4)), true);
}

// Large triangles beside small ones: a coast.
TEST(ClusterGraph, HalfFlatGround) {
    HeightField field = rough_field(47.0, 8.0, 220, 220);
    for (int row = 0; row < 220; ++row) {
        for (int column = 0; column < 220; ++column) {
            if (row + column + static_cast<int>(9.0 * std::sin(0.1 * row)) < 200)
                post_of(field, row, column) = 100.0F;
        }
    }
    expect_sound(ClusterTerrain(std::move(field)), true);
}

// Once the groups of flat ground kept no vertex but those on their borders. Then all borders of the next
// level ran along these, all triangles of the level after that went to one group, and so a cut near the coast
// took the whole sea as it was on the second level.
TEST(ClusterGraph, ASeaIsNotOneGroup) {
    const ClusterTerrain terrain(coast_field(420, 420));
    expect_sound(terrain, true);
    for (const GraphLevel& level : terrain.graph.levels) EXPECT_LE(level.largest_group, 2 * 1152U);
    std::size_t of_the_sea = 0;
    for (const std::uint32_t i : cut_by_metres(terrain.graph, 10.0)) {
        for (const VertexTriangle& triangle : terrain.graph.triangles_of(terrain.graph.clusters[i]))
            of_the_sea += std::all_of(triangle.begin(), triangle.end(), [&](VertexNumber vertex) {
                return terrain.surface.vertex(vertex).steps == 0;
            });
    }
    EXPECT_LT(of_the_sea, 4000U);
}

TEST(ClusterGraph, TinyGrids) {
    for (const auto& [rows, columns] : {std::pair{2, 2}, {2, 4}, {4, 2}, {3, 3}, {9, 10}})
        expect_sound(ClusterTerrain(rough_field(47.0, 8.0, rows, columns)), false);
    const ClusterTerrain quad(rough_field(47.0, 8.0, 2, 2));
    EXPECT_EQ(quad.graph.clusters.size(), 1U);
    EXPECT_EQ(quad.graph.triangles.size(), 2U);
    EXPECT_TRUE(quad.graph.groups.empty());
}

TEST(ClusterGraph, FlatGroundBecomesTwoTriangles) {
    const ClusterTerrain terrain(flat_field(100, 120));
    expect_sound(terrain, true);
    // Flat in height; the ellipsoid's sag under 9 km is 1.6 m, under one post's 93 m 0.2 mm.
    const auto cut = cut_by_metres(terrain.graph, 100.0);
    EXPECT_EQ(triangles_of_cut(terrain.graph, cut), 2U);
    double largest_m = 0.0;
    for (const ClusterGroup& group : terrain.graph.groups) largest_m = std::max(largest_m, group.error_m);
    EXPECT_GT(largest_m, 1.0);
    EXPECT_LT(largest_m, 10.0);
}

// Heights as far apart as they can be.
TEST(ClusterGraph, SpikesAsHighAsHeightsGo) {
    HeightField field = flat_field(70, 70);
    post_of(field, 20, 20) = 5.2e5F;
    post_of(field, 21, 20) = -5.2e5F;
    post_of(field, 69, 69) = 5.2e5F;
    const ClusterTerrain terrain(std::move(field));
    expect_limits_and_links(terrain.graph);
    expect_growth(terrain);
    // What leaves out a spike says so.
    for (const double error_m : {1.0e4, 4.0e5}) {
        std::set<VertexNumber> drawn;
        for (const VertexTriangle& triangle :
             triangles_of(terrain.graph, cut_by_metres(terrain.graph, error_m)))
            drawn.insert(triangle.begin(), triangle.end());
        for (const VertexNumber spike : {20U * 70U + 20U, 21U * 70U + 20U, 69U * 70U + 69U})
            EXPECT_TRUE(drawn.contains(spike)) << spike;
    }
}

// Round the Earth the first and the last column are the same posts: whatever is drawn has all of them.
TEST(ClusterGraph, RoundTheEarthTheSeamStays) {
    const HeightField field = made_field(60.0, -180.0, 0.5, 40, 181, rough_H_m);
    ASSERT_TRUE(field.grid.wraps_longitude());
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    const GridSurface surface(heights, {.wraps_longitude = true});
    const ClusterGraph graph = build_cluster_graph(surface, GridBounds(field.grid, heights.highest_steps));
    for (const double error_m : {0.0, 1.0e4, 1.0e9}) {
        std::set<VertexNumber> drawn;
        for (const VertexTriangle& triangle : triangles_of(graph, cut_by_metres(graph, error_m)))
            drawn.insert(triangle.begin(), triangle.end());
        for (VertexNumber row = 0; row < 40; ++row) {
            EXPECT_TRUE(drawn.contains(row * 181)) << row;
            EXPECT_TRUE(drawn.contains(row * 181 + 180)) << row;
        }
        if (error_m == 1.0e9) {
            EXPECT_LT(drawn.size(), 200U);
        }
    }
}

// The same to the last bit, whatever the number of threads.
TEST(ClusterGraph, DoesNotDependOnThreads) {
    const ClusterTerrain one(holed_field(150, 160, 6), {.threads = 1});
    for (const int threads : {1, 2, 5}) {
        const ClusterTerrain other(holed_field(150, 160, 6), {.threads = threads});
        EXPECT_EQ(one.graph.triangles, other.graph.triangles);
        EXPECT_EQ(one.graph.members, other.graph.members);
        ASSERT_EQ(one.graph.groups.size(), other.graph.groups.size());
        ASSERT_EQ(one.graph.clusters.size(), other.graph.clusters.size());
        for (std::size_t i = 0; i < one.graph.groups.size(); ++i) {
            const ClusterGroup &a = one.graph.groups[i], &b = other.graph.groups[i];
            EXPECT_EQ(a.error_m, b.error_m);
            EXPECT_EQ(a.radius_m, b.radius_m);
            EXPECT_EQ(a.centre.m, b.centre.m);
        }
        EXPECT_EQ(std::memcmp(one.graph.clusters.data(), other.graph.clusters.data(),
                              one.graph.clusters.size() * sizeof(Cluster)),
                  0);
    }
}

// Lines of a level lie apart from those of the two before, by at least a sixth of a tile's side.
TEST(GroupTiling, LinesOfThreeLevelsLieApart) {
    const auto lines = [](const GroupTiling& tiling, bool of_rows, int until) {
        std::vector<int> places;
        const auto tile = [&](int place) {
            const GroupTile at = tiling.tile_of({of_rows ? place : 0, of_rows ? 0 : place, 0});
            return of_rows ? at.row : at.column;
        };
        for (int place = 1; place < until; ++place) {
            if (tile(place) != tile(place - 1)) places.push_back(place);
        }
        return places;
    };
    for (const double kept : {0.5, 0.65, 0.8}) {
        for (int level = 3; level < 16; ++level) {
            for (const bool of_rows : {false, true}) {
                const auto here = lines(GroupTiling(level, kept), of_rows, 20000);
                ASSERT_GT(here.size(), 3U);
                const double side = here[1] - here[0];
                for (const int back : {1, 2}) {
                    for (const int line : lines(GroupTiling(level - back, kept), of_rows, 20000)) {
                        for (const int other : here) {
                            if (std::abs(line - other) > side) continue;
                            EXPECT_GE(std::abs(line - other), side / 8.0) << kept << " " << level;
                        }
                    }
                }
            }
        }
    }
}

TEST(GroupTiling, FirstLevelKeepsLeavesWhole) {
    const GroupTiling tiling(1, 0.65);
    EXPECT_EQ(tiling.tile_of({23, 24, 0}), (GroupTile{0, 1}));
    EXPECT_EQ(tiling.tile_of({24, 23, 0}), (GroupTile{1, 0}));
    EXPECT_EQ(tiling.tile_of({-1, 47, 0}), (GroupTile{-1, 1}));
}

TEST(ClusterSplit, ManyTrianglesThatDoNotTouchAreCutByTheirVertices) {
    const ClusterTerrain terrain(flat_field(60, 60));
    std::vector<VertexTriangle> apart;
    for (VertexNumber row = 0; row + 1 < 60; row += 2) {
        for (VertexNumber column = 0; column + 1 < 8; column += 2) {
            const VertexNumber corner = row * 60 + column;
            apart.push_back({corner, corner + 1, corner + 61});
        }
    }
    ASSERT_EQ(apart.size(), 120U);
    std::vector<std::size_t> counts;
    split_to_clusters(terrain.surface, apart, counts);
    EXPECT_GT(counts.size(), 2U);
    std::size_t first = 0;
    for (const std::size_t count : counts) {
        EXPECT_LE(vertex_count(std::span(apart).subspan(first, count)), 128U);
        first += count;
    }
    EXPECT_EQ(first, 120U);
}

}  // namespace
}  // namespace oro
