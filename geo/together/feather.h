// Heights of a finer grid that go over to those of the coarser one below it, along its rim.
#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.h"
#include "geo/region/region.h"

namespace oro {

// Changes the heights of each grid's posts within width_m of its rim (holes among it) where a grid of a
// greater rank has ground: on the rim they are that ground's, at width_m their own, and between as much of
// each as a smooth step of the distance says (3 s^2 - 2 s^3). Distances are those to the nearest post on the
// rim. Posts farther inside keep their bits. Tells of it in RegionGrid::feathered. The posts must be in
// memory. Errors: posts of a grid below that cannot be read.
Result<void> feather(Region& region, double width_m);

}  // namespace oro
