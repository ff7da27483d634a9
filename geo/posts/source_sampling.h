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

// The height of a post, void_height_m when the block does not hold it. `round`: of `columns` that go round
// the Earth.
float height_or_void(const PostBlock& block, int columns, bool round, int column, int row);

// Cubic convolution (a = -1/2) through a block's posts at fractional post numbers; linear over the four
// nearest where a void is near, and void where one of those is. The cubic stays within limit_m of the linear
// surface, so that a step between two posts (an undeclared no-data collar, a cliff) throws no ring of pits
// around itself. Up to half a cell beyond the outer posts the surface goes on straight, again within limit_m
// of its edge. `round`: after the last column comes the first. Source: R. G. Keys, Cubic convolution
// interpolation for digital image processing, IEEE Trans. ASSP 29(6), 1981, eq. 15.
float cubic_height_m(const PostBlock& block, int rows, int columns, bool round, double column, double row,
                     double limit_m);

}  // namespace oro
