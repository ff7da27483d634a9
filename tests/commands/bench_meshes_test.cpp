// The meshes of orograph-bench-triangles: each against brute force, and small ones that can be drawn on
// paper.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include "apps/bench/bench_blocks.h"
#include "apps/bench/bench_rtin.h"
#include "apps/bench/bench_tin.h"
#include "core/surface/grid_surface.h"
#include "tests/core/lod/pyramid_region.h"

namespace oro {
namespace {

// From metres.
DrawnHeights heights_of(int rows, int columns, const std::function<double(int, int)>& h_m) {
    DrawnHeights heights;
    heights.rows = rows;
    heights.columns = columns;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column)
            heights.steps.push_back(height_steps(h_m(row, column)));
    }
    return heights;
}

DrawnHeights spike(int posts, int at_row, int at_column) {
    return heights_of(posts, posts, [=](int row, int column) {
        return row == at_row && column == at_column ? 100.0 : 0.0;
    });
}

DrawnHeights random_heights(std::mt19937_64& random, int rows, int columns) {
    std::uniform_real_distribution<double> noise(-40.0, 40.0);
    return heights_of(rows, columns, [&](int row, int column) {
        return 200.0 * std::sin(0.31 * row) * std::cos(0.23 * column) + noise(random);
    });
}

// Covers the rectangle once and has no crack: every triangle clockwise, their areas sum up to the
// rectangle's, and each edge has its twin but on the rectangle's border.
void expect_whole(const std::vector<MeshTriangle>& mesh, int rows, int columns) {
    using Edge = std::array<int, 4>;
    std::set<Edge> edges;
    std::int64_t area = 0;
    for (const MeshTriangle& triangle : mesh) {
        const std::int64_t own = twice_area(triangle[0], triangle[1], triangle[2]);
        ASSERT_GT(own, 0);
        area += own;
        for (std::size_t i = 0; i < 3; ++i) {
            const MeshPost &a = triangle[i], &b = triangle[(i + 1) % 3];
            ASSERT_TRUE(edges.insert({a.row, a.column, b.row, b.column}).second) << "used twice";
        }
    }
    EXPECT_EQ(area, std::int64_t{2} * (rows - 1) * (columns - 1));
    for (const auto& [row, column, to_row, to_column] : edges) {
        if (edges.contains({to_row, to_column, row, column})) continue;
        const bool border = (row == to_row && (row == 0 || row == rows - 1)) ||
                            (column == to_column && (column == 0 || column == columns - 1));
        ASSERT_TRUE(border) << row << "," << column << " - " << to_row << "," << to_column;
    }
}

// No corner of the mesh lies inside the circle around any of its triangles, by the circle's centre in long
// double; points within 1e-9 of the radius are on it.
void expect_delaunay(const std::vector<MeshTriangle>& mesh) {
    std::set<std::pair<int, int>> corners;
    for (const MeshTriangle& triangle : mesh) {
        for (const MeshPost& post : triangle) corners.insert({post.row, post.column});
    }
    for (const auto& [a, b, c] : mesh) {
        const long double bx = b.column - a.column, by = b.row - a.row;
        const long double cx = c.column - a.column, cy = c.row - a.row;
        const long double d = 2.0L * (bx * cy - by * cx);
        const long double x = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d;
        const long double y = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d;
        const long double radius = std::hypot(x, y);
        for (const auto& [row, column] : corners)
            ASSERT_GE(std::hypot(column - a.column - x, row - a.row - y), radius * (1.0L - 1e-9L));
    }
}

TEST(BenchTin, APlaneTakesTwoTriangles) {
    const DrawnHeights heights =
        heights_of(40, 57, [](int row, int column) { return 3.0 * row - 7.0 * column + 100.0; });
    GreedyTin tin(heights);
    tin.refine(0.0);
    EXPECT_EQ(tin.triangles(), 2U);
    EXPECT_EQ(check_mesh(heights, tin.mesh(), 0.0).largest_error_m, 0.0);
}

// On paper: the spike cuts the diagonal of 3 x 3 posts, so both triangles in two. On the northern border it
// cuts one triangle in two; the middle post then lies on the slope between the spike and the southern border,
// 50 m below it, and going on takes it in, which adds two.
TEST(BenchTin, SpikesOnEdges) {
    const DrawnHeights middle = spike(3, 1, 1), border = spike(3, 0, 1);
    GreedyTin of_middle(middle), of_border(border);
    of_middle.refine(10.0);
    EXPECT_EQ(of_middle.triangles(), 4U);
    of_border.refine(60.0);
    EXPECT_EQ(of_border.triangles(), 3U);
    EXPECT_DOUBLE_EQ(check_mesh(border, of_border.mesh(), 60.0).largest_error_m, 50.0);
    of_border.refine(10.0);
    EXPECT_EQ(of_border.triangles(), 5U);
    expect_whole(of_border.mesh(), 3, 3);
    expect_delaunay(of_border.mesh());
}

TEST(BenchTin, IsDelaunayAndWithinItsErrorOnRandomFields) {
    const unsigned seed = 71;
    std::mt19937_64 random(seed);
    std::size_t triangles = 0;
    for (int i = 0; i < 30; ++i) {
        const int rows = 2 + static_cast<int>(random() % 30), columns = 2 + static_cast<int>(random() % 30);
        const DrawnHeights heights = random_heights(random, rows, columns);
        GreedyTin tin(heights);
        std::size_t before = 0;
        for (const double error_m : {150.0, 60.0, 20.0, 0.0}) {
            tin.refine(error_m);
            const std::vector<MeshTriangle> mesh = tin.mesh();
            ASSERT_EQ(mesh.size(), tin.triangles());
            ASSERT_GE(mesh.size(), before);
            before = mesh.size();
            ASSERT_NO_FATAL_FAILURE(expect_whole(mesh, rows, columns)) << "seed " << seed << " field " << i;
            ASSERT_NO_FATAL_FAILURE(expect_delaunay(mesh)) << "seed " << seed << " field " << i;
            const MeshCheck check = check_mesh(heights, mesh, error_m);
            ASSERT_EQ(check.posts_beyond + check.posts_uncovered, 0U);
            GreedyTin at_once(heights);
            at_once.refine(error_m);
            ASSERT_EQ(at_once.mesh(), mesh);
            triangles += mesh.size();
        }
    }
    std::printf("seed %u: %zu triangles\n", seed, triangles);
    EXPECT_GT(triangles, 10000U);
}

// One cell: from its south-west to its north-east post an edge passes the cell's diagonal 7 m off.
TEST(BenchMesh, WorstPlaceOfAFlippedDiagonalIsInItsMiddle) {
    const DrawnHeights heights =
        heights_of(2, 2, [](int row, int column) { return row == column ? 2.0 + 2.0 * row : 20.0 * column; });
    const WorstPlace worst = worst_place(heights, {MeshPost{0, 0}, {0, 1}, {1, 0}});
    EXPECT_DOUBLE_EQ(worst.error_m, 7.0);
    EXPECT_EQ(worst.from, (MeshPost{0, 0}));
    EXPECT_EQ(worst.to, (MeshPost{1, 1}));
    EXPECT_EQ(worst_place(heights, {MeshPost{0, 0}, {0, 1}, {1, 1}}).error_m, 0.0);
    // The triangulation of four posts takes the better diagonal.
    GreedyTin tin(heights, true);
    tin.refine(0.0);
    EXPECT_EQ(tin.triangles(), 2U);
    for (const MeshTriangle& triangle : tin.mesh()) EXPECT_EQ(worst_place(heights, triangle).error_m, 0.0);
}

// Held to every place: asked of the surface that clusters are held against.
TEST(BenchTin, IsWithinItsErrorAtEveryPlaceOfRandomFields) {
    constexpr std::uint64_t seed = 515;
    std::mt19937_64 random(seed);
    for (int i = 0; i < 12; ++i) {
        const int rows = 2 + static_cast<int>(random() % 40), columns = 2 + static_cast<int>(random() % 40);
        const DrawnHeights heights = random_heights(random, rows, columns);
        const GridSurface surface(heights);
        GreedyTin tin(heights, true), at_posts(heights);
        for (const double error_m : {60.0, 20.0, 3.0, 0.0}) {
            SCOPED_TRACE("seed 515, field " + std::to_string(i) + ", error " + std::to_string(error_m));
            tin.refine(error_m);
            at_posts.refine(error_m);
            const auto mesh = tin.mesh();
            expect_whole(mesh, rows, columns);
            expect_delaunay(mesh);
            EXPECT_GE(mesh.size(), at_posts.triangles() / 2);
            for (const MeshTriangle& triangle : mesh) {
                std::array<SurfaceVertex, 3> corners;
                for (std::size_t j = 0; j < 3; ++j)
                    corners[j] = surface.vertex(
                        static_cast<VertexNumber>(triangle[j].row * columns + triangle[j].column));
                double found =
                    surface.inner_difference(corners[0], corners[1], corners[2], OriginalSurface::no_limit);
                for (std::size_t j = 0; j < 3; ++j)
                    found = std::max(found, surface.edge_difference(corners[j], corners[(j + 1) % 3],
                                                                    OriginalSurface::no_limit));
                EXPECT_LE(found * height_step_m, error_m + 1.0e-9);
                EXPECT_NEAR(found * height_step_m, worst_place(heights, triangle).error_m, 1.0e-9);
            }
        }
    }
}

TEST(BenchMesh, WorstPostIsThatOfBruteForce) {
    const unsigned seed = 5;
    std::mt19937_64 random(seed);
    const DrawnHeights heights = random_heights(random, 60, 60);
    int checked = 0;
    for (int i = 0; i < 3000; ++i) {
        MeshTriangle triangle;
        for (MeshPost& post : triangle)
            post = {static_cast<int>(random() % 60), static_cast<int>(random() % 60)};
        if (twice_area(triangle[0], triangle[1], triangle[2]) <= 0) continue;
        ++checked;
        const std::vector<MeshTriangle> one(1, triangle);
        const WorstPost worst = worst_post(heights, triangle);
        ASSERT_EQ(worst.error_m, check_mesh(heights, one, 0.0).largest_error_m) << "seed " << seed;
    }
    EXPECT_GT(checked, 1000);
}

// One triangle of two over 5 x 5 posts, and the spike 100 m above it: 10 posts lie south-west of the
// diagonal, uncovered.
TEST(BenchMesh, CheckFindsWhatIsWrong) {
    const std::vector<MeshTriangle> half{MeshTriangle{MeshPost{0, 0}, {0, 4}, {4, 4}}};
    const MeshCheck check = check_mesh(spike(5, 1, 3), half, 99.0);
    EXPECT_EQ(check.largest_error_m, 100.0);
    EXPECT_EQ(check.posts_beyond, 1U);
    EXPECT_EQ(check.posts_uncovered, 10U);
}

// On paper: a spike in the middle of 3 x 3 posts cuts both triangles; one in the middle of the border needs
// that cut first, and then its own.
TEST(BenchRtin, SpikesCutRightTriangles) {
    EXPECT_EQ(BisectionMesh(spike(3, 1, 1)).mesh(10.0).size(), 4U);
    EXPECT_EQ(BisectionMesh(spike(3, 0, 1)).mesh(10.0).size(), 5U);
    EXPECT_EQ(BisectionMesh(spike(3, 0, 1)).mesh(100.0).size(), 2U);
}

TEST(BenchRtin, IsWholeAndWithinItsErrorOnRandomFields) {
    const unsigned seed = 72;
    std::mt19937_64 random(seed);
    for (const int posts : {3, 5, 9, 17, 33, 65}) {
        const DrawnHeights heights = random_heights(random, posts, posts);
        const BisectionMesh rtin(heights);
        for (const double error_m : {150.0, 60.0, 30.0, 0.0}) {
            const std::vector<MeshTriangle> mesh = rtin.mesh(error_m);
            ASSERT_NO_FATAL_FAILURE(expect_whole(mesh, posts, posts)) << "seed " << seed;
            const MeshCheck check = check_mesh(heights, mesh, error_m);
            ASSERT_EQ(check.posts_beyond + check.posts_uncovered, 0U) << "seed " << seed;
        }
        EXPECT_EQ(rtin.mesh(0.0).size(), 2U * static_cast<std::size_t>((posts - 1) * (posts - 1)));
    }
}

TEST(BenchBlocks, AreWholeAndWithinTheirError) {
    const test::Region region(test::patchy_field(420, 375));
    std::vector<std::size_t> of_error;
    for (const double error_m : {0.0, 2.0, 10.0, 40.0}) {
        const BlockMesh blocks = block_mesh(region.pyramid, region.heights, error_m);
        ASSERT_NO_FATAL_FAILURE(expect_whole(blocks.triangles, 420, 375)) << error_m;
        const MeshCheck check = check_mesh(region.heights, blocks.triangles, error_m);
        EXPECT_EQ(check.posts_beyond + check.posts_uncovered, 0U) << error_m;
        EXPECT_GT(std::accumulate(blocks.nodes.begin(), blocks.nodes.end(), std::size_t{0}), 0U);
        of_error.push_back(blocks.triangles.size());
    }
    EXPECT_EQ(of_error[0], 2U * 419U * 374U);
    for (std::size_t i = 1; i < of_error.size(); ++i) EXPECT_LT(of_error[i], of_error[i - 1]);
    // All the same level: the last, one page, 419 / 4 x 374 / 4 quads, rounded up.
    const BlockMesh coarsest = block_mesh(region.pyramid, region.heights, 1.0e6);
    EXPECT_EQ(coarsest.nodes, (std::vector<std::size_t>{0, 0, 14U * 12U}));
    EXPECT_EQ(coarsest.triangles.size(), 2U * 105U * 94U);
}

}  // namespace
}  // namespace oro
