// The posts of a part of a grid and around it, taken once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/parallel.h"
#include "core/terrain/cell_diagonal.h"
#include "core/terrain/grid_part.h"
#include "core/terrain/post_grid.h"
#include "core/terrain/post_spacing.h"

namespace oro {

// How far posts are apart on a row, fractional; on a net in the row's middle. It follows from the grid and
// the row alone, so that it is the same for whichever part it is asked of.
inline PostSpacing spacing_on_row(const PostGrid& grid, double row) {
    return post_spacing_at(grid, row, 0.5 * (grid.columns() - 1));
}

// Those of a part and so many around it, as far as the grid has any. Rows and columns are numbered from the
// first that is taken.
class TakenPosts {
  public:
    // still: by post of the part; may be empty.
    TakenPosts(const HeightField& field, const GridPart& part, int margin, std::span<const char> still)
        : first_row_(std::max(part.first_row - margin, 0)),
          first_column_(std::max(part.first_column - margin, 0)),
          rows_(std::min(part.first_row + part.rows + margin, field.grid.rows()) - first_row_),
          columns_(std::min(part.first_column + part.columns + margin, field.grid.columns()) - first_column_),
          H_m_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_)),
          still_(H_m_.size()) {
        in_parallel(rows_, thread_count(), [&](int row) {
            for (int column = 0; column < columns_; ++column) {
                const int of_row = first_row_ + row, of_column = first_column_ + column;
                H_m_[number(row, column)] = field.H_at_post_m(of_row, of_column);
                const bool inside = of_row >= part.first_row && of_row < part.first_row + part.rows &&
                                    of_column >= part.first_column &&
                                    of_column < part.first_column + part.columns;
                if (inside && !still.empty())
                    still_[number(row, column)] = still[part.number(of_row, of_column)];
            }
        });
    }

    [[nodiscard]] int rows() const { return rows_; }
    [[nodiscard]] int columns() const { return columns_; }
    // Of a row and a column of the grid.
    [[nodiscard]] int row_of(int grid_row) const { return grid_row - first_row_; }
    [[nodiscard]] int column_of(int grid_column) const { return grid_column - first_column_; }
    // ... and the other way.
    [[nodiscard]] int grid_row(int row) const { return row + first_row_; }
    [[nodiscard]] int grid_column(int column) const { return column + first_column_; }
    [[nodiscard]] bool has(int row, int column) const {
        return row >= 0 && column >= 0 && row < rows_ && column < columns_;
    }
    [[nodiscard]] float H_m(int row, int column) const { return H_m_[number(row, column)]; }
    [[nodiscard]] std::int32_t steps(int row, int column) const { return decisive_steps(H_m(row, column)); }
    [[nodiscard]] bool is_still(int row, int column) const { return still_[number(row, column)] != 0; }

  private:
    [[nodiscard]] std::size_t number(int row, int column) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    int first_row_, first_column_, rows_, columns_;
    std::vector<float> H_m_;
    std::vector<char> still_;
};

}  // namespace oro
