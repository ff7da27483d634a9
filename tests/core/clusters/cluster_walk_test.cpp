// The order of a cluster's triangles.
#include <gtest/gtest.h>

#include "core/clusters/cluster_split.h"
#include "tests/core/clusters/cluster_terrain.h"

namespace oro {
namespace {

using namespace test;

// Two triangles of a square, and one apart. 0 1 / 2 3 is the square; 4 5 6 lie beside it.
TEST(ClusterWalk, FromTheLeastCornerAcrossEdges) {
    const std::vector<LocalTriangle> triangles = {{6, 4, 5}, {3, 2, 0}, {1, 3, 0}};
    EXPECT_EQ(walk_order(triangles, 7), (std::vector<LocalTriangle>{{0, 1, 3}, {0, 3, 2}, {4, 5, 6}}));
}

TEST(ClusterWalk, TellsWhatIsOpen) {
    ClusterWalk walk;
    walk.start(4);
    EXPECT_FALSE(walk.next().has_value());
    walk.add(0, 1, 3);
    EXPECT_EQ(walk.open_edges(0), 2);
    EXPECT_EQ(walk.open_edges(2), 0);
    EXPECT_FALSE(walk.is_coded(2));
    EXPECT_FALSE(walk.may_be(1, 3, 2));  // has the edge from 1 to 3 already
    EXPECT_TRUE(walk.may_be(3, 1, 2));
    const auto edge = walk.next();
    ASSERT_TRUE(edge.has_value());
    EXPECT_EQ(edge->from, 0);
    EXPECT_EQ(edge->to, 1);
    walk.close(*edge);
    EXPECT_FALSE(walk.may_be(1, 0, 2));
    EXPECT_EQ(walk.open_edges(0), 1);
    walk.add(0, 3, 2);
    EXPECT_EQ(walk.open_edges(0), 1);
    EXPECT_EQ(walk.open_edges(3), 2);
}

// Whatever the order and the first corners were before; and all the same triangles.
TEST(ClusterWalk, DependsOnTheTrianglesAlone) {
    const ClusterTerrain terrain(holed_field(90, 90, 8));
    std::mt19937_64 random(5);
    const auto least_first = [](VertexTriangle t) {
        std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
        return t;
    };
    std::size_t above = 0;
    for (const Cluster& cluster : terrain.graph.clusters) {
        const auto of_cluster = terrain.graph.triangles_of(cluster);
        std::vector<VertexTriangle> triangles(of_cluster.begin(), of_cluster.end()), mixed = triangles;
        std::shuffle(mixed.begin(), mixed.end(), random);
        for (VertexTriangle& t : mixed) std::rotate(t.begin(), t.begin() + random() % 3, t.end());
        put_in_walk_order(terrain.surface, mixed);
        if (cluster.made_by != no_group) {
            ++above;
            EXPECT_EQ(mixed, triangles);  // as the builder made it
        }
        for (auto* all : {&mixed, &triangles}) {
            std::transform(all->begin(), all->end(), all->begin(), least_first);
            std::sort(all->begin(), all->end());
        }
        EXPECT_EQ(mixed, triangles);
    }
    EXPECT_GT(above, 50U);
}

}  // namespace
}  // namespace oro
