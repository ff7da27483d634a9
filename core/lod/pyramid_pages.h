// The pages that nodes are chosen from, wherever they come from: one by one, when they are asked for.
#pragma once

#include "core/lod/pyramid.h"
#include "core/terrain/level_grid.h"
#include "core/terrain/page.h"

namespace oro {

class PyramidPages {
  public:
    PyramidPages() = default;
    virtual ~PyramidPages() = default;
    PyramidPages(const PyramidPages&) = delete;
    PyramidPages& operator=(const PyramidPages&) = delete;

    [[nodiscard]] virtual const RegionShape& shape() const = 0;
    [[nodiscard]] virtual bool wraps_longitude() const = 0;
    // 1 or more; the last is one page.
    [[nodiscard]] virtual int levels() const = 0;
    [[nodiscard]] virtual const LevelGrid& grid(int level) const = 0;
    // One of the level's layout; good as long as these pages are.
    [[nodiscard]] virtual const PyramidPage& page(const PageIndex& index) const = 0;

    // The page of a node that is numbered over its level.
    [[nodiscard]] const PyramidPage& page_of_node(int level, int row, int column) const {
        constexpr int side = static_cast<int>(gpu::meshlets_per_side);
        return page({row / side, column / side, level});
    }
};

// The pages of a pyramid that is there whole, which outlives them.
class PagesOfPyramid : public PyramidPages {
  public:
    explicit PagesOfPyramid(const LevelPyramid& pyramid) : pyramid_(pyramid) {}
    [[nodiscard]] const RegionShape& shape() const override { return pyramid_.shape; }
    [[nodiscard]] bool wraps_longitude() const override { return pyramid_.wraps_longitude; }
    [[nodiscard]] int levels() const override { return static_cast<int>(pyramid_.levels.size()); }
    [[nodiscard]] const LevelGrid& grid(int level) const override { return at(level).grid; }
    [[nodiscard]] const PyramidPage& page(const PageIndex& index) const override {
        return at(index.level).page(index.row, index.column);
    }

  private:
    [[nodiscard]] const PyramidLevel& at(int level) const {
        return pyramid_.levels[static_cast<std::size_t>(level)];
    }
    const LevelPyramid& pyramid_;
};

}  // namespace oro
