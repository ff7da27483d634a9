// Must hold: what lies between a node's triangles, stitched or not, and the coarse octaves of made terrain is
// found, and what lies between these octaves and the posts of level 0 is no more than its proven bound.
#include "core/made_pages/coarse_deviations.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "core/lod/levels_gpu.h"
#include "core/made/made_heights.h"
#include "core/made_pages/measured_block.h"

namespace oro {
namespace {

// A part of made terrain a second apart, from a place near a latitude on.
struct MadePart {
    MadeTerrain terrain;
    MadeRegion region;
    int first_row, first_column, posts;
    std::uint32_t coarse_octaves;
    std::vector<std::int32_t> steps, coarse_steps;

    MadePart(std::uint32_t seed, int lat_deg, std::uint32_t octaves, std::uint32_t gain,
             std::uint32_t cell_shift, int base, int side, MadeKind kind = MadeKind::fbm)
        : posts(side) {
        terrain.kind = kind;
        terrain.seed = seed;
        terrain.octaves = octaves;
        terrain.gain = gain;
        terrain.cell_shift = cell_shift;
        terrain.low = -4000 * 2048;
        terrain.high = 4000 * 2048;
        terrain.west = 8 * 3600;
        terrain.east = terrain.west + 4 * 3600;
        terrain.south = (lat_deg - 1) * std::int64_t{3600};
        terrain.north = (lat_deg + 1) * std::int64_t{3600};
        PostGrid grid;
        grid.lat = {3600.0, 0.0, terrain.north, -1, terrain.rows()};
        grid.lon = {3600.0, 0.0, terrain.west, 1, terrain.columns()};
        region = made_region(terrain, grid, {});
        coarse_octaves = region.bounds()[static_cast<std::size_t>(base)].coarse_octaves;
        first_row = static_cast<int>(seed % 97) * 32;
        first_column = static_cast<int>(seed % 89) * 32;
        const auto columns = made_columns(terrain, first_column, posts);
        steps.resize(columns.size() * columns.size());
        coarse_steps.resize(steps.size());
        for (int row = 0; row < posts; ++row)
            made_row_coarse_heights(terrain, region.rule, first_row + row, columns, coarse_octaves,
                                    std::span(steps).subspan(at(row, 0), columns.size()),
                                    std::span(coarse_steps).subspan(at(row, 0), columns.size()));
    }
    [[nodiscard]] std::size_t at(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(posts) +
               static_cast<std::size_t>(column);
    }
};

// Between the coarse octaves, linear over cells of every 2^base-th post by either diagonal, and all octaves
// at each post: metres.
double most_between(const MadePart& part, int base) {
    const int size = 1 << base;
    double most_m = 0.0;
    for (int row = 0; row < part.posts - 1; ++row)
        for (int column = 0; column < part.posts - 1; ++column) {
            const int north = row / size * size, west = column / size * size;
            const double down = (row - north) / static_cast<double>(size),
                         right = (column - west) / static_cast<double>(size);
            const auto corner = [&](int r, int c) {
                return static_cast<double>(part.coarse_steps[part.at(north + r * size, west + c * size)]);
            };
            for (const Diagonal diagonal : {Diagonal::nw_se, Diagonal::sw_ne}) {
                const CellPlane plane = cell_plane(diagonal, west_of_diagonal(diagonal, down, right) >= 0.0,
                                                   corner(0, 0), corner(0, 1), corner(1, 0), corner(1, 1));
                const double h = plane.at_corner + down * plane.change_down + right * plane.change_right;
                most_m = std::max(most_m, made_step_m * std::abs(h - part.steps[part.at(row, column)]));
            }
        }
    return most_m;
}

// Of a base level, with first cells of 2^shift / 192 m: `runs` parts, each with its own seed.
double largest_share(int base, std::uint32_t octaves, std::uint32_t shift, int runs,
                     MadeKind kind = MadeKind::fbm) {
    std::mt19937 random(53);
    double largest = 0.0;
    for (int i = 0; i < runs; ++i) {
        const int lat_deg = std::array{0, 30, 46, 60, 75, 88}[static_cast<std::size_t>(i) % 6];
        const auto gain = 400 + static_cast<std::uint32_t>(random() % 300);
        const MadePart part(static_cast<std::uint32_t>(random()), lat_deg, octaves, gain, shift, base, 129,
                            kind);
        const auto from_deg = static_cast<std::size_t>(std::max(0, lat_deg - 1));
        const double bound_m = part.region.bounds_from_deg[from_deg][static_cast<std::size_t>(base)].coarse;
        const double measured_m = most_between(part, base);
        EXPECT_LE(measured_m, bound_m) << "seed 53, number " << i << ", " << octaves << " octaves";
        largest = std::max(largest, measured_m / bound_m);
    }
    std::printf("%s, base %d, %u octaves from 2^%u: largest of %d (seed 53) is %.2f of the bound\n",
                kind == MadeKind::fbm ? "fbm" : "ridged", base, octaves, shift, runs, largest);
    return largest;
}

// Whatever the octaves; and one that is fine, or curves alone, comes so near to its bound that a bound of
// half the size would be seen.
TEST(CoarseBound, IsNotBelowWhatIsMeasuredAndNotFarAbove) {
    for (const int base : {1, 2, 4})
        for (const std::uint32_t octaves : {3U, 9U, 14U}) largest_share(base, octaves, 22, 6);
    EXPECT_GT(largest_share(2, 1, 14, 12), 0.6);
    EXPECT_GT(largest_share(2, 1, 17, 12), 0.5);
}

// Crests are not smooth, so what is between posts falls as their distance, not as its square.
TEST(CoarseBound, OfRidgedIsNotBelowWhatIsMeasuredAndNotFarAbove) {
    for (const int base : {1, 2, 4})
        for (const std::uint32_t octaves : {3U, 9U, 14U})
            largest_share(base, octaves, 22, 6, MadeKind::ridged);
    EXPECT_GT(largest_share(2, 1, 14, 12, MadeKind::ridged), 0.9);
    EXPECT_GT(largest_share(2, 1, 20, 12, MadeKind::ridged), 0.1);
}

TEST(CoarseBound, IsSmallerTowardsThePoles) {
    const MadePart part(7, 46, 12, 536, 22, 2, 33);
    for (std::size_t deg = 1; deg < part.region.bounds_from_deg.size(); ++deg)
        for (std::size_t level = 0; level < part.region.bounds().size(); ++level) {
            const MadeLevelBound &before = part.region.bounds_from_deg[deg - 1][level],
                                 &here = part.region.bounds_from_deg[deg][level];
            EXPECT_LE(here.coarse, before.coarse);
            EXPECT_LE(here.own.free, before.own.free);
            EXPECT_LE(here.drawn.cut, before.drawn.cut);
        }
    EXPECT_LT(part.region.bounds_from_deg[60][2].coarse, 0.9 * part.region.bounds()[2].coarse);
}

// Heights of any grid, whose coarse octaves are others.
struct OddGround {
    PostGrid grid;
    HeightField field;
    DrawnHeights heights;
    std::vector<std::int32_t> coarse;

    explicit OddGround(std::uint32_t seed, int side = 65) {
        std::mt19937 random(seed);
        grid.lat = {1200.0, 0.0, 46 * 1200, -1, side};
        grid.lon = {1200.0, 0.0, 8 * 1200, 1, side};
        field.grid = grid;
        for (int i = 0; i < side * side; ++i) {
            field.H_m.push_back(static_cast<float>(random() % 4096) / 16.0F);
            coarse.push_back(static_cast<std::int32_t>(random() % 500'000));
        }
        heights = drawn_heights(field, 1.0, 1);
    }
    // The coarse octaves at any place, over triangles of the cells' north-west to south-east diagonals.
    [[nodiscard]] double coarse_at(double row, double column) const {
        const int r = std::min(static_cast<int>(row), grid.rows() - 2),
                  c = std::min(static_cast<int>(column), grid.columns() - 2);
        const auto post = [&](int i, int j) {
            return static_cast<double>(coarse[static_cast<std::size_t>((r + i) * grid.columns() + c + j)]);
        };
        const CellPlane plane = cell_plane(Diagonal::nw_se, row - r >= column - c, post(0, 0), post(0, 1),
                                           post(1, 0), post(1, 1));
        return plane.at_corner + (row - r) * plane.change_down + (column - c) * plane.change_right;
    }
};

// Triangles of the nodes of a grid of random numbers: their differences at 30 places of each are none larger,
// and some are nearly as large, over 500 triangles.
TEST(CoarseDeviations, StitchedTrianglesAreMeasuredAtTheWorstPlace) {
    for (const int level : {0, 1, 2}) {
        const OddGround ground(54U + static_cast<std::uint32_t>(level));
        const CoarseDeviations deviations(ground.grid, ground.heights, ground.coarse, level);
        const std::uint32_t edges = gpu::edge_north | gpu::edge_east | gpu::edge_south | gpu::edge_west;
        const PerEdge found_m = deviations.stitched_m(0, 0, edges, edges);
        std::mt19937 random(55);
        std::uniform_real_distribution<double> any(0.0, 1.0);
        PerEdge sampled_m{};
        for (const auto& stitched : NodeDeviations::stitched_triangles(8, 8, edges)) {
            if (ground.heights.diagonal(level, static_cast<int>(stitched.quad[0]),
                                        static_cast<int>(stitched.quad[1])) != stitched.diagonal)
                continue;
            double& most_m = sampled_m[static_cast<std::size_t>(std::countr_zero(stitched.edges))];
            for (int i = 0; i < 2000; ++i) {
                double a = any(random), b = any(random);
                if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
                if (i % 4 == 0) a = 0.0;
                const std::array<double, 3> share{a, b, 1.0 - a - b};
                double row = 0.0, column = 0.0, h = 0.0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const int r = static_cast<int>(stitched.posts[k][0]) << level,
                              c = static_cast<int>(stitched.posts[k][1]) << level;
                    row += share[k] * r;
                    column += share[k] * c;
                    h += share[k] * ground.heights.at(r, c);
                }
                most_m = std::max(most_m, height_step_m * std::abs(h - ground.coarse_at(row, column)));
            }
        }
        for (std::size_t edge = 0; edge < 4; ++edge) {
            EXPECT_LE(sampled_m[edge], found_m[edge] + 1e-6)
                << "seed 55, level " << level << ", edge " << edge;
            EXPECT_GE(sampled_m[edge], 0.85 * found_m[edge])
                << "seed 55, level " << level << ", edge " << edge;
        }
    }
}

// Beside the same heights a node of coarse octaves that are all octaves has the deviation that levels have.
TEST(CoarseDeviations, AreThoseOfLevelsWhereAllOctavesAreCoarse) {
    OddGround ground(56);
    ground.coarse = ground.heights.steps;
    for (const int level : {1, 2, 3}) {
        const NodeDeviations levels(ground.grid, ground.heights, level);
        const CoarseDeviations deviations(ground.grid, ground.heights, ground.coarse, level);
        // But where cells that are split the other way cross a quad's diagonal.
        EXPECT_NEAR(deviations.own_m(0, 0), levels.height_deviation(0, 0).own_m, 20.0) << level;
        EXPECT_LE(deviations.own_m(0, 0), levels.height_deviation(0, 0).own_m + 1e-5) << level;
        EXPECT_GT(deviations.own_m(0, 0), 100.0) << level;
    }
}

}  // namespace
}  // namespace oro
