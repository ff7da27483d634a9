// The errors of nodes against brute force: every place of lattices three and four times as fine as the posts,
// in every way of stitching.
#include "core/lod/node_deviations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "tests/core/truth/drawn_surface.h"
#include "tests/core/truth/world_field.h"

namespace oro {
namespace {

// Rough ground; with voids in blocks and single posts when asked.
HeightField random_field(std::mt19937_64& random, int rows, int columns, bool voids) {
    HeightField field = test::world_field(1200.0, 47 * 1200, 8 * 1200, rows, columns, [&](double, double) {
        return static_cast<double>(random() % 3000);
    });
    if (!voids) return field;
    for (int blob = 0; blob < 6; ++blob) {
        const int top = static_cast<int>(random() % static_cast<unsigned>(rows));
        const int left = static_cast<int>(random() % static_cast<unsigned>(columns));
        // Sizes and places that now and then fall on coarse quads.
        const int align = random() % 2 == 0 ? 8 : 1;
        const int size = random() % 3 == 0 ? 1 : static_cast<int>(random() % 4) * 8 + 7;
        for (int row = top / align * align + (align > 1 ? 1 : 0);
             row < std::min(rows, top / align * align + size); ++row) {
            for (int column = left / align * align + (align > 1 ? 1 : 0);
                 column < std::min(columns, left / align * align + size); ++column)
                field.H_m[static_cast<std::size_t>(row * columns + column)] = void_height_m;
        }
    }
    return field;
}

struct Brute {
    double worst_m{0.0};
    bool same_area{true};
};
// Every place of lattices at quarters and at thirds of a post's spacing (new edges go one quad down and two
// to the right, and so cross diagonals at these), asked just inside of each triangle. The areas are the same
// when all drawn places are truly there and the sums agree.
Brute brute_force(const DrawnHeights& heights, const LevelGrid& grid, int node_row, int node_column,
                  std::uint32_t edges) {
    Brute brute;
    double drawn_area = 0.0;
    for (const auto& triangle : test::drawn_triangles(heights, grid, node_row, node_column, edges)) {
        const auto& [a, b, c] = triangle;
        drawn_area +=
            0.5 * std::abs((b.row - a.row) * (c.column - a.column) - (c.row - a.row) * (b.column - a.column));
        const double middle_row = (a.row + b.row + c.row) / 3.0;
        const double middle_column = (a.column + b.column + c.column) / 3.0;
        const int north = std::min({a.row, b.row, c.row}), south = std::max({a.row, b.row, c.row});
        const int west = std::min({a.column, b.column, c.column}),
                  east = std::max({a.column, b.column, c.column});
        for (const int parts : {3, 4}) {
            for (int i = 0; i < (parts * (south - north) + 1) * (parts * (east - west) + 1); ++i) {
                const int across = parts * (east - west) + 1;
                const double y = north + static_cast<double>(i / across) / parts,
                             x = west + static_cast<double>(i % across) / parts;
                const auto shares = test::shares_at(triangle, y, x);
                if (*std::min_element(shares.begin(), shares.end()) < -1.0e-12) continue;
                const double row = y + 1e-6 * (middle_row - y);
                const double column = x + 1e-6 * (middle_column - x);
                const auto finest = test::finest_triangle(heights, row, column);
                brute.same_area = brute.same_area && finest.has_value();
                if (!finest) continue;
                const double truth_m = test::height_on(heights, *finest, row, column);
                brute.worst_m = std::max(brute.worst_m,
                                         std::abs(truth_m - test::height_on(heights, triangle, row, column)));
            }
        }
    }
    double true_area = 0.0;
    for (int row = grid.row.region_post(node_row * 8);
         row < grid.row.region_post(std::min(node_row * 8 + 8, grid.row.quads)); ++row) {
        for (int column = grid.column.region_post(node_column * 8);
             column < grid.column.region_post(std::min(node_column * 8 + 8, grid.column.quads)); ++column) {
            for (const double side : {0.1, 0.9})
                true_area += test::finest_triangle(heights, row + side, column + 1.0 - side) ? 0.5 : 0.0;
        }
    }
    brute.same_area = brute.same_area && drawn_area == true_area;
    return brute;
}

double largest_of(const NodeDeviation& deviation, std::uint32_t edges) {
    double largest_m = deviation.own_m;
    for (std::size_t i = 0; i < 4; ++i) {
        if ((edges >> i & 1U) != 0) largest_m = std::max(largest_m, deviation.stitched_m[i]);
    }
    return largest_m;
}

class NodeDeviationsOnRoughGround : public testing::TestWithParam<bool> {};

TEST_P(NodeDeviationsOnRoughGround, AreTheWorstOfEveryPlaceAndStitching) {
    const unsigned seed = 91;
    std::mt19937_64 random(seed);
    int nodes = 0, unfit = 0, empty = 0, exact = 0;
    for (int run = 0; run < 30; ++run) {
        // Regions that end within nodes and within quads, too.
        const int rows = 17 + static_cast<int>(random() % 50);
        const int columns = 17 + static_cast<int>(random() % 50);
        const HeightField field = random_field(random, rows, columns, GetParam());
        const DrawnHeights heights = drawn_heights(field, 1.0, 1);
        for (int level = 0; level <= 2; ++level) {
            const LevelGrid grid = level_grid(field.grid, level);
            const NodeDeviations deviations(field.grid, heights, level);
            for (int i = 0; i < grid.row.nodes() * grid.column.nodes(); ++i) {
                if (level == 0 && random() % 4 != 0) continue;
                const int row = i / grid.column.nodes();
                const int column = i % grid.column.nodes();
                const NodeDeviation deviation = deviations.height_deviation(row, column);
                const std::uint32_t around = deviations.edges(row, column);
                const bool whole = grid.row.quads_of_node(row) == 8 && grid.column.quads_of_node(column) == 8;
                // Where the last quad is cut short the error may be larger than the truth.
                const bool regular = whole && ((grid.row.last_post >> level) >= 8 * (row + 1)) &&
                                     ((grid.column.last_post >> level) >= 8 * (column + 1));
                double worst_m = 0.0;
                bool fits = true;
                for (std::uint32_t edges = 0; edges < 16; ++edges) {
                    if ((edges & around) != edges) continue;
                    if (deviation.empty && edges != 0) continue;  // never drawn
                    const Brute brute = brute_force(heights, grid, row, column, edges);
                    const double bound_m = largest_of(deviation, edges);
                    fits = fits && brute.same_area;
                    ASSERT_TRUE(brute.same_area || std::isinf(bound_m))
                        << level << " " << row << " " << column << " " << edges;
                    ASSERT_LE(brute.worst_m, bound_m + 1.0e-6)
                        << level << " " << row << " " << column << " " << edges;
                    worst_m = std::max(worst_m, brute.worst_m);
                    if (edges == 0 && !GetParam() && regular) {
                        EXPECT_NEAR(brute.worst_m, deviation.own_m, 0.01);
                    }
                }
                ++nodes;
                unfit += fits ? 0 : 1;
                empty += deviation.empty ? 1 : 0;
                const double bound_m = largest_of(deviation, 15);
                if (regular && fits && !std::isinf(bound_m)) {
                    ++exact;
                    EXPECT_NEAR(bound_m, worst_m, 0.01) << level << " " << row << " " << column;
                }
                if (level == 0) {
                    EXPECT_EQ(deviation.own_m, 0.0);
                }
            }
        }
    }
    std::printf("seed %u: %d nodes, %d cannot stand for their ground, %d empty, %d exact\n", seed, nodes,
                unfit, empty, exact);
    EXPECT_GT(exact, 150);
    EXPECT_EQ(unfit > 0, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Core, NodeDeviationsOnRoughGround, testing::Bool(), [](const auto& voids) {
    return std::string(voids.param ? "WithVoids" : "WithoutVoids");
});

// Missing tiles: what ends on a coarse quad's edge is no reason to stay fine.
TEST(NodeDeviations, VoidsThatEndWithAQuadDoNoHarm) {
    const HeightField field =
        test::world_field(1200.0, 47 * 1200, 8 * 1200, 129, 129, [](double lat_deg, double lon_deg) {
            return lat_deg < 47.0 - 32.5 / 1200.0 && lon_deg > 8.0 + 48.5 / 1200.0
                       ? static_cast<double>(void_height_m)
                       : 100.0;
        });
    const DrawnHeights heights = drawn_heights(field, 1.0, 1);
    for (int level = 0; level <= 3; ++level) {
        const NodeDeviations deviations(field.grid, heights, level);
        const LevelGrid grid = level_grid(field.grid, level);
        for (int i = 0; i < grid.row.nodes() * grid.column.nodes(); ++i) {
            const NodeDeviation deviation =
                deviations.height_deviation(i / grid.column.nodes(), i % grid.column.nodes());
            EXPECT_EQ(largest_of(deviation, 15), 0.0) << level << " " << i;
        }
    }
    // 48 is no multiple of 32: a quad of level 5 would have to be half void.
    EXPECT_TRUE(std::isinf(NodeDeviations(field.grid, heights, 5).height_deviation(0, 0).own_m));
}

// A place on a triangle, as (row, column): the middle of its longest edge, which sags most, or any.
glm::dvec2 place_on(const test::PostTriangle& triangle, bool middle, std::mt19937_64& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double u = middle ? 0.5 : std::sqrt(unit(random));
    const double v = middle ? 1.0 : unit(random);
    return {(1.0 - u) * triangle[0].row + u * (1.0 - v) * triangle[1].row + u * v * triangle[2].row,
            (1.0 - u) * triangle[0].column + u * (1.0 - v) * triangle[1].column + u * v * triangle[2].column};
}

// In space: the sag of flat triangles over the ellipsoid, at all latitudes and spacings.
TEST(NodeDeviations, HoldInSpace) {
    const unsigned seed = 17;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double closest = 0.0;
    int places = 0;
    for (int run = 0; run < 60; ++run) {
        const double spacings[] = {3600.0, 1200.0, 60.0, 4.0, 1.0};
        const double per_deg = spacings[run % 5];
        const int size = per_deg < 2.0 ? 65 : 129;
        const double north_deg = 90.0 - unit(random) * (180.0 - size / per_deg);
        // Flat ground shows the sag alone, slopes its share, rough ground that the sum holds.
        const double relief_m = run % 3 == 0 ? 0.0 : run % 3 == 1 ? 3000.0 : 10.0;
        const double slope = per_deg * 20.0;
        const HeightField field = test::world_field(
            per_deg, static_cast<std::int64_t>(north_deg * per_deg), 0, size, size,
            [&](double lat_deg, double lon_deg) {
                return relief_m * (std::sin(slope * lat_deg / 100.0) + std::cos(slope * lon_deg / 170.0));
            });
        const DrawnHeights heights = drawn_heights(field, 1.0, 1);
        std::vector<glm::dvec3> posts;
        for (int i = 0; i < size * size; ++i) posts.push_back(post_ecef(field, i / size, i % size, 1.0).m);
        const auto on = [&](const test::PostTriangle& triangle, double row, double column) {
            const auto shares = test::shares_at(triangle, row, column);
            glm::dvec3 at(0.0);
            for (std::size_t i = 0; i < 3; ++i)
                at +=
                    shares[i] * posts[static_cast<std::size_t>(triangle[i].row * size + triangle[i].column)];
            return at;
        };
        for (int level = 1; level <= 3; ++level) {
            const LevelGrid grid = level_grid(field.grid, level);
            const NodeDeviations deviations(field.grid, heights, level);
            for (int i = 0; i < 8; ++i) {
                const int row = static_cast<int>(random() % static_cast<unsigned>(grid.row.nodes()));
                const int column = static_cast<int>(random() % static_cast<unsigned>(grid.column.nodes()));
                const std::uint32_t edges =
                    static_cast<std::uint32_t>(random() % 16) & deviations.edges(row, column);
                const double bound_m = largest_of(deviations.deviation(row, column), edges);
                for (const auto& triangle : test::drawn_triangles(heights, grid, row, column, edges)) {
                    for (int sample = 0; sample < 6; ++sample) {
                        const glm::dvec2 at = place_on(triangle, sample == 0, random);
                        const auto finest = test::finest_triangle(heights, at.x, at.y);
                        const double distance_m =
                            glm::distance(on(triangle, at.x, at.y), on(*finest, at.x, at.y));
                        ASSERT_LE(distance_m, bound_m) << run << " level " << level << " at " << north_deg;
                        closest = std::max(closest, distance_m / bound_m);
                        ++places;
                    }
                }
            }
        }
    }
    std::printf("seed %u: %d places, at most %.3f of the bound\n", seed, places, closest);
    EXPECT_GT(closest, 0.9);
}

}  // namespace
}  // namespace oro
