// What a GPU makes the heights of pages of one made grid from, page after page.
#pragma once

#include <vector>

#include "core/made_pages/page_source.h"

namespace oro {

// As set_page_source(). Shares of rows and columns of a grid of up to 65,536 of both are reckoned once, for
// all levels: 24 bytes each. Any thread. The grid and N outlive it.
class PageSources {
  public:
    PageSources(const PostGrid& grid, const UndulationField& undulation, const MadeGround& ground);
    // Where these are known less than a microsecond.
    void set(PageIndex page, gpu::MadePageSource& source) const;

  private:
    const PostGrid& grid_;
    const UndulationField& undulation_;
    MadeGround ground_;
    std::vector<gpu::MadePageRow> rows_;  // of the grid; none of a large one
    std::vector<gpu::MadePageColumn> columns_;
};

}  // namespace oro
