// Cells of the ground as bytes: the same come back, and any bytes are cells in order or refused.
#include "core/streamed_mesh/ground_cells.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace oro {
namespace {

// Blocks of houses: boxes of cells in some rows, and some cells alone.
GroundCells cells_of_blocks(int grids) {
    std::mt19937 random(7);
    GroundCells cells{46.0, 46.5, 8.25, 8.75, {}};
    for (int i = 0; i < grids; ++i) {
        GroundCells::Grid& grid = cells.grids.emplace_back();
        grid.posts = (std::uint64_t{random()} << 32U) | random();
        for (std::uint32_t row = 100; row < 400; row += row % 20 == 19 ? 8 : 1)
            for (std::uint32_t block = 0; block < 12; ++block)
                grid.runs.push_back({row, 2000 + 40 * block + row / 20, 20 + row / 20 % 5});
        grid.runs.push_back({70000, 3, 1});
    }
    return cells;
}

TEST(GroundCells, ComeBackFromTheirBytes) {
    for (const int grids : {1, 3}) {
        const GroundCells cells = cells_of_blocks(grids);
        const std::vector<std::byte> bytes = ground_cells_to_bytes(cells);
        GroundCells read;
        const auto wrong = ground_cells_from_bytes(bytes, read);
        ASSERT_FALSE(wrong) << *wrong;
        EXPECT_EQ(read, cells);
        EXPECT_EQ(read.count(), cells.count());
        std::printf("%zu cells in %zu runs: %zu bytes\n", cells.count(), cells.grids[0].runs.size() * grids,
                    bytes.size());
        EXPECT_LT(bytes.size(), cells.grids[0].runs.size() * static_cast<std::size_t>(grids));
        for (std::size_t size = 0; size < bytes.size(); size += 13)
            EXPECT_TRUE(ground_cells_from_bytes(std::span(bytes).first(size), read)) << size;
    }
    // A grid that has none of them.
    GroundCells none{1.0, 1.0, 2.0, 2.0, {{17, {}}}}, read;
    EXPECT_FALSE(ground_cells_from_bytes(ground_cells_to_bytes(none), read));
    EXPECT_EQ(read, none);
}

TEST(GroundCells, ThatAreNoneAreRefused) {
    const auto refusal = [](const auto& change) {
        GroundCells cells = cells_of_blocks(1), read;
        change(cells);
        return ground_cells_from_bytes(ground_cells_to_bytes(cells), read).value_or("");
    };
    EXPECT_EQ(refusal([](GroundCells&) {}), "");
    EXPECT_EQ(refusal([](GroundCells& cells) { cells.grids.clear(); }), "has ground of a place that is none");
    EXPECT_EQ(refusal([](GroundCells& cells) { cells.north_deg = 95.0; }),
              "has ground of a place that is none");
    EXPECT_EQ(refusal([](GroundCells& cells) { cells.east_deg = 8.0; }),
              "has ground of a place that is none");
    const auto run = [](GroundCells& cells) -> GroundCells::Run& { return cells.grids[0].runs[500]; };
    EXPECT_EQ(refusal([&](GroundCells& cells) { run(cells).count = 0; }),
              "has ground of cells that are none");
    EXPECT_EQ(refusal([&](GroundCells& cells) { run(cells).row += 1; }), "has ground of cells that are none");
    EXPECT_EQ(refusal([&](GroundCells& cells) { run(cells).count += 100; }),
              "has ground of cells that are none");
    EXPECT_EQ(refusal([&](GroundCells& cells) {
                  for (std::uint32_t i = 1; i < 9; ++i) cells.grids[0].runs.push_back({70000 + i, 0, 500000});
              }),
              "has ground of cells that are none");
    std::vector<std::byte> bytes = ground_cells_to_bytes(cells_of_blocks(1));
    bytes.push_back(std::byte{0});
    GroundCells read;
    EXPECT_EQ(ground_cells_from_bytes(bytes, read).value_or(""),
              "has ground that goes on after its last cell");
}

// 5,000 changes: refused, or rows of cells that do not touch, within the bounds.
TEST(GroundCells, OfAnyBytesAreInOrderOrRefused) {
    const std::vector<std::byte> bytes = ground_cells_to_bytes(cells_of_blocks(2));
    std::mt19937 random(8);
    int taken = 0;
    for (int i = 0; i < 5000; ++i) {
        std::vector<std::byte> changed = bytes;
        for (std::uint32_t k = 0; k <= random() % 3; ++k)
            changed[random() % changed.size()] = static_cast<std::byte>(random());
        GroundCells cells;
        if (ground_cells_from_bytes(changed, cells)) continue;
        ++taken;
        ASSERT_LE(cells.count(), most_ground_cells);
        for (const GroundCells::Grid& grid : cells.grids)
            for (std::size_t k = 1; k < grid.runs.size(); ++k) {
                const GroundCells::Run &a = grid.runs[k - 1], &b = grid.runs[k];
                ASSERT_GT(b.count, 0U);
                ASSERT_TRUE(b.row > a.row || (b.row == a.row && b.column > a.column + a.count));
            }
    }
    std::printf("%d of 5,000 changes left cells\n", taken);
    EXPECT_LT(taken, 2000);
}

}  // namespace
}  // namespace oro
