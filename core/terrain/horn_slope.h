// How steep the ground is, as maps of slope have it.
#pragma once

#include <optional>

#include "core/terrain/post_grid.h"

namespace oro {

// Slope of the heights above sea level (H) at a fractional row and column of the grid, degrees, 0 to 90: by
// Horn's formula at the posts, which gdaldem has, too, and bilinear between them. Metres are those of the
// ellipsoid at the place's latitude. Beside a post without a height, and at the rim, the ground goes on as it
// came from the other side. In a cell where a corner has no
// height the others count alone. Nothing outside the grid and where none has.
// Source: B. K. P. Horn, Hill shading and the reflectance map, Proceedings of the IEEE 69(1), 1981.
std::optional<double> horn_slope_deg(const HeightField& field, double row, double column);

}  // namespace oro
