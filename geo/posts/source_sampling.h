// Heights of a source at the posts of a region's grid.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/terrain/post_grid.h"
#include "geo/sources/source.h"
#include "geo/sources/source_report.h"

namespace oro {

// Posts of the region's grid, as rows of one column range.
struct GridRect {
    int first_row{};
    int first_column{};
    int rows{};
    int columns{};
};

// A source as it meets a grid, moved by whole turns.
class SourceOnGrid {
  public:
    // Errors: a CRS that PROJ refuses.
    static Result<SourceOnGrid> create(const Source& source, const PostGrid& grid, int turn);
    SourceOnGrid(SourceOnGrid&&) noexcept;
    SourceOnGrid& operator=(SourceOnGrid&&) noexcept;
    ~SourceOnGrid();

    [[nodiscard]] Fit fit() const { return fit_; }
    // Grid posts that the source can have a height for.
    [[nodiscard]] const GridRect& rect() const { return rect_; }
    [[nodiscard]] Placement placement() const { return {fit_, moved_by_, lat_part_, lon_part_}; }

    // Reads what the grid's rows need. Errors: as read_posts.
    Result<void> read(int first_row, int rows);
    [[nodiscard]] const PostBlock& block() const { return block_; }

    // Heights in the source's own datum for one row of rect(), void_height_m where there is none. `beyond`
    // takes the heights of posts that lie up to half a cell outside the source's posts, where a neighbour may
    // know better; `inside` tells which posts the source covers at all.
    void row(int row, std::span<float> heights, std::span<float> beyond, std::span<unsigned char> inside);

  private:
    struct Mapping;
    SourceOnGrid();
    void fit_to_degrees();
    void find_rect();
    [[nodiscard]] PostWindow window_for(int first_row, int rows);
    void copy_row(int row, std::span<float> heights, std::span<unsigned char> inside) const;
    void interpolate_row(int row, std::span<float> heights, std::span<unsigned char> inside) const;
    void resample_row(int row, std::span<float> heights, std::span<float> beyond,
                      std::span<unsigned char> inside);

    const Source* source_{};
    PostGrid grid_;
    int turn_{};
    Fit fit_{Fit::elsewhere};
    GridRect rect_;
    double moved_by_{};                          // of a post, at most, where posts are copied or interpolated
    std::int64_t lat_part_{1}, lon_part_{1};     // every how many grid posts the source has one
    std::int64_t row_shift_{}, column_shift_{};  // source post 0 in grid posts
    std::unique_ptr<Mapping> mapping_;
    PostBlock block_;
};

}  // namespace oro
