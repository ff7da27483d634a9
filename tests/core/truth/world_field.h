// Fields on grids whose posts are numbered in the world, as the readers of real data make them.
#pragma once

#include <cstdint>
#include <functional>

#include "core/terrain/post_grid.h"

namespace oro::test {

// Posts at whole multiples of 1 / posts_per_deg; the north-west one is number (north, west) of the world.
inline HeightField world_field(double posts_per_deg, std::int64_t north, std::int64_t west, int rows,
                               int columns,
                               const std::function<double(double lat_deg, double lon_deg)>& H_m) {
    HeightField field;
    field.grid.lat = {posts_per_deg, 0.0, north, -1, rows};
    field.grid.lon = {posts_per_deg, 0.0, west, +1, columns};
    field.H_m.reserve(field.grid.post_count());
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double H = H_m(field.grid.lat.at_deg(row), field.grid.lon.at_deg(column));
            field.H_m.push_back(static_cast<float>(H));
        }
    }
    return field;
}

}  // namespace oro::test
