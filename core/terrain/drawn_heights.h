// The heights that are drawn: exaggerated, lifted by the undulation, and the same on every page and level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/terrain/cell_diagonals.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Drawn heights above the ellipsoid, exaggeration and undulation included, in steps of 2^-11 m: whole
// numbers, the same for a post on every page and level, and exact in a float as far as 8,192 m from the eye's
// own height. Within 524 km of the ellipsoid (what an exaggeration lifts higher stays there). Costs at most
// 0.25 mm, and is what pages and all that is drawn call the height.
inline constexpr double height_step_m = 1.0 / 2048.0;
inline constexpr std::int32_t void_height_steps = std::numeric_limits<std::int32_t>::min();
inline constexpr std::int32_t highest_height_steps = 1 << 30;  // and as far down

// The drawn heights of a whole region, row by row. Posts that are one point (a meridian's two columns, a
// pole) have one height.
struct DrawnHeights {
    int rows{};
    int columns{};
    std::vector<std::int32_t> steps;  // void_height_steps where there is none
    std::int32_t highest_steps{void_height_steps};
    std::shared_ptr<const CellDiagonals> diagonals{};  // null in made ones whose cells are all nw_se

    [[nodiscard]] const std::int32_t* row(int number) const {
        return steps.data() + static_cast<std::size_t>(number) * static_cast<std::size_t>(columns);
    }
    [[nodiscard]] std::int32_t at(int row_number, int column) const { return row(row_number)[column]; }
    // The diagonal of a cell of a level, by the level's own rows and columns.
    [[nodiscard]] Diagonal diagonal(int level, int row_number, int column) const {
        return diagonals ? diagonals->at(level, row_number, column) : Diagonal::nw_se;
    }
};
// 4 bytes a post, and what diagonals take; the work is shared between `threads` (at least 1), with one result
// for any number.
DrawnHeights drawn_heights(const HeightField& field, double exaggeration, int threads);

// The step nearest to a height, halves upwards.
[[nodiscard]] std::int32_t height_steps(double h_m);

// Latitude of a row of a region, any number; a row whose spacing was rounded on its way here still ends
// exactly on the pole.
double row_lat_deg(const PostGrid& grid, std::int64_t row);

// Whether all posts of a row are a pole.
bool at_pole(const PostGrid& grid, int row);

// The column whose H and N stand for all posts that are the same point as one that is not void: column 0 for
// the last one of a region that goes round the Earth, and at a pole the first that is not void.
int canonical_column(const HeightField& field, int row, int column);
// Longitude where N is asked for a post: that of its canonical point.
double canonical_lon_deg(const PostGrid& grid, int row, int column);

// Drawn height of one post that is not void, the same as in drawn_heights.
double drawn_h_m(const HeightField& field, int row, int column, double exaggeration);

// Position of a post that is not void on the exaggerated surface, canonical: the same bits for the same post
// from whatever page it is asked. Row and column may be one meridian's two numbers where a region goes round
// the Earth.
Ecef post_ecef(const HeightField& field, int row, int column, double exaggeration);

}  // namespace oro
