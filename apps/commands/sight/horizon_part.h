// Which posts orograph horizon answers for.
#pragma once

#include <optional>

#include "core/terrain/grid_part.h"
#include "core/terrain/post_grid.h"
#include "geo/places/bounding_box.h"

namespace oro {

// The posts of a grid within a box; all of them without one. On a net: the rows and columns that hold them.
// Columns may run past a turn (GridPart). Empty where there are none.
GridPart part_in_box(const PostGrid& grid, const std::optional<BoundingBox>& box);

// Whether places so far from posts of the part lie outside the box of the grid, asked at its corners.
bool reaches_beyond(const PostGrid& grid, const GridPart& part, double radius_m);

}  // namespace oro
