// Where posts of a grid are, in double.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "core/terrain/drawn_heights.h"
#include "core/terrain/post_grid.h"

namespace oro {

// The point so high above the ellipsoid where that is the ellipsoid's normal, of length 1. ECEF, metres.
inline glm::dvec3 ecef_above(const glm::dvec3& up, double h_m) {
    const double normal_m = wgs84_a_m / std::sqrt(1.0 - wgs84_e2 * up.z * up.z);
    return {(normal_m + h_m) * up.x, (normal_m + h_m) * up.y, (normal_m * (1.0 - wgs84_e2) + h_m) * up.z};
}

// The ellipsoid's normal at a post.
inline glm::dvec3 post_up(const PostGrid& grid, int row, int column) {
    if (grid.net) {
        glm::dvec3 normal;
        grid.net->normals_of_row(row, column, {&normal, 1});
        return normal;
    }
    const SineCosine lat = sine_cosine_deg(row_lat_deg(grid, row));
    const SineCosine lon = sine_cosine_deg(grid.lon.at_deg(column));
    return {lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine};
}

}  // namespace oro
