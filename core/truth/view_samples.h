// Ground points that a view sees, for predictions: many where the ground is rugged, few where it is even.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/earth/camera.h"
#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"

namespace oro {

// A point that is seen.
struct ViewSample {
    Geodetic point;
    glm::dvec3 apparent_m;  // offset from the eye at which it is seen, ECEF axes
    double distance_m;
    double slope;  // of its triangle, metres a metre
    int row;       // of its cell
    int column;
    bool south_west;  // of the cell's triangles
    bool even;        // one of those spread evenly over the picture: medians are taken of these alone
};

// Casts sight lines through centres of pixels: up to 160 x 640 all over the picture (14,400 for 16:9; those
// of its rim included), then wherever four of them see ground whose distances differ by more than a fifth, or
// ground and sky, more between them, down to single pixels: what is seen through gaps between hills is seen
// here, too, but for gaps narrower than a pixel.
std::vector<ViewSample> view_samples(const TrueSurface& surface, const Sight& sight, const Camera& camera,
                                     int threads);

}  // namespace oro
