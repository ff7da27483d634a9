// Where the posts of a page lie among those of the region.
#pragma once

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
          goes_round_(grid.goes_round()) {}

    // The region's post at a page's row and column, -1 .. 129; nothing outside the region. The apron goes on
    // round the Earth.
    [[nodiscard]] std::optional<PageIndex> region_post(int row, int column) const {
        const int level_row = first_row_ + row;
        int level_column = first_column_ + column;
        const int quads_round = level_.column.quads;
        if (goes_round_) {
            if (level_column == -1) level_column = quads_round - 1;
            if (level_column == quads_round + 1 && column == static_cast<int>(gpu::page_posts))
                level_column = 1;
        }
        if (level_row < 0 || level_row > level_.row.quads) return std::nullopt;
        if (level_column < 0 || level_column > quads_round) return std::nullopt;
        return PageIndex{level_.row.region_post(level_row), level_.column.region_post(level_column)};
    }
    [[nodiscard]] const LevelGrid& level() const { return level_; }
    [[nodiscard]] int first_row() const { return first_row_; }  // of the level's posts
    [[nodiscard]] int first_column() const { return first_column_; }

  private:
    LevelGrid level_;
    int first_row_;
    int first_column_;
    bool goes_round_;
};

template <class Visit>
void for_each_post(const PagePosts& page, const Visit& visit) {
    constexpr int posts = static_cast<int>(gpu::page_posts), stride = static_cast<int>(gpu::height_stride);
    for (int row = -1; row <= posts; ++row) {
        for (int column = -1; column <= posts; ++column)
            visit(static_cast<std::size_t>((row + 1) * stride + column + 1), page.region_post(row, column));
    }
}

}  // namespace oro
