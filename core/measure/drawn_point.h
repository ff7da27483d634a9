// What a picture shows at a pixel: a place of the region's grid, and where it was drawn.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "shaders/shared.h"

namespace oro {

// The ground point of a pixel: by the row and column of its own triangle, whatever moved that triangle.
struct DrawnPoint {
    double row{};  // fractional; 0 is the region's north
    double column{};
    double z_m{};  // distance along the view axis at which it is drawn; 0: the background
    double h_m{};  // its triangle's height above the ellipsoid there, exaggerated as it is drawn
    std::uint32_t
        grid{};  // of the frame's, whose rows and columns they are; of what is between them, its last
    [[nodiscard]] bool background() const { return z_m <= 0.0; }
};

// Where a pixel's ray meets the triangle that it shows; in double, from the corners as the GPU placed them.
// ray_view: through the pixel, z = -1. A ray that passes beside the triangle (by up to 1/256 px, the grid of
// corners) takes the nearest point of its rim. Along the rim and between the corners rows and columns are
// linear in space.
DrawnPoint drawn_point(const gpu::DrawnTriangle& triangle, const glm::dvec3& ray_view);

// A triangle and whose it is.
struct ShownTriangle {
    gpu::DrawnTriangle triangle;
    std::uint32_t grid{};  // as DrawnPoint
};
DrawnPoint drawn_point(const ShownTriangle& shown, const glm::dvec3& ray_view);

}  // namespace oro
