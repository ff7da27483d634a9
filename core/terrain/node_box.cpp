#include "core/terrain/node_box.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/earth/ellipsoid.h"

namespace oro {

gpu::uint node_box(std::span<const glm::dvec3> points, const gpu::MeshletBounds& bounds,
                   double origin_lat_deg) {
    const SineCosine lat = sine_cosine_deg(origin_lat_deg);
    const glm::dvec3 east(0.0, 1.0, 0.0), north(-lat.sine, 0.0, lat.cosine), up(lat.cosine, 0.0, lat.sine);
    glm::dvec3 farthest_m(0.0);
    for (const glm::dvec3& point : points) {
        const glm::dvec3 offset_m = point - glm::dvec3(bounds.centre);
        farthest_m =
            glm::max(farthest_m, glm::abs(glm::dvec3(glm::dot(offset_m, east), glm::dot(offset_m, north),
                                                     glm::dot(offset_m, up))));
    }
    constexpr double steps = 1023.0;
    const glm::uvec3 box(glm::min(glm::ceil(farthest_m / static_cast<double>(bounds.radius) * steps + 0.01),
                                  glm::dvec3(steps)));
    return box.x | box.y << 10U | box.z << 20U;
}

}  // namespace oro
