// The diagonals of all cells of a region, on all its levels.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/terrain/cell_diagonal.h"
#include "core/terrain/level_grid.h"

namespace oro {

// A bit for each cell of all levels down to one of a single cell: 0.17 byte a post. A level decides by its
// own posts, every 2^k-th of the region's and the last.
class CellDiagonals {
  public:
    // Never null. Reads every post; the work is shared between `threads`, with one result for any
    // number: some 5 ns a post.
    static std::shared_ptr<const CellDiagonals> of(const HeightField& field, int threads);

    // The diagonals of a part of level 0, whose first column is a whole multiple of 8: what GridSurface needs
    // of a window.
    [[nodiscard]] std::shared_ptr<const CellDiagonals> part(int first_row, int first_column, int rows,
                                                            int columns) const;

    // The diagonal of a cell of a level, by the level's own rows and columns.
    [[nodiscard]] Diagonal at(int level, int row, int column) const {
        return (eight(level, row, column) >> (column % 8) & 1) != 0 ? Diagonal::sw_ne : Diagonal::nw_se;
    }
    // Of the eight cells that begin at a whole multiple of 8 columns: a bit for each that is sw_ne, the first
    // the lowest.
    [[nodiscard]] std::uint8_t eight(int level, int row, int column) const {
        const Level& own = levels_[static_cast<std::size_t>(level)];
        return own.bits[static_cast<std::size_t>(row) * own.row_bytes + static_cast<std::size_t>(column / 8)];
    }
    // Cells of a level, rows and columns.
    [[nodiscard]] int rows(int level) const { return levels_[static_cast<std::size_t>(level)].rows; }
    [[nodiscard]] int columns(int level) const { return levels_[static_cast<std::size_t>(level)].columns; }

  private:
    struct Level {
        int rows{};
        int columns{};
        std::size_t row_bytes{};
        std::vector<std::uint8_t> bits;
    };
    static Level level_of(const HeightField& field, int level, int threads);
    std::vector<Level> levels_;
};

// decisive_steps_at() of the posts of a row, from first_column on.
void decisive_steps_of_row(const HeightField& field, int row, int first_column,
                           const std::vector<char>* masked, std::span<std::int32_t> steps);

// Decides row after row: gets the posts' decisive_steps() row by row, from one post west of the first cell to
// one east of the last.
class DiagonalRows {
  public:
    explicit DiagonalRows(int cells);
    // The next row of posts, southwards. Of its cells + 3 posts the first is that west of the first cell.
    [[nodiscard]] std::span<std::int32_t> next();
    // To be called when that row is filled.
    void take();
    // Of the cells between the second and the third of the last four rows: eight a byte, the first the lowest
    // bit.
    void decide(std::span<std::uint8_t> bits);

  private:
    // As doubles, NaN where a post has no height: whole numbers below 2^53, so that it is exact, and what has
    // a NaN in it is no less than anything.
    struct Row {
        std::vector<std::int32_t> filled;
        std::vector<double> steps;
        std::vector<double> weighed;
    };
    [[nodiscard]] const Row& row(int number) const {
        return rows_[static_cast<std::size_t>((first_ + number) % 4)];
    }
    std::array<Row, 4> rows_;
    int first_{0};
    std::vector<std::uint8_t> sw_ne_;  // of each cell, and up to a whole multiple of 8
};

}  // namespace oro
