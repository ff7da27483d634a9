// How far apart posts are on the ground.
#pragma once

#include <algorithm>

#include "core/earth/ellipsoid.h"
#include "core/terrain/post_grid.h"

namespace oro {

// Metres along the ellipsoid from one row, and from one column, to the next.
struct PostSpacing {
    double row_m;
    double column_m;  // near a pole, where columns meet, at least a millimetre
};
inline PostSpacing post_spacing(const PostGrid& grid, double lat_deg) {
    return {meridian_radius_m(lat_deg) * radians_from_deg(grid.lat.spacing_deg()).rad,
            std::max(1.0e-3, prime_vertical_radius_m(lat_deg) * sine_cosine_deg(lat_deg).cosine *
                                 radians_from_deg(grid.lon.spacing_deg()).rad)};
}

}  // namespace oro
