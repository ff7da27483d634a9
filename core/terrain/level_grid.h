// The nested grids of a region's levels: level k has every 2^k-th post of the region and its last one.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/terrain/post_grid.h"
#include "shaders/shared.h"

namespace oro {

// Number of pages along each axis of a level (the last ones may be partly beyond the grid: void there).
struct PageLayout {
    int rows{};
    int columns{};

    // The number of all pages: up to 2^48.
    [[nodiscard]] std::uint64_t count() const {
        return static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(columns);
    }
    // Of one of them, row by row.
    [[nodiscard]] std::uint64_t number(int row, int column) const {
        return static_cast<std::uint64_t>(row) * static_cast<std::uint64_t>(columns) +
               static_cast<std::uint64_t>(column);
    }
};

// One axis of a level. Its post j is the region's post min(j 2^level, last): a coarse level reaches exactly
// as far as the region does, its last quad may be narrower than the others, and the posts of level k + 1 are
// those of even number of level k and the last one.
struct LevelAxis {
    int level{};
    int last_post{};  // of the region
    int quads{};      // of this level

    // Number in the region of a post 0 .. quads.
    [[nodiscard]] int region_post(int post) const {
        return static_cast<int>(std::min<std::int64_t>(std::int64_t{post} << level, last_post));
    }
    [[nodiscard]] int nodes() const { return divided(gpu::meshlet_quads); }
    [[nodiscard]] int pages() const { return divided(gpu::page_quads); }
    // Quads of a node: 8, or fewer where the region ends.
    [[nodiscard]] int quads_of_node(int node) const {
        return std::clamp(quads - node * static_cast<int>(gpu::meshlet_quads), 0,
                          static_cast<int>(gpu::meshlet_quads));
    }

  private:
    [[nodiscard]] int divided(std::uint32_t by) const {
        return (quads + static_cast<int>(by) - 1) / static_cast<int>(by);
    }
};

// A level of a region. A node is a meshlet's worth of it, 8 x 8 quads, numbered over the whole level: node
// (i, j) lies in page (i / 16, j / 16), and its parent is node (i / 2, j / 2) of the next level.
struct LevelGrid {
    LevelAxis row;
    LevelAxis column;

    [[nodiscard]] int level() const { return row.level; }
    [[nodiscard]] PageLayout pages() const { return {row.pages(), column.pages()}; }
};

inline LevelAxis level_axis(int count, int level) {
    const int last = std::max(0, count - 1);
    const std::int64_t step = std::int64_t{1} << level;
    return {level, last, static_cast<int>((last + step - 1) / step)};
}
// level: 0 .. 30.
inline LevelGrid level_grid(const PostGrid& grid, int level) {
    return {level_axis(grid.rows(), level), level_axis(grid.columns(), level)};
}
// Number of levels of a region: the last is the first that fits into one page. 1 for a region of one page or
// none.
inline int level_count(const PostGrid& grid) {
    int level = 0;
    while (std::max(level_grid(grid, level).row.pages(), level_grid(grid, level).column.pages()) > 1) ++level;
    return level + 1;
}

}  // namespace oro
