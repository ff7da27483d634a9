// Terrain made by a formula, for tests that need a surface and no file.
#pragma once

#include <functional>

#include "core/terrain/post_grid.h"

namespace oro::test {

// A grid with its north-west post at (north, west), `posts_per_deg` along both axes, H from a function of
// (lat, lon) in degrees.
inline HeightField made_field(double north_deg, double west_deg, double posts_per_deg, int rows, int columns,
                              const std::function<float(double, double)>& H_m) {
    HeightField field;
    field.grid.lat = {posts_per_deg, north_deg, 0, -1, rows};
    field.grid.lon = {posts_per_deg, west_deg, 0, +1, columns};
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column)
            field.H_m.push_back(H_m(field.grid.lat.at_deg(row), field.grid.lon.at_deg(column)));
    }
    return field;
}

}  // namespace oro::test
