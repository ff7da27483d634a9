// What places the rows of a grid's posts and does not depend on the eye: kept from frame to frame.
#pragma once

#include <cstdint>
#include <vector>

#include "core/terrain/post_grid.h"

namespace oro {

// Of each row that was asked for once: 24 bytes for each row of the grid. For one thread at a time.
class RowAngles {
  public:
    // The grid outlives it.
    explicit RowAngles(const PostGrid& grid) : grid_(&grid) {}

    struct Row {
        double sine, cosine;  // of its latitude; on a net, of that of its middle
        double normal_m;      // of WGS84: the radius of curvature along the prime vertical there
    };
    // A row of posts by its number; one beyond the last lies as far beyond it, on a net there.
    [[nodiscard]] Row at(std::int64_t row);

  private:
    const PostGrid* grid_;
    std::vector<Row> rows_;  // normal_m 0: nobody has asked
};

}  // namespace oro
