#include "core/lod/pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <random>

#include "core/lod/levels_gpu.h"
#include "core/lod/node_deviations.h"
#include "tests/core/truth/world_field.h"
#include "tests/support/rough_terrain.h"

namespace oro {
namespace {

// The rows and columns of the nodes below one and around these, by the rule as it is said.
std::vector<std::pair<int, int>> nodes_below(const PyramidLevel& below, int row, int column,
                                             bool wraps_longitude) {
    const int rows = below.grid.row.nodes();
    const int columns = below.grid.column.nodes();
    std::vector<std::pair<int, int>> nodes;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const auto inside = [&](int rr, int cc) {
                return rr / 2 == row && cc / 2 == column && rr >= 0 && cc >= 0;
            };
            const auto round = [&](int cc) { return wraps_longitude ? (cc + columns) % columns : cc; };
            if (inside(r, c) || inside(r - 1, c) || inside(r + 1, c) || inside(r, round(c - 1)) ||
                inside(r, round(c + 1)))
                nodes.emplace_back(r, c);
        }
    }
    return nodes;
}

glm::dvec3 centre_ecef(const PyramidLevel& level, int row, int column) {
    const PageSummary& page = level.page_of_node(row, column).summary;
    return page.origin_ecef.m + page.ecef_from_page * glm::dvec3(level.node(row, column).centre);
}

// What a quarter of a page says of all its nodes holds for each.
void expect_quarters(const PyramidPage& page) {
    for (int q = 0; q < 4; ++q) {
        const PageQuarter& quarter = page.quarters[static_cast<std::size_t>(q)];
        bool any = false;
        for (int row = q / 2 * 8; row < q / 2 * 8 + 8; ++row) {
            for (int column = q % 2 * 8; column < q % 2 * 8 + 8; ++column) {
                const gpu::MeshletBounds& node = page.nodes[static_cast<std::size_t>(row * 16 + column)];
                ASSERT_GE(quarter.largest_error_m, node.error_m);
                if (node.radius < 0.0F) continue;
                any = true;
                // More than floats round away.
                if (node.error_m > 0.0F && node.error_m < gpu::unfit_error_m) {
                    ASSERT_GT(quarter.largest_error_m, node.error_m * 1.000005F);
                }
                ASSERT_GT(quarter.lod_radius_m, glm::distance(quarter.centre_m, glm::dvec3(node.centre)) +
                                                    1.00005 * static_cast<double>(node.lod_radius));
            }
        }
        ASSERT_EQ(quarter.lod_radius_m < 0.0, !any);
    }
}

void expect_nested(const LevelPyramid& pyramid) {
    for (std::size_t k = 1; k < pyramid.levels.size(); ++k) {
        const PyramidLevel& level = pyramid.levels[k];
        const PyramidLevel& below = pyramid.levels[k - 1];
        for (int row = 0; row < level.grid.row.nodes(); ++row) {
            for (int column = 0; column < level.grid.column.nodes(); ++column) {
                const gpu::MeshletBounds& node = level.node(row, column);
                const auto lower = nodes_below(below, row, column, pyramid.wraps_longitude);
                ASSERT_GE(lower.size(), 1U);
                for (const auto& [r, c] : lower) {
                    const gpu::MeshletBounds& other = below.node(r, c);
                    if (node.radius >= 0.0F || other.error_m == gpu::unfit_error_m) {
                        ASSERT_GE(node.error_m, other.error_m);
                    }
                    if (node.radius < 0.0F || other.radius < 0.0F || node.error_m == gpu::unfit_error_m)
                        continue;
                    if (other.error_m > 0.0F) {
                        ASSERT_GT(node.error_m, other.error_m);
                    }
                    const double apart_m =
                        glm::distance(centre_ecef(level, row, column), centre_ecef(below, r, c));
                    ASSERT_GT(node.lod_radius, apart_m + static_cast<double>(other.lod_radius));
                }
            }
        }
        for (const PyramidPage& page : level.pages) {
            for (const gpu::MeshletBounds& node : page.nodes) {
                ASSERT_GE(page.summary.largest_error_m, node.error_m);
                if (node.radius < 0.0F) continue;
                ASSERT_GE(page.summary.lod_radius_m,
                          glm::distance(page.summary.centre_m, glm::dvec3(node.centre)) +
                              static_cast<double>(node.lod_radius));
            }
        }
    }
    for (const PyramidLevel& level : pyramid.levels) {
        for (const PyramidPage& page : level.pages) ASSERT_NO_FATAL_FAILURE(expect_quarters(page));
    }
    EXPECT_EQ(pyramid.levels.back().pages.size(), 1U);
}

TEST(Pyramid, LevelsAreNestedUpToOnePage) {
    const PostGrid grid{{1200.0, 0.0, 0, -1, 6001 - 2400}, {1200.0, 0.0, 0, 1, 6001}};
    EXPECT_EQ(level_count(grid), 7);  // 6000 quads / 2^6 = 94
    for (int level = 0; level < 6; ++level) {
        const LevelGrid fine = level_grid(grid, level), coarse = level_grid(grid, level + 1);
        for (int post = 0; post <= coarse.column.quads; ++post) {
            const int twin = std::min(2 * post, fine.column.quads);
            ASSERT_EQ(coarse.column.region_post(post), fine.column.region_post(twin));
        }
        EXPECT_EQ(fine.column.region_post(fine.column.quads), 6000);
        EXPECT_LT(fine.row.region_post(fine.row.quads - 1), 3600);
        EXPECT_EQ(coarse.row.nodes(), (fine.row.nodes() + 1) / 2);
    }
    EXPECT_EQ(level_count(PostGrid{{1.0, 0.0, 0, -1, 129}, {1.0, 0.0, 0, 1, 2}}), 1);
    EXPECT_EQ(level_count(PostGrid{{1.0, 0.0, 0, -1, 130}, {1.0, 0.0, 0, 1, 2}}), 2);
}

TEST(Pyramid, ErrorsAndSpheresGrowTowardsTheRoot) {
    HeightField field = test::rough_field(47.0, 8.0, 401, 333);
    expect_nested(build_pyramid(field, region_shape(field, 1.0), 2));
    std::mt19937_64 random(5);
    for (int i = 0; i < 40; ++i) field.H_m[random() % field.H_m.size()] = void_height_m;
    for (int row = 100; row < 250; ++row) {
        for (int column = 200; column < 333; ++column)
            field.H_m[static_cast<std::size_t>(row * 333 + column)] = void_height_m;
    }
    expect_nested(build_pyramid(field, region_shape(field, 1.0), 2));
}

TEST(Pyramid, ErrorsAreThoseOfTheNodesOrMore) {
    const HeightField field = test::rough_field(47.0, 8.0, 300, 280);
    const LevelPyramid pyramid = build_pyramid(field, region_shape(field, 1.0), 1);
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    for (std::size_t k = 0; k < pyramid.levels.size(); ++k) {
        const PyramidLevel& level = pyramid.levels[k];
        const NodeDeviations deviations(field.grid, heights, static_cast<int>(k));
        double sum_m = 0.0, saturated_sum_m = 0.0;
        for (int row = 0; row < level.grid.row.nodes(); ++row) {
            for (int column = 0; column < level.grid.column.nodes(); ++column) {
                ASSERT_GE(static_cast<double>(level.node(row, column).error_m),
                          deviations.deviation(row, column).own_m);
                sum_m += deviations.deviation(row, column).own_m;
                saturated_sum_m += static_cast<double>(level.node(row, column).error_m);
            }
        }
        EXPECT_LE(saturated_sum_m, 3.0 * sum_m) << "level " << k;
    }
}

// What is stitched to a node is answered for by it.
TEST(Pyramid, ErrorsHoldWhatIsStitchedToTheNode) {
    const HeightField field = test::rough_field(47.0, 8.0, 261, 270);
    const LevelPyramid pyramid = build_pyramid(field, region_shape(field, 1.0), 2);
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    for (std::size_t k = 0; k + 1 < pyramid.levels.size(); ++k) {
        const LevelGrid& grid = pyramid.levels[k].grid;
        const NodeDeviations deviations(field.grid, heights, static_cast<int>(k));
        for (int row = 0; row < grid.row.nodes(); ++row) {
            for (int column = 0; column < grid.column.nodes(); ++column) {
                const NodeDeviation deviation = deviations.deviation(row, column);
                const int beyond[4][2] = {
                    {row - 1, column}, {row, column + 1}, {row + 1, column}, {row, column - 1}};
                for (std::size_t edge = 0; edge < 4; ++edge) {
                    const auto& [r, c] = beyond[edge];
                    if ((deviations.edges(row, column) >> edge & 1U) == 0 ||
                        (r / 2 == row / 2 && c / 2 == column / 2))
                        continue;
                    ASSERT_GE(static_cast<double>(pyramid.levels[k + 1].node(r / 2, c / 2).error_m),
                              deviation.stitched_m[edge]);
                }
            }
        }
    }
}

TEST(Pyramid, RoundTheEarthTheLastColumnMeetsTheFirst) {
    // 3 levels: 300 quads round, 2 columns of pages and a bit.
    const HeightField field =
        test::world_field(300.0 / 360.0, 50, -150, 101, 301, [](double lat_deg, double lon_deg) {
            // Rough in the west, smooth in the east.
            return 1000.0 +
                   (lon_deg < -170.0 ? 900.0 * std::sin(77.0 * lat_deg) : 10.0 * std::sin(0.1 * lat_deg));
        });
    ASSERT_TRUE(field.grid.wraps_longitude());
    const LevelPyramid pyramid = build_pyramid(field, region_shape(field, 1.0), 2);
    ASSERT_TRUE(pyramid.wraps_longitude);
    EXPECT_EQ(pyramid.levels.size(), 3U);
    expect_nested(pyramid);
}

TEST(Pyramid, DoesNotDependOnTheNumberOfThreads) {
    const HeightField field = test::rough_field(47.0, 8.0, 300, 280);
    std::vector<std::vector<gpu::PageBlock>> blocks;
    for (const int threads : {1, 3}) {
        std::vector<PageIndex> order;
        blocks.emplace_back();
        build_pyramid(field, region_shape(field, 1.0), threads,
                      [&](const PyramidPage& page, const gpu::PageBlock& block) {
                          order.push_back(page.summary.index);
                          blocks.back().push_back(block);
                          EXPECT_EQ(std::memcmp(page.nodes.data(), block.meshlets, sizeof block.meshlets), 0);
                      });
        ASSERT_EQ(order.size(), 9U + 4U + 1U);
        EXPECT_EQ(order[5].row, 1);
        EXPECT_EQ(order[5].column, 2);
        EXPECT_EQ(order[9].level, 1);
    }
    EXPECT_EQ(std::memcmp(blocks[0].data(), blocks[1].data(), blocks[0].size() * sizeof(gpu::PageBlock)), 0);
}

// A post has one height, whatever the page and level (and one place: tests/core/frame/frame_tables_test.cpp).
TEST(Pyramid, APostIsTheSameOnEveryLevel) {
    HeightField field = test::rough_field(47.0, 8.0, 300, 280);
    field.undulation.lat = {4.0, 0.0, 200, -1, 100};
    field.undulation.lon = {4.0, 0.0, 0, +1, 100};
    for (int i = 0; i < 10000; ++i) field.undulation.N_m.push_back(static_cast<float>(50.0 + std::sin(i)));
    const DrawnHeights heights = drawn_heights(field, 1.7, 2);
    const RegionShape shape = region_shape(field, 1.7);
    build_pyramid(field, shape, 1, [&](const PyramidPage& page, const gpu::PageBlock& block) {
        const PageIndex index = page.summary.index;
        const LevelGrid grid = level_grid(field.grid, index.level);
        for (int i = 0; i <= 128; ++i) {
            for (int j = 0; j <= 128; ++j) {
                const int row = index.row * 128 + i, column = index.column * 128 + j;
                const std::int32_t steps = block.heights[(i + 1) * 131 + j + 1];
                if (row > grid.row.quads || column > grid.column.quads) {
                    ASSERT_EQ(steps, gpu::void_height);
                    continue;
                }
                const int region_row = grid.row.region_post(row),
                          region_column = grid.column.region_post(column);
                ASSERT_EQ(steps, heights.at(region_row, region_column));
                ASSERT_EQ(steps * height_step_m, drawn_h_m(field, region_row, region_column, 1.7));
            }
        }
        EXPECT_EQ(grid.row.quads_of_node(index.row * 16), 8);
        EXPECT_EQ(grid.column.quads_of_node(index.column * 16), 8);
    });
}

}  // namespace
}  // namespace oro
