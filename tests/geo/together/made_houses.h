// Houses that tests build on made ground.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/truth/true_surface.h"
#include "geo/meshes/placed_mesh.h"

namespace oro::test {

// Houses of 10 x 8 m and 3 to 15 m, 60 m apart, half a metre in the ground: their walls and roofs.
inline PlacedMesh houses_on(const TrueSurface& surface, int house_rows = 12) {
    constexpr int most_storeys = 5;
    PlacedMesh mesh;
    mesh.path = "houses.gpkg";
    constexpr double per_lat = 1.0 / 111200.0, per_lon = 1.0 / 76000.0;
    for (int row = 0; row < house_rows; ++row)
        for (int column = 0; column < house_rows; ++column) {
            const double south = 46.965 + 60.0 * row * per_lat, west = 8.03 + 60.0 * column * per_lon;
            const std::array<std::array<double, 2>, 4> ring{{{south, west},
                                                             {south, west + 10.0 * per_lon},
                                                             {south + 8.0 * per_lat, west + 10.0 * per_lon},
                                                             {south + 8.0 * per_lat, west}}};
            double lowest_m = 1.0e9;
            for (const auto& [lat, lon] : ring) lowest_m = std::min(lowest_m, surface.h_m(lat, lon).value());
            const double top_m = lowest_m + 3.0 * (1 + (row * 7 + column * 3) % most_storeys);
            const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
            for (const double h_m : {lowest_m - 0.5, top_m})
                for (const auto& [lat, lon] : ring) mesh.vertices.push_back({lat, lon, h_m});
            for (std::uint32_t i = 0; i < 4; ++i) {
                const std::uint32_t a = first + i, b = first + (i + 1) % 4;
                mesh.triangles.push_back({a, b, b + 4}), mesh.triangles.push_back({a, b + 4, a + 4});
            }
            mesh.triangles.push_back({first + 4, first + 5, first + 6});
            mesh.triangles.push_back({first + 4, first + 6, first + 7});
        }
    return mesh;
}

}  // namespace oro::test
