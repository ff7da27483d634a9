// The longitudes of a grid's columns of posts: kept from frame to frame.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/terrain/level_grid.h"
#include "core/terrain/post_grid.h"

namespace oro {

// 8 bytes a column, and for each column of pages of a level that was asked for. Of a grid without a net. For
// one thread at a time.
class ColumnAngles {
  public:
    // The grid outlives it.
    explicit ColumnAngles(const PostGrid& grid) : grid_(&grid) {}

    // Degrees east of so many columns of the grid from a first one on, in the grid's own whole turn; where it
    // goes round the Earth its last column is its first.
    [[nodiscard]] std::span<const double> of(int first, int count);
    // ... of the gpu::page_posts columns of a column of pages of a level.
    [[nodiscard]] std::span<const double> of_pages(const LevelAxis& level, int page_column);

  private:
    const PostGrid* grid_;
    std::vector<double> columns_;
    std::vector<std::vector<std::vector<double>>> pages_;  // by level, then by column of pages
};

}  // namespace oro
