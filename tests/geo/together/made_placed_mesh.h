// A placed mesh that tests make, and a region with it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include "geo/meshes/placed_mesh.h"
#include "geo/region/region.h"

namespace oro::test {

// A ball of hills, 60 m wide, over 47 N 8.5 E: closed; its northern half is one feature, the other another.
// Its vertices are given twice, as files without indices do.
inline PlacedMesh ball_of_two_features() {
    constexpr int n = 20;
    const auto vertex = [&](int i, int k) {
        const double a = std::numbers::pi * i / n, b = std::numbers::pi * (k % (2 * n)) / n;
        const double r = i % n == 0 ? 30.0 : 30.0 * (1.0 + 0.04 * std::sin(5.0 * a) * std::cos(6.0 * b));
        return PlacedVertex{47.0 + r * std::sin(a) * std::cos(b) / 111200.0,
                            8.5 + r * std::sin(a) * std::sin(b) / 76000.0, 800.0 + r * std::cos(a)};
    };
    PlacedMesh mesh;
    mesh.features = {{"north", "", "", {}, 0}, {"south", "", "", {}, 0}};
    const auto add = [&](const std::array<PlacedVertex, 3>& corners) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
        mesh.triangles.push_back({first, first + 1, first + 2});
        mesh.feature_of.push_back(corners[0].lat_deg + corners[1].lat_deg + corners[2].lat_deg > 141.0 ? 0U
                                                                                                       : 1U);
    };
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < 2 * n; ++k) {
            if (i > 0) add({vertex(i, k), vertex(i + 1, k), vertex(i, k + 1)});
            if (i + 1 < n) add({vertex(i, k + 1), vertex(i + 1, k), vertex(i + 1, k + 1)});
        }
    return mesh;
}

// One grid without posts, and the mesh.
inline Region region_with(PlacedMesh mesh) {
    Region region;
    region.grids.resize(1);
    region.meshes = std::make_shared<const std::vector<PlacedMesh>>(std::vector{std::move(mesh)});
    return region;
}

}  // namespace oro::test
