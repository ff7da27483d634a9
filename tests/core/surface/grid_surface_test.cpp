// Differences between a straight line or a triangle and the grid under it.
#include <gtest/gtest.h>

#include "tests/core/clusters/cluster_terrain.h"

namespace oro {
namespace {

using namespace test;

DrawnHeights heights_of(int rows, int columns, std::vector<std::int32_t> steps) {
    DrawnHeights heights;
    heights.rows = rows;
    heights.columns = columns;
    heights.steps = std::move(steps);
    heights.highest_steps = *std::max_element(heights.steps.begin(), heights.steps.end());
    return heights;
}

constexpr double no_limit = OriginalSurface::no_limit;

// By hand: from the south-west to the north-east of one cell the line passes 10 (the mean of 0 and 20) where
// the cell's diagonal is at 3 (the mean of 2 and 4).
TEST(GridSurface, AFlippedDiagonalCostsWhatItIsOffInTheMiddle) {
    const DrawnHeights heights = heights_of(2, 2, {2, 20, 0, 4});
    const GridSurface surface(heights);
    EXPECT_EQ(surface.edge_difference(surface.vertex(2), surface.vertex(1), no_limit), 7.0);
    EXPECT_EQ(surface.edge_difference(surface.vertex(0), surface.vertex(3), no_limit), 0.0);
    EXPECT_EQ(surface.edge_difference(surface.vertex(0), surface.vertex(1), no_limit), 0.0);
    EXPECT_EQ(surface.edge_difference(surface.vertex(2), surface.vertex(0), no_limit), 0.0);
}

// From (0, 0) to (1, 2), flat but for (0, 1) at 12 and (1, 1) at -8: the line meets column 1 half way between
// them, at 2, and the diagonal from (0, 0) at its start, that from (0, 1) to (1, 2) at its end.
TEST(GridSurface, CrossingsOfAColumn) {
    const DrawnHeights heights = heights_of(2, 3, {0, 12, 0, 0, -8, 0});
    const GridSurface surface(heights);
    EXPECT_EQ(surface.edge_difference({0, 0, 0}, {1, 2, 0}, no_limit), 2.0);
    EXPECT_EQ(surface.edge_difference({1, 2, 0}, {0, 0, 0}, no_limit), 2.0);
    // Along a row: posts.
    EXPECT_EQ(surface.edge_difference({0, 0, 0}, {0, 2, 0}, no_limit), 12.0);
    // From (1, 0) to (0, 2): column 1 at its middle; the diagonals at a third (2 / 3 along the first: 2/3 of
    // -8) and two thirds (12 + 1/3 * -12 = 8).
    EXPECT_NEAR(surface.edge_difference({1, 0, 0}, {0, 2, 0}, no_limit), 8.0, 1.0e-12);
}

TEST(GridSurface, PostsWithinATriangle) {
    const DrawnHeights heights = heights_of(3, 3, {0, 0, 0, 0, 7, 0, 0, 0, 0});
    const GridSurface surface(heights);
    EXPECT_EQ(surface.inner_difference({0, 0, 0}, {1, 2, 0}, {2, 1, 0}, no_limit), 7.0);
    // Tilted: the plane has 4 there, a third of the corners' 12.
    const DrawnHeights tilted = heights_of(3, 3, {12, 0, 0, 0, 7, 0, 0, 0, 0});
    EXPECT_NEAR(GridSurface(tilted).inner_difference({0, 0, 12}, {1, 2, 0}, {2, 1, 0}, no_limit), 3.0,
                1.0e-12);
    EXPECT_EQ(surface.inner_difference({0, 0, 0}, {0, 1, 0}, {1, 1, 0}, no_limit), 0.0);
}

// Lines between any two posts, walked in small steps.
TEST(GridSurface, LinesAgainstSmallSteps) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 23, 31));
    std::mt19937_64 random(77);
    for (int i = 0; i < 400; ++i) {
        const auto post = [&] {
            return terrain.surface.vertex(static_cast<VertexNumber>(random() % (23 * 31)));
        };
        const SurfaceVertex a = post(), b = post();
        if (a.row == b.row && a.column == b.column) continue;
        const double difference_m = terrain.surface.edge_difference(a, b, no_limit);
        double found = 0.0;
        constexpr int parts = 27720;  // of all numbers of crossings up to 12
        for (int j = 1; j < parts; j += i % 8 == 0 ? 1 : 11) {
            const double at = static_cast<double>(j) / parts;
            const double line = a.steps + at * (static_cast<double>(b.steps) - a.steps);
            const auto original =
                terrain.original(a.row + at * (b.row - a.row), a.column + at * (b.column - a.column));
            ASSERT_TRUE(original);
            found = std::max(found, std::abs(*original - line));
        }
        EXPECT_LE(found, difference_m + 1.0e-6) << "seed 77, line " << i;
        EXPECT_GE(found, difference_m * 0.98) << "seed 77, line " << i;
        // The limit only ends it sooner.
        const double limited = terrain.surface.edge_difference(a, b, 0.5 * difference_m);
        EXPECT_LE(limited, difference_m);
        EXPECT_GE(limited, 0.5 * difference_m);
    }
}

TEST(GridSurface, TrianglesAgainstEveryPost) {
    const ClusterTerrain terrain(rough_field(47.0, 8.0, 29, 26));
    std::mt19937_64 random(78);
    int asked = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto post = [&] {
            return terrain.surface.vertex(static_cast<VertexNumber>(random() % (29 * 26)));
        };
        const SurfaceVertex a = post(), b = post(), c = post();
        const std::int64_t whole = twice_area(a, b, c);
        if (whole <= 0) continue;
        ++asked;
        double inner = 0.0, with_edges = 0.0;
        for (VertexNumber number = 0; number < 29 * 26; ++number) {
            const SurfaceVertex at = terrain.surface.vertex(number);
            const std::int64_t of_a = twice_area(b, c, at), of_b = twice_area(c, a, at),
                               of_c = twice_area(a, b, at);
            if (of_a < 0 || of_b < 0 || of_c < 0) continue;
            const double plane = (static_cast<double>(of_a) * a.steps + static_cast<double>(of_b) * b.steps +
                                  static_cast<double>(of_c) * c.steps) /
                                 static_cast<double>(whole);
            const double off = std::abs(at.steps - plane);
            with_edges = std::max(with_edges, off);
            if (of_a > 0 && of_b > 0 && of_c > 0) inner = std::max(inner, off);
        }
        const double difference_m = terrain.surface.inner_difference(a, b, c, no_limit);
        EXPECT_GE(difference_m, inner - 1.0e-6) << "seed 78, triangle " << i;
        EXPECT_LE(difference_m, with_edges + 1.0e-6) << "seed 78, triangle " << i;
    }
    EXPECT_GT(asked, 1000);
}

TEST(GridSurface, LeavesAreNodesWithoutWhatIsVoid) {
    HeightField field = flat_field(12, 20);
    post_of(field, 3, 3) = void_height_m;
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    const GridSurface surface(heights);
    const auto leaves = surface.leaves();
    // 11 x 19 quads: 2 x 3 nodes. The void post takes the six triangles around it.
    ASSERT_EQ(leaves.size(), 6U);
    EXPECT_EQ(leaves[0].size(), 128U - 6U);
    EXPECT_EQ(leaves[1].size(), 128U);
    EXPECT_EQ(leaves[2].size(), 2U * 8U * 3U);
    EXPECT_EQ(leaves[5].size(), 2U * 3U * 3U);
    EXPECT_EQ(leaves[1][0], (VertexTriangle{8, 29, 28}));
    EXPECT_EQ(leaves[1][1], (VertexTriangle{8, 9, 29}));
}

}  // namespace
}  // namespace oro
