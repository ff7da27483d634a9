// Where the posts of a page lie among those of the region.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/terrain/level_grid.h"
#include "core/terrain/page.h"

namespace oro {

// Where the posts of a page lie in the region.
class PagePosts {
  public:
    PagePosts(const PostGrid& grid, PageIndex index)
        : level_(level_grid(grid, index.level)),
          first_row_(index.row * static_cast<int>(gpu::page_quads)),
          first_column_(index.column * static_cast<int>(gpu::page_quads)),
          wraps_longitude_(grid.wraps_longitude()) {}

    // The region's row at a page's row -1 .. 129; -1 outside the region.
    [[nodiscard]] int region_row(int row) const {
        const int level_row = first_row_ + row;
        return level_row < 0 || level_row > level_.row.quads ? -1 : level_.row.region_post(level_row);
    }
    // The column in the region of a column of the page. The apron goes on round the Earth.
    [[nodiscard]] int region_column(int column) const {
        int level_column = first_column_ + column;
        const int quads_round = level_.column.quads;
        if (wraps_longitude_) {
            if (level_column == -1) level_column = quads_round - 1;
            if (level_column == quads_round + 1 && column == static_cast<int>(gpu::page_posts))
                level_column = 1;
        }
        return level_column < 0 || level_column > quads_round ? -1 : level_.column.region_post(level_column);
    }
    // Of columns -1 .. 129.
    [[nodiscard]] std::array<int, gpu::height_stride> region_columns() const {
        std::array<int, gpu::height_stride> columns{};
        for (std::size_t i = 0; i < columns.size(); ++i) columns[i] = region_column(static_cast<int>(i) - 1);
        return columns;
    }
    // The region's post at a page's row and column, -1 .. 129; nothing outside the region.
    [[nodiscard]] std::optional<PageIndex> region_post(int row, int column) const {
        const PageIndex post{region_row(row), region_column(column)};
        return post.row < 0 || post.column < 0 ? std::nullopt : std::optional(post);
    }
    [[nodiscard]] const LevelGrid& level() const { return level_; }
    [[nodiscard]] int first_row() const { return first_row_; }  // of the level's posts
    [[nodiscard]] int first_column() const { return first_column_; }

  private:
    LevelGrid level_;
    int first_row_;
    int first_column_;
    bool wraps_longitude_;
};

}  // namespace oro
