#include "core/terrain/cell_diagonals.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/parallel.h"
#include "core/base/wide.h"
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
    steps.front() = steps.back() = no_decisive_steps;
    if (level_row < 0 || level_row > level.row.quads) {
        std::ranges::fill(steps, no_decisive_steps);
        return;
    }
    const int row = level.row.region_post(level_row);
    const auto quads = static_cast<std::size_t>(level.column.quads);
    std::size_t i = 0;
    // But for the last column these are points of their own.
    if (row > 0 && row < field.grid.rows() - 1 && !field.posts) {
        const float* const H_m =
            &field.H_m[static_cast<std::size_t>(row) * static_cast<std::size_t>(field.grid.columns())];
        for (; i < quads; ++i) steps[i + 1] = decisive_steps(H_m[i << static_cast<unsigned>(level.level())]);
    }
    for (; i <= quads; ++i)
        steps[i + 1] = steps_of(field, row, level.column.region_post(static_cast<int>(i)));
    if (!field.grid.wraps_longitude()) return;
    steps[0] = steps[quads];
    steps[quads + 2] = steps[2];
}

}  // namespace

std::int32_t decisive_steps_at(const HeightField& field, int row, int column,
                               const std::vector<char>* masked) {
    const PostGrid& grid = field.grid;
    const int turn = grid.wraps_longitude() ? grid.columns() - 1 : 0;
    if (column < 0) column += turn;
    if (column >= grid.columns()) column -= turn;
    if (row < 0 || row >= grid.rows() || column < 0 || column >= grid.columns()) return no_decisive_steps;
    if (masked != nullptr &&
        (*masked)[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns()) +
                  static_cast<std::size_t>(column)] != 0)
        return no_decisive_steps;
    return steps_of(field, row, column);
}

void decisive_steps_of_row(const HeightField& field, int row, int first_column,
                           const std::vector<char>* masked, std::span<std::int32_t> steps) {
    const PostGrid& grid = field.grid;
    const int count = static_cast<int>(steps.size());
    const auto at = [&](int i) -> std::int32_t& { return steps[static_cast<std::size_t>(i)]; };
    // Posts that are points of their own, and within the region.
    int from = count, to = count;
    if (row > 0 && row < grid.rows() - 1 && masked == nullptr) {
        from = std::clamp(-first_column, 0, count);
        to = std::clamp(grid.columns() - 1 - first_column, from, count);
        std::vector<float> read(field.posts ? static_cast<std::size_t>(to - from) : 0);
        if (field.posts) field.posts->row_H_m(row, first_column + from, read);
        const float* const H_m =
            field.posts
                ? read.data()
                : field.H_m.data() + static_cast<std::ptrdiff_t>(row) * grid.columns() + first_column + from;
        for (int i = from; i < to; ++i) at(i) = decisive_steps(H_m[i - from]);
    }
    for (int i = 0; i < from; ++i) at(i) = decisive_steps_at(field, row, first_column + i, masked);
    for (int i = to; i < count; ++i) at(i) = decisive_steps_at(field, row, first_column + i, masked);
}

Diagonal cell_diagonal(const HeightField& field, int row, int column, const std::vector<char>* masked) {
    return diagonal_of([&](int r, int c) { return decisive_steps_at(field, r, c, masked); }, row, column);
}

// What DiagonalRows does with a row's numbers, all alike. See weighed_steps() and nearer_diagonal().
ORO_WIDE void weigh_rows(std::size_t cells, const double* steps, double* weighed) {
    for (std::size_t i = 0; i < cells; ++i)
        weighed[i] = 9.0 * (steps[i + 1] + steps[i + 2]) - steps[i] - steps[i + 3];
}
ORO_WIDE void decide_rows(std::size_t cells, const std::array<const double*, 4>& weighed, const double* north,
                          const double* south, std::uint8_t* sw_ne) {
    for (std::size_t i = 0; i < cells; ++i) {
        const double smooth = 9.0 * (weighed[1][i] + weighed[2][i]) - weighed[0][i] - weighed[3][i];
        const double of_nw_se = 128.0 * (north[i + 1] + south[i + 2]) - smooth;
        const double of_sw_ne = 128.0 * (north[i + 2] + south[i + 1]) - smooth;
        sw_ne[i] = std::abs(of_sw_ne) < std::abs(of_nw_se) ? 1 : 0;
    }
}

DiagonalRows::DiagonalRows(int cells) : sw_ne_(static_cast<std::size_t>(cells + 7) / 8 * 8, 0) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (Row& row : rows_) {
        row.filled.assign(static_cast<std::size_t>(cells) + 3, no_decisive_steps);
        row.steps.assign(static_cast<std::size_t>(cells) + 3, none);
        row.weighed.assign(static_cast<std::size_t>(cells), none);
    }
}

std::span<std::int32_t> DiagonalRows::next() {
    first_ = (first_ + 1) % 4;
    return rows_[static_cast<std::size_t>((first_ + 3) % 4)].filled;
}

void DiagonalRows::take() {
    Row& last = rows_[static_cast<std::size_t>((first_ + 3) % 4)];
    for (std::size_t i = 0; i < last.filled.size(); ++i)
        last.steps[i] = last.filled[i] == no_decisive_steps ? std::numeric_limits<double>::quiet_NaN()
                                                            : static_cast<double>(last.filled[i]);
    weigh_rows(last.weighed.size(), last.steps.data(), last.weighed.data());
}

void DiagonalRows::decide(std::span<std::uint8_t> bits) {
    decide_rows(row(0).weighed.size(),
                {row(0).weighed.data(), row(1).weighed.data(), row(2).weighed.data(), row(3).weighed.data()},
                row(1).steps.data(), row(2).steps.data(), sw_ne_.data());
    for (std::size_t i = 0; i < bits.size(); ++i) {
        unsigned eight = 0;
        for (unsigned k = 0; k < 8; ++k) eight |= static_cast<unsigned>(sw_ne_[8 * i + k]) << k;
        bits[i] = static_cast<std::uint8_t>(eight);
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
    auto all = std::make_shared<CellDiagonals>();
    // As far as there is a coarser one, whatever levels are drawn.
    do all->levels_.push_back(level_of(field, static_cast<int>(all->levels_.size()), threads));
    while (std::max(all->levels_.back().rows, all->levels_.back().columns) > 1);
    return all;
}

}  // namespace oro
