// Which halves of a page's meshlets are told to have triangles: at a region's ends, and where posts are void.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "core/lod/levels_gpu.h"
#include "core/terrain/page.h"
#include "tests/support/made_terrain.h"

namespace oro {
namespace {

constexpr int page_meshlets = static_cast<int>(gpu::meshlets_per_side);

HeightField hills(int rows, int columns) {
    return test::made_field(46.0, 8.0, 1200.0, rows, columns, [](double lat_deg, double lon_deg) {
        return static_cast<float>(500.0 + 90.0 * std::sin(900.0 * lat_deg) * std::cos(700.0 * lon_deg));
    });
}

std::unique_ptr<gpu::PageBlock> block_of(const HeightField& field) {
    auto block = std::make_unique<gpu::PageBlock>();
    build_page(field, region_shape(field, 1.0), {0, 0}, *block);
    return block;
}

gpu::uint halves_of(const gpu::PageBlock& block, int row, int column) {
    return block.boxes[row * page_meshlets + column] >> gpu::halves_bit;
}

float& H_of(HeightField& field, int row, int column) {
    return field.H_m[static_cast<std::size_t>(row * field.grid.columns() + column)];
}

// All that a region may leave of its last meshlets: 1 to 8 rows and columns.
TEST(HalvesOfAPage, EndWithTheRegion) {
    for (int rows = 1; rows <= 8; ++rows) {
        for (int columns = 1; columns <= 8; ++columns) {
            const auto block = block_of(hills(8 + rows + 1, 8 + columns + 1));
            const gpu::uint by_columns = columns <= 4 ? gpu::first_columns : gpu::both_halves;
            const gpu::uint by_rows = rows <= 4 ? gpu::first_rows : gpu::both_halves;
            EXPECT_EQ(halves_of(*block, 0, 0), gpu::both_halves) << rows << " x " << columns;
            EXPECT_EQ(halves_of(*block, 1, 0), by_rows) << rows << " x " << columns;
            EXPECT_EQ(halves_of(*block, 0, 1), by_columns) << rows << " x " << columns;
            EXPECT_EQ(halves_of(*block, 1, 1), rows <= 4 ? by_rows : by_columns) << rows << " x " << columns;
        }
    }
}

// What is void north of a row, south of one, and east of a column.
TEST(HalvesOfAPage, EndWithTheData) {
    for (int line = 0; line <= 16; ++line) {
        HeightField north = hills(129, 129), south = north, east = north;
        for (int row = 0; row < 129; ++row) {
            for (int column = 0; column < 129; ++column) {
                if (row < line) H_of(north, row, column) = void_height_m;
                if (row > line) H_of(south, row, column) = void_height_m;
                if (column > line) H_of(east, row, column) = void_height_m;
            }
        }
        const auto of_north = block_of(north), of_south = block_of(south), of_east = block_of(east);
        // A row of posts that is left has no triangle.
        EXPECT_EQ(halves_of(*of_north, 1, 3), line >= 12 && line < 16 ? gpu::last_rows : gpu::both_halves)
            << line;
        if (line < 9) continue;
        EXPECT_EQ(halves_of(*of_south, 1, 3), line <= 12 ? gpu::first_rows : gpu::both_halves) << line;
        EXPECT_EQ(halves_of(*of_east, 3, 1), line <= 12 ? gpu::first_columns : gpu::both_halves) << line;
    }
}

// Triangles of a meshlet as shaders make them, whatever its edges: of its first and last rows, and columns.
std::array<int, 4> triangles_of(const gpu::PageBlock& block, int meshlet, gpu::uvec2 quads) {
    const gpu::uvec2 first = 8U * gpu::uvec2(meshlet / page_meshlets, meshlet % page_meshlets);
    std::array<int, 4> count{};
    for (gpu::uint edges = 0; edges < 16; ++edges) {
        for (gpu::uint quad = 0; quad < 64; ++quad) {
            const gpu::uvec2 nw(quad / 8, quad % 8);
            const bool sw_ne = gpu::drawn_sw_ne(
                (block.sw_ne[static_cast<gpu::uint>(meshlet) * 2 + quad / 32] >> quad % 32 & 1U) != 0, nw,
                quads, edges);
            const auto at = [&](gpu::uint row, gpu::uint column) {
                return first + gpu::stitched_post(nw + gpu::uvec2(row, column), quads, edges);
            };
            for (const gpu::uint odd : {0U, 1U}) {
                const gpu::uvec2 a = sw_ne && odd != 0 ? at(1, 0) : at(0, 0),
                                 b = odd == 0 ? at(1, 0) : at(1, 1),
                                 c = sw_ne || odd != 0 ? at(0, 1) : at(1, 1);
                const auto there = [&](gpu::uvec2 post) {
                    return block.heights[(post.x + 1) * 131 + post.y + 1] != gpu::void_height;
                };
                const glm::ivec2 ab = glm::ivec2(b) - glm::ivec2(a), ac = glm::ivec2(c) - glm::ivec2(a);
                if (!there(a) || !there(b) || !there(c) || ab.x * ac.y == ab.y * ac.x) continue;
                ++count[nw.x < 4 ? 0 : 1];
                ++count[nw.y < 4 ? 2 : 3];
            }
        }
    }
    return count;
}

// Void posts by chance, few to nearly all, single or in strips: no half is left out that any edges give a
// triangle, and few are kept in vain.
TEST(HalvesOfAPage, LeaveOutNoTriangle) {
    constexpr unsigned seed = 91;
    std::mt19937 random(seed);
    int alone = 0, in_vain = 0, drawn = 0;
    for (int i = 0; i < 24; ++i) {
        const int rows = 100 + static_cast<int>(random() % 30),
                  columns = 100 + static_cast<int>(random() % 30);
        HeightField field = hills(rows, columns);
        const unsigned strip = i % 2 == 0 ? 1 : 5, of_hundred = 20 + 3 * static_cast<unsigned>(i);
        for (int row = 0; row < rows; ++row) {
            for (int column = 0; column < columns;) {
                const bool is_void = random() % 100 < of_hundred;
                for (unsigned k = 0; k < strip && column < columns; ++k, ++column)
                    if (is_void) H_of(field, row, column) = void_height_m;
            }
        }
        const auto block = block_of(field);
        for (int meshlet = 0; meshlet < page_meshlets * page_meshlets; ++meshlet) {
            if (block->meshlets[meshlet].radius < 0.0F) continue;
            const gpu::uvec2 left = gpu::uvec2(rows - 1, columns - 1) -
                                    8U * gpu::uvec2(meshlet / page_meshlets, meshlet % page_meshlets);
            const std::array<int, 4> count = triangles_of(*block, meshlet, glm::min(left, gpu::uvec2(8)));
            const gpu::uint halves = block->boxes[meshlet] >> gpu::halves_bit;
            ++drawn;
            alone += halves != gpu::both_halves;
            // By halves: what would be lost.
            const std::array<int, 4> lost{0, count[1], count[0], count[3]};
            EXPECT_EQ(lost[halves], 0) << "field " << i << " meshlet " << meshlet;
            in_vain += halves == gpu::both_halves && (count[0] == 0 || count[1] == 0 || count[3] == 0);
        }
    }
    std::printf("seed %u: %d meshlets with triangles, of %d one half is left out, %d have one in vain\n",
                seed, drawn, alone, in_vain);
    EXPECT_GT(alone, 100);
    EXPECT_LT(in_vain, drawn / 4);
}

}  // namespace
}  // namespace oro
