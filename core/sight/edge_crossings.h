// Where a way over the ground passes from one triangle of a grid to the next.
#pragma once

#include <functional>
#include <vector>

#include "core/earth/ellipsoid.h"
#include "core/terrain/post_grid.h"
#include "core/truth/true_ground.h"

namespace oro {

// A way over the Earth: a place by a number that grows along it, about one for each metre.
using Way = std::function<Geodetic(double along_m)>;

// The places along a way, from `from_m` to `to_m`, where it crosses an edge of the triangles of any grid: a
// row, a column, or a cell's diagonal. In order; those of one place may be there twice. Nothing outside the
// grids. Where another grid begins to be the ground there is a place on either side of its rim, off_rim_m
// from it: heights may differ. Error: 1e-4 of a cell; over a pole, a cell.
inline constexpr double off_rim_m = 0.02;
std::vector<double> edge_crossings(const TrueGround& ground, const Way& way, double from_m, double to_m);

}  // namespace oro
