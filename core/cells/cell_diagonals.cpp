#include "core/cells/cell_diagonals.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "core/base/parallel.h"
#include "core/terrain/drawn_heights.h"

namespace oro {
namespace {

// H of a post that the region has, as all that are the same point have it.
std::int32_t steps_of(const HeightField& field, int row, int column) {
    if (row == 0 || row == field.grid.rows() - 1 || column == field.grid.columns() - 1)
        column = canonical_column(field, row, column);
    return decisive_steps(field.H_at_post_m(row, column));
}

// A row of a level's posts, with one more on either side.
void fill_row(const HeightField& field, const LevelGrid& level, int level_row,
              std::span<std::int32_t> steps) {
    std::ranges::fill(steps, no_decisive_steps);
    if (level_row < 0 || level_row > level.row.quads) return;
    const int row = level.row.region_post(level_row);
    const auto quads = static_cast<std::size_t>(level.column.quads);
    for (std::size_t i = 0; i <= quads; ++i)
        steps[i + 1] = steps_of(field, row, level.column.region_post(static_cast<int>(i)));
    if (!field.grid.goes_round()) return;
    steps[0] = steps[quads];
    steps[quads + 2] = steps[2];
}

}  // namespace

std::int32_t decisive_steps_at(const HeightField& field, int row, int column,
                               const std::vector<char>* left_out) {
    const PostGrid& grid = field.grid;
    const int turn = grid.goes_round() ? grid.columns() - 1 : 0;
    if (column < 0) column += turn;
    if (column >= grid.columns()) column -= turn;
    if (row < 0 || row >= grid.rows() || column < 0 || column >= grid.columns()) return no_decisive_steps;
    if (left_out != nullptr &&
        (*left_out)[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                    static_cast<std::size_t>(column)] != 0)
        return no_decisive_steps;
    return steps_of(field, row, column);
}

Diagonal cell_diagonal(const HeightField& field, int row, int column, const std::vector<char>* left_out) {
    if (field.grid.split == CellSplit::all_fall) return Diagonal::falls;
    return diagonal_of([&](int r, int c) { return decisive_steps_at(field, r, c, left_out); }, row, column);
}

DiagonalRows::DiagonalRows(int cells) : cells_(cells) {
    for (Row& row : rows_) {
        row.steps.assign(static_cast<std::size_t>(cells) + 3, no_decisive_steps);
        row.weighed.assign(static_cast<std::size_t>(cells), no_weighed_steps);
    }
}

std::span<std::int32_t> DiagonalRows::next() {
    first_ = (first_ + 1) % 4;
    return rows_[static_cast<std::size_t>((first_ + 3) % 4)].steps;
}

void DiagonalRows::take() {
    Row& last = rows_[static_cast<std::size_t>((first_ + 3) % 4)];
    for (std::size_t i = 0; i < last.weighed.size(); ++i)
        last.weighed[i] =
            weighed_steps(last.steps[i], last.steps[i + 1], last.steps[i + 2], last.steps[i + 3]);
}

void DiagonalRows::decide(std::span<std::uint8_t> bits) const {
    std::ranges::fill(bits, std::uint8_t{0});
    const Row &north = row(1), &south = row(2);
    for (std::size_t i = 0; i < static_cast<std::size_t>(cells_); ++i) {
        const Diagonal diagonal =
            nearer_diagonal({row(0).weighed[i], north.weighed[i], south.weighed[i], row(3).weighed[i]},
                            north.steps[i + 1], north.steps[i + 2], south.steps[i + 1], south.steps[i + 2]);
        if (diagonal == Diagonal::rises) bits[i / 8] = static_cast<std::uint8_t>(bits[i / 8] | 1U << (i % 8));
    }
}

CellDiagonals::Level CellDiagonals::level_of(const HeightField& field, int level, int threads) {
    const LevelGrid grid = level_grid(field.grid, level);
    Level made{grid.row.quads, grid.column.quads, static_cast<std::size_t>((grid.column.quads + 7) / 8), {}};
    made.bits.resize(static_cast<std::size_t>(made.rows) * made.row_bytes);
    constexpr int band_rows = 64;
    in_parallel((made.rows + band_rows - 1) / band_rows, threads, [&](int band) {
        DiagonalRows rows(made.columns);
        const int first = band * band_rows, end = std::min(first + band_rows, made.rows);
        for (int row = first - 1; row <= end + 1; ++row) {
            fill_row(field, grid, row, rows.next());
            rows.take();
            const int cell_row = row - 2;
            if (cell_row < first) continue;
            rows.decide(std::span(made.bits).subspan(static_cast<std::size_t>(cell_row) * made.row_bytes,
                                                     made.row_bytes));
        }
    });
    return made;
}

std::shared_ptr<const CellDiagonals> CellDiagonals::part(int first_row, int first_column, int rows,
                                                         int columns) const {
    assert(first_column % 8 == 0);
    auto made = std::make_shared<CellDiagonals>();
    Level level{rows, columns, static_cast<std::size_t>((columns + 7) / 8), {}};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; column += 8)
            level.bits.push_back(eight(0, first_row + row, first_column + column));
    }
    made->levels_.push_back(std::move(level));
    return made;
}

std::shared_ptr<const CellDiagonals> CellDiagonals::of(const HeightField& field, int threads) {
    if (field.grid.split == CellSplit::all_fall) return nullptr;
    auto all = std::make_shared<CellDiagonals>();
    // As far as there is a coarser one, whatever levels are drawn.
    do all->levels_.push_back(level_of(field, static_cast<int>(all->levels_.size()), threads));
    while (std::max(all->levels_.back().rows, all->levels_.back().columns) > 1);
    return all;
}

}  // namespace oro
