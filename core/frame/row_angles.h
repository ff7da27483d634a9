// What places the rows of a grid's posts and does not depend on the eye: kept from frame to frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/terrain/level_grid.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Of each row that was asked for once, some rows around it, and each row of pages that was: 32 bytes a row.
// For one thread at a time.
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

    // The same of several rows, one after the other; good as long as this is.
    struct Rows {
        const double* sine;
        const double* cosine;
        const double* normal_m;
        const double* polar_m;  // (1 - e^2) normal_m
    };
    // Of rows of the grid, from a first one on; there are so many.
    [[nodiscard]] Rows of(int first, int count);
    // Of the gpu::page_posts rows of a row of pages of a level.
    [[nodiscard]] Rows of_pages(const LevelAxis& level, int page_row);

  private:
    struct Table {
        std::vector<double> sine, cosine, normal_m, polar_m;
        explicit Table(std::size_t rows) : sine(rows), cosine(rows), normal_m(rows), polar_m(rows) {}
        [[nodiscard]] Rows from(std::size_t first) const {
            return {&sine[first], &cosine[first], &normal_m[first], &polar_m[first]};
        }
        void set(std::size_t number, const Row& row);
    };
    void fill(int first, int count);

    const PostGrid* grid_;
    std::unique_ptr<Table> rows_;                             // of the grid
    std::vector<bool> filled_;                                // of each rows_at_a_time of them
    std::vector<std::vector<std::unique_ptr<Table>>> pages_;  // by level, then by row of pages
};

}  // namespace oro
