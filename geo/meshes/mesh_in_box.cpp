#include "geo/meshes/mesh_in_box.h"

#include <algorithm>
#include <cmath>

namespace oro {

bool reaches_into(const PlacedMesh& mesh, const BoundingBox& box) {
    const double width_deg = box.east_deg - box.west_deg + (box.east_deg < box.west_deg ? 360.0 : 0.0),
                 middle_deg = box.west_deg + 0.5 * width_deg;
    return std::ranges::any_of(mesh.triangles, [&](const SourceTriangle& triangle) {
        const PlacedVertex& first = mesh.vertices[triangle[0]];
        double south_deg = first.lat_deg, north_deg = first.lat_deg, west_deg = 0.0, east_deg = 0.0;
        for (const std::uint32_t corner : triangle) {
            const PlacedVertex& at = mesh.vertices[corner];
            const double offset_deg = std::remainder(at.lon_deg - first.lon_deg, 360.0);
            south_deg = std::min(south_deg, at.lat_deg), north_deg = std::max(north_deg, at.lat_deg);
            west_deg = std::min(west_deg, offset_deg), east_deg = std::max(east_deg, offset_deg);
        }
        const double apart_deg =
            std::remainder(first.lon_deg + 0.5 * (west_deg + east_deg) - middle_deg, 360.0);
        return south_deg <= box.north_deg && north_deg >= box.south_deg &&
               std::abs(apart_deg) <= 0.5 * (width_deg + east_deg - west_deg);
    });
}

}  // namespace oro
