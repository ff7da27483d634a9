// The oracle: where a sight line meets the true surface, in double precision and without a GPU. Pictures are
// held against it, and whatever must know what is seen in a direction asks it.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/camera.h"
#include "core/ellipsoid.h"
#include "core/true_surface.h"
#include "core/world_model.h"

namespace oro {

// From where and through what air one looks.
struct Sight {
    Ecef eye;
    Refraction refraction;  // default: straight
};
Sight sight_from(const Geodetic& eye, double refraction_k = 0.0);

// Where a sight line meets the surface.
struct SightHit {
    Geodetic point;       // h above the ellipsoid
    double distance_m{};  // from the eye to where the point is seen: along the ray
    int row{};            // north-west post of its cell
    int column{};
    bool south_west{};    // of the cell's two triangles
    double residual_m{};  // of the root: height of the point above its triangle
};

// First crossing of a sight line (unit ECEF direction at the eye) with the surface, from either side; nothing
// when it meets none within reach_m. Exact: the nearest root over all cells, residual below 1e-6 m, or a
// millionth of a millionth of the distance where that is more. Touches narrower than that may be missed.
std::optional<SightHit> first_hit(const TrueSurface& surface, const Sight& sight, const glm::dvec3& direction,
                                  double reach_m);

// What each pixel of a picture sees at its centre, row by row; shared between `threads`.
std::vector<std::optional<SightHit>> cast_picture(const TrueSurface& surface, const Sight& sight,
                                                  const Camera& camera, int threads);

// Farther than any sight line over the Earth from this height.
double sight_reach_m(double eye_h_m);

}  // namespace oro
