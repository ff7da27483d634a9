// How far apart posts are on the ground.
#pragma once

#include <algorithm>
#include <cmath>

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
// The spacing of posts at a fractional row and column.
inline PostSpacing post_spacing_at(const PostGrid& grid, double row, double column) {
    if (!grid.net) return post_spacing(grid, grid.north_deg() - row * grid.lat.spacing_deg());
    const LatticeGeoreference::LatticeFrame local_frame = grid.net->local_frame_at(row, column);
    return {local_frame.row_m, local_frame.column_m};
}
// How many rows and columns so many metres eastwards and northwards are, at a post on that latitude.
inline PostNumber posts_along(const PostGrid& grid, const PostNumber& at, double lat_deg, double east_m,
                              double north_m) {
    if (!grid.net) {
        const PostSpacing apart = post_spacing(grid, lat_deg);
        return {-north_m / apart.row_m, east_m / apart.column_m};
    }
    const LatticeGeoreference::LatticeFrame local_frame = grid.net->local_frame_at(at.row, at.column);
    const double cosine = std::cos(local_frame.turn_rad), sine = std::sin(local_frame.turn_rad);
    return {(sine * east_m - cosine * north_m) / local_frame.row_m,
            (cosine * east_m + sine * north_m) / local_frame.column_m};
}

}  // namespace oro
