// What stitching makes of a node's triangles, whichever diagonals its quads have: by brute force over all
// ways of stitching, no fold, no gap and nothing twice.
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "core/lod/levels_gpu.h"
#include "core/terrain/cell_diagonal.h"

namespace oro {
namespace {

using Post = std::pair<int, int>;
using Triangle = std::array<Post, 3>;

int twice_area(const Triangle& t) {
    return (t[1].first - t[0].first) * (t[2].second - t[0].second) -
           (t[2].first - t[0].first) * (t[1].second - t[0].second);
}

// rises: by quad. drawn: as the shaders have it, or each quad as its level says.
std::vector<Triangle> triangles_of(const glm::uvec2& quads, std::uint32_t edges,
                                   const std::vector<bool>& sw_ne, bool drawn) {
    std::vector<Triangle> triangles;
    for (unsigned row = 0; row < quads.x; ++row) {
        for (unsigned column = 0; column < quads.y; ++column) {
            bool is_sw_ne = sw_ne[row * quads.y + column];
            if (drawn) is_sw_ne = gpu::drawn_sw_ne(is_sw_ne, {row, column}, quads, edges);
            for (const bool west : {true, false}) {
                Triangle triangle;
                const CellCorners at = cell_corners(is_sw_ne ? Diagonal::sw_ne : Diagonal::nw_se, west);
                for (std::size_t i = 0; i < 3; ++i) {
                    const glm::uvec2 post(row + static_cast<unsigned>(at[i][0]),
                                          column + static_cast<unsigned>(at[i][1]));
                    const glm::uvec2 to = gpu::stitched_post(post, quads, edges);
                    triangle[i] = {static_cast<int>(to.x), static_cast<int>(to.y)};
                }
                if (twice_area(triangle) != 0) triangles.push_back(triangle);
            }
        }
    }
    return triangles;
}

// Empty where all is well.
std::string fault_of(const std::vector<Triangle>& triangles, const glm::uvec2& quads, std::uint32_t edges) {
    int area = 0;
    std::map<std::pair<Post, Post>, int> sides;
    for (const Triangle& triangle : triangles) {
        if (twice_area(triangle) < 0) return "a triangle is folded over";
        area += twice_area(triangle);
        for (std::size_t i = 0; i < 3; ++i) ++sides[{triangle[i], triangle[(i + 1) % 3]}];
    }
    if (area != static_cast<int>(2 * quads.x * quads.y)) return "the area does not add up";
    const int last_row = static_cast<int>(quads.x), last_column = static_cast<int>(quads.y);
    for (const auto& [side, count] : sides) {
        const auto& [from, to] = side;
        if (count != 1) return "a side is there twice";
        if (sides.contains({to, from})) continue;
        // On the node's rim, from a post to the next that a neighbour has.
        const bool north = from.first == 0 && to.first == 0,
                   south = from.first == last_row && to.first == last_row;
        const bool west = from.second == 0 && to.second == 0,
                   east = from.second == last_column && to.second == last_column;
        if (!north && !south && !west && !east) return "a side within the node has no other";
        const bool stitched =
            (north && (edges & gpu::edge_north) != 0) || (south && (edges & gpu::edge_south) != 0) ||
            (west && (edges & gpu::edge_west) != 0) || (east && (edges & gpu::edge_east) != 0);
        const int length = std::abs(from.first - to.first) + std::abs(from.second - to.second);
        const int from_post =
            north || south ? std::min(from.second, to.second) : std::min(from.first, to.first);
        const int last = north || south ? last_column : last_row;
        if (length != (stitched ? std::min(2, last - from_post) : 1))
            return "a side on the rim is of no neighbour";
        if (stitched && from_post % 2 != 0) return "a side on the rim begins at a post that was left out";
    }
    return {};
}

TEST(StitchedQuads, AreWholeWhicheverDiagonalsTheyHave) {
    const unsigned seed = 81;
    std::mt19937_64 random(seed);
    int nodes = 0;
    for (unsigned rows = 1; rows <= 8; ++rows) {
        for (unsigned columns = 1; columns <= 8; ++columns) {
            for (std::uint32_t edges = 0; edges < 16; ++edges) {
                for (int run = 0; run < 40; ++run) {
                    std::vector<bool> sw_ne(std::size_t{rows} * columns);
                    for (std::size_t i = 0; i < sw_ne.size(); ++i)
                        sw_ne[i] = run == 0 ? false : run == 1 || random() % 2 == 0;
                    ASSERT_EQ(
                        fault_of(triangles_of({rows, columns}, edges, sw_ne, true), {rows, columns}, edges),
                        "")
                        << "seed " << seed << ", " << rows << " x " << columns << ", edges " << edges;
                    ++nodes;
                }
            }
        }
    }
    std::printf("seed %u: %d nodes\n", seed, nodes);
}

// All 2^9 diagonals of 3 x 3 quads, whose corners are those of larger ones.
TEST(StitchedQuads, AllOfASmallNode) {
    for (std::uint32_t edges = 0; edges < 16; ++edges) {
        for (unsigned bits = 0; bits < 512; ++bits) {
            std::vector<bool> sw_ne(9);
            for (std::size_t i = 0; i < 9; ++i) sw_ne[i] = (bits >> i & 1U) != 0;
            ASSERT_EQ(fault_of(triangles_of({3, 3}, edges, sw_ne, true), {3, 3}, edges), "")
                << edges << " " << bits;
        }
    }
}

// The test can fail: where two stitched edges meet in the south-east the rising diagonal passes by a post
// that the quads beside it keep. Nowhere else.
TEST(StitchedQuads, OneCornerMustFall) {
    const glm::uvec2 quads(8, 8);
    for (std::uint32_t edges = 0; edges < 16; ++edges) {
        const bool corner = (edges & gpu::edge_south) != 0 && (edges & gpu::edge_east) != 0;
        const std::string fault =
            fault_of(triangles_of(quads, edges, std::vector<bool>(64, true), false), quads, edges);
        EXPECT_EQ(fault, corner ? "a side within the node has no other" : "") << edges;
    }
}

}  // namespace
}  // namespace oro
