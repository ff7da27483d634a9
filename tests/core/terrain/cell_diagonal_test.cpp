// The rule that splits cells: on paper, in whole regions and in their pages against its definition.
#include "core/terrain/cell_diagonal.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <random>

#include "core/surface/grid_surface.h"
#include "core/terrain/cell_diagonals.h"
#include "core/terrain/drawn_heights.h"
#include "core/terrain/ground.h"
#include "core/terrain/page.h"
#include "core/truth/oracle.h"
#include "tests/core/truth/world_field.h"
#include "tests/support/cell_rule.h"

namespace oro {
namespace {

HeightField field_of(const std::vector<std::vector<float>>& rows) {
    HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, static_cast<int>(rows.size()),
                          static_cast<int>(rows[0].size()), [](double, double) { return 0.0; });
    field.H_m.clear();
    for (const auto& row : rows) field.H_m.insert(field.H_m.end(), row.begin(), row.end());
    return field;
}

// A ridge of 100 m from south-west to north-east over level ground: the middle of the smooth surface is (9 *
// 9 * 2 * 100 + 1 * 2 * 100) / 256 = 64.06 m, that of the falling diagonal 0, that of the rising one 100.
TEST(CellDiagonal, FollowsARidge) {
    const HeightField ridge = field_of({{0, 0, 0, 100}, {0, 0, 100, 0}, {0, 100, 0, 0}, {100, 0, 0, 0}});
    EXPECT_EQ(cell_diagonal(ridge, 1, 1), Diagonal::sw_ne);
    const HeightField other = field_of({{100, 0, 0, 0}, {0, 100, 0, 0}, {0, 0, 100, 0}, {0, 0, 0, 100}});
    EXPECT_EQ(cell_diagonal(other, 1, 1), Diagonal::nw_se);
    // Cells at the rim have not all the posts around them.
    for (const int cell : {0, 2}) {
        EXPECT_EQ(cell_diagonal(ridge, cell, 1), Diagonal::nw_se);
        EXPECT_EQ(cell_diagonal(ridge, 1, cell), Diagonal::nw_se);
    }
}

// The four posts of the cell alone would say that both are as near.
TEST(CellDiagonal, LooksAtSixteenPosts) {
    const HeightField field = field_of({{0, 0, 0, 90}, {0, 0, 50, 0}, {0, 50, 0, 0}, {90, 0, 0, 0}});
    // Smooth: (81 * 100 + 1 * 180) / 256 = 32.34: nearer to 50 than to 0.
    EXPECT_EQ(cell_diagonal(field, 1, 1), Diagonal::sw_ne);
    HeightField lower = field;
    // Eight posts beside the cell at 40: -9 / 256 each takes 11.25 off: 21.09, nearer to 0 than to 50.
    for (const int i : {1, 2, 4, 7, 8, 11, 13, 14}) lower.H_m[static_cast<std::size_t>(i)] = 40.0F;
    EXPECT_EQ(cell_diagonal(lower, 1, 1), Diagonal::nw_se);
}

TEST(CellDiagonal, FallsWhereBothAreAsNearAndBesideVoids) {
    EXPECT_EQ(cell_diagonal(field_of({{1, 2, 3, 4}, {2, 3, 4, 5}, {3, 4, 5, 6}, {4, 5, 6, 7}}), 1, 1),
              Diagonal::nw_se);
    for (std::size_t post = 0; post < 16; ++post) {
        HeightField ridge = field_of({{0, 0, 0, 100}, {0, 0, 100, 0}, {0, 100, 0, 0}, {100, 0, 0, 0}});
        ridge.H_m[post] = void_height_m;
        EXPECT_EQ(cell_diagonal(ridge, 1, 1), Diagonal::nw_se) << post;
        ridge.H_m[post] = 0.0F;
        std::vector<char> masked(16, 0);
        masked[post] = 1;
        EXPECT_EQ(cell_diagonal(ridge, 1, 1, &masked), Diagonal::nw_se) << post;
    }
}

TEST(CellDiagonal, IsTheSameOneStepApart) {
    // Half a step decides nothing: heights count in steps of 2^-11 m.
    const float step = 1.0F / 2048.0F;
    const auto with = [&](float more) {
        return field_of({{0, 0, 0, 0}, {0, 0, more, 0}, {0, more, 0, 0}, {0, 0, 0, 0}});
    };
    EXPECT_EQ(cell_diagonal(with(0.49F * step), 1, 1), Diagonal::nw_se);
    EXPECT_EQ(cell_diagonal(with(step), 1, 1), Diagonal::sw_ne);
}

// The two triangles of a cell: heights of a saddle, by each diagonal.
TEST(CellDiagonal, PlanesGoThroughTheirPosts) {
    const std::array<std::array<double, 2>, 2> h{{{10.0, 17.0}, {31.0, 2.0}}};
    for (const Diagonal diagonal : {Diagonal::nw_se, Diagonal::sw_ne}) {
        double area = 0.0;
        for (const bool west : {true, false}) {
            const CellPlane plane = cell_plane(diagonal, west, h[0][0], h[0][1], h[1][0], h[1][1]);
            const CellCorners at = cell_corners(diagonal, west);
            for (const auto& [down, right] : at) {
                EXPECT_DOUBLE_EQ(plane.at_corner + down * plane.change_down + right * plane.change_right,
                                 h[static_cast<std::size_t>(down)][static_cast<std::size_t>(right)]);
                const double side = west_of_diagonal(diagonal, down, right);
                EXPECT_TRUE(west ? side >= 0.0 : side <= 0.0);
            }
            // Anticlockwise, seen from above: rows go down.
            area += 0.5 * ((at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) -
                           (at[2][0] - at[0][0]) * (at[1][1] - at[0][1]));
        }
        EXPECT_EQ(area, 1.0);
    }
}

// On paper: on the ridge all of the diagonal is 100 m high; a quarter of the way from either other corner to
// the opposite one the ground is at 50.
TEST(CellDiagonal, AllThatAskForTheGroundHaveIt) {
    const HeightField ridge = field_of({{0, 0, 0, 100}, {0, 0, 100, 0}, {0, 100, 0, 0}, {100, 0, 0, 0}});
    const TrueSurface surface(ridge, 1.0, 1);
    struct Place {
        double down, right, H_m;
        bool west;
    };
    for (const Place& at : {Place{0.5, 0.5, 100.0, true},
                            {0.25, 0.25, 50.0, true},
                            {0.75, 0.75, 50.0, false},
                            {0.25, 0.5, 75.0, true},
                            {0.75, 0.5, 75.0, false}}) {
        const double lat_deg = ridge.grid.lat.at_deg(1) - at.down / 1200.0,
                     lon_deg = ridge.grid.lon.at_deg(1) + at.right / 1200.0;
        EXPECT_NEAR(*surface.h_at_m(1.0 + at.down, 1.0 + at.right), at.H_m, 1.0e-9);
        EXPECT_NEAR(*surface.h_m(lat_deg, lon_deg), at.H_m, 1.0e-6);
        EXPECT_NEAR(*ridge.surface_H_m(lat_deg, lon_deg), at.H_m, 1.0e-6);
        EXPECT_NEAR(*ground_h_m(ridge, lat_deg, lon_deg, 2.0), 2.0 * at.H_m, 1.0e-6);
        if (at.H_m == 100.0) continue;
        const Geodetic eye{lat_deg, lon_deg, 1000.0};
        const Oracle above(surface, sight_from(eye));
        const auto hit = above.first_hit(-ecef_from_enu(lat_deg, lon_deg)[2], 1.0e4);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance_m, 1000.0 - at.H_m, 1.0e-6);
        EXPECT_EQ(hit->west, at.west);
        // Up to the ridge from either side: southwards, then northwards.
        const auto slope = surface.slope_at(1.0 + at.down, 1.0 + at.right);
        ASSERT_TRUE(slope);
        EXPECT_EQ(slope->north < 0.0, at.west);
        EXPECT_EQ(slope->east > 0.0, at.west);
    }
    // An edge along the other diagonal passes 100 m below the ridge, one along the ridge nowhere.
    const DrawnHeights heights = drawn_heights(ridge, 1.0, 1);
    const GridSurface original(heights);
    const auto vertex = [&](int row, int column) {
        return original.vertex(static_cast<VertexNumber>(4 * row + column));
    };
    EXPECT_EQ(original.edge_difference(vertex(1, 1), vertex(2, 2), 1.0e9), 100.0 * 2048.0);
    EXPECT_EQ(original.edge_difference(vertex(1, 2), vertex(2, 1), 1.0e9), 0.0);
}

// Rough ground, some of it void; `round`: once round the Earth, a post each `per_deg` of a degree.
HeightField random_field(std::mt19937_64& random, int rows, int columns, bool round) {
    const double per_deg = round ? (columns - 1) / 360.0 : 1200.0;
    HeightField field = test::world_field(
        per_deg, static_cast<std::int64_t>(20 * per_deg), static_cast<std::int64_t>(-180 * per_deg), rows,
        columns, [&](double, double) { return static_cast<double>(random() % 4000); });
    const auto at = [&](int row, int column) -> float& {
        return field.H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                         static_cast<std::size_t>(column)];
    };
    for (int i = 0; i < rows * columns / 300; ++i)
        at(static_cast<int>(random() % static_cast<unsigned>(rows)),
           static_cast<int>(random() % static_cast<unsigned>(columns))) = void_height_m;
    for (int row = 0; round && row < rows; ++row) at(row, columns - 1) = at(row, 0);
    return field;
}

// Rows that begin and end within the region, at its rim and beyond it; old rule: post by post.
TEST(CellDiagonals, RowsOfStepsAreThoseOfTheirPosts) {
    const unsigned seed = 1129;
    std::mt19937_64 random(seed);
    for (const bool round : {false, true}) {
        const int rows = 40, columns = round ? 361 : 70;
        const HeightField field = random_field(random, rows, columns, round);
        std::vector<char> masked(field.H_m.size(), 0);
        masked[masked.size() / 2] = 1;
        for (const std::vector<char>* const mask : {static_cast<const std::vector<char>*>(nullptr),
                                                    static_cast<const std::vector<char>*>(&masked)}) {
            for (int row = -1; row <= rows; ++row) {
                for (const auto& [first, count] : {std::pair{-1, columns + 2}, std::pair{5, 30},
                                                   std::pair{columns - 3, 4}, std::pair{-1, 1}}) {
                    std::vector<std::int32_t> steps(static_cast<std::size_t>(count), 77);
                    decisive_steps_of_row(field, row, first, mask, steps);
                    for (int i = 0; i < count; ++i)
                        ASSERT_EQ(steps[static_cast<std::size_t>(i)],
                                  decisive_steps_at(field, row, first + i, mask))
                            << "seed " << seed << " " << row << ", " << first + i;
                }
            }
        }
    }
}

// From the region as a whole, and from what a page has in a file: to the bit the same, and the rule's.
TEST(CellDiagonals, OfRegionsAndPagesAreTheRules) {
    const unsigned seed = 4711;
    std::mt19937_64 random(seed);
    std::uint64_t asked = 0, rising = 0;
    for (int run = 0; run < 14; ++run) {
        const bool round = run % 2 == 1;
        const int rows = 5 + static_cast<int>(random() % (round ? 65U : 300U));
        // Round the Earth: that ends with a page, and within one.
        const int columns = round ? (run % 4 == 1 ? 257 : 361) : 5 + static_cast<int>(random() % 300);
        const HeightField field = random_field(random, rows, columns, round);
        ASSERT_EQ(field.grid.wraps_longitude(), round);
        const auto all = CellDiagonals::of(field, 2);
        const DrawnHeights heights = drawn_heights(field, 1.5, 1);
        for (int level = 0; level < level_count(field.grid); ++level) {
            const LevelGrid grid = level_grid(field.grid, level);
            for (int row = 0; row < grid.row.quads; ++row) {
                for (int column = 0; column < grid.column.quads; ++column) {
                    const bool sw_ne = test::sw_ne_by_rule(field, row, column, level);
                    ASSERT_EQ(all->at(level, row, column) == Diagonal::sw_ne, sw_ne)
                        << "seed " << seed << " run " << run << " level " << level << " " << row << " "
                        << column;
                    if (level == 0) {
                        ASSERT_EQ(cell_diagonal(field, row, column) == Diagonal::sw_ne, sw_ne);
                    }
                    ++asked;
                    rising += sw_ne ? 1 : 0;
                }
            }
            for (std::uint64_t i = 0; i < grid.pages().count(); ++i) {
                const PageIndex index{static_cast<int>(i) / grid.pages().columns,
                                      static_cast<int>(i) % grid.pages().columns, level};
                const auto of_region =
                    std::make_unique<PageHeights>(page_heights(field.grid, heights, index));
                const auto elevations = std::make_unique<PageElevations>(page_elevations(field, index));
                const auto of_file = std::make_unique<PageHeights>(
                    page_heights(field.grid, field.undulation, 1.5, *elevations, index));
                ASSERT_EQ(of_region->sw_ne, of_file->sw_ne)
                    << "seed " << seed << " run " << run << " page " << i;
                ASSERT_EQ(of_region->steps, of_file->steps);
                for (int row = 0; row < 128; ++row) {
                    for (int column = 0; column < 128; ++column) {
                        const int meshlet = row / 8 * 16 + column / 8, cell = row % 8 * 8 + column % 8;
                        const bool bit =
                            (of_region->sw_ne[static_cast<std::size_t>(2 * meshlet + cell / 32)] >>
                                 (cell % 32) &
                             1U) != 0;
                        const int r = index.row * 128 + row, c = index.column * 128 + column;
                        const bool there = r < grid.row.quads && c < grid.column.quads;
                        ASSERT_EQ(bit, there && all->at(level, r, c) == Diagonal::sw_ne);
                    }
                }
            }
        }
    }
    std::printf("seed %u: %llu cells, %llu of them rise\n", seed, static_cast<unsigned long long>(asked),
                static_cast<unsigned long long>(rising));
    EXPECT_GT(4 * rising, asked);
    EXPECT_GT(4 * (asked - rising), asked);
}

}  // namespace
}  // namespace oro
