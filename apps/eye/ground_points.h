// Points of a region's ground that stand for all of it where a picture is to hold it.
#pragma once

#include <vector>

#include "core/earth/ellipsoid.h"
#include "geo/places/place.h"
#include "geo/region/region.h"

namespace oro {

struct GroundPoints {
    std::vector<Ecef> all;  // empty where every post is void
    Geodetic middle;        // of those inside; the Earth's own where they lie all around it
    double radius_m{};      // of a ball around the middle that holds those inside
};

// The points of all grids of a region, or of what of them is in a cell: the first and the last post with data
// of every row and column (of every few where a grid has more than 1,024 of them), and some 64 x 64 posts
// inside. Grids that have no two rows and two columns of posts in the cell have no ground there: they share
// its border. Heights are exaggerated. Posts that cannot be read count as void: region.health() tells.
GroundPoints ground_points(const Region& region, double exaggeration, const PlaceCell* cell = nullptr);

// The rim alone of all grids of a region, in the same way.
std::vector<Ecef> rim_points(const Region& region, double exaggeration);

}  // namespace oro
