// Questions to the surface itself, in double precision: how high is the ground here, where does this ray meet
// it.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "core/ellipsoid.h"
#include "core/post_grid.h"

namespace oro {

// Height of the exaggerated surface above the ellipsoid at a place; nothing where there is no data.
std::optional<double> ground_h_m(const HeightField& field, double lat_deg, double lon_deg,
                                 double exaggeration = 1.0);

// Where a ray meets the ground.
struct GroundHit {
    Geodetic point;       // h above the ellipsoid
    double distance_m{};  // along the ray
};
// Heights above the ellipsoid between which the whole exaggerated surface lies. Reads every post.
struct GroundLayer {
    double lowest_h_m{};
    double highest_h_m{};
};
GroundLayer ground_layer(const HeightField& field, double exaggeration = 1.0);

// First crossing of a ray (unit ECEF direction) with the surface, from either side; nothing when it meets
// none within reach_m. Error: 1 mm along the normal; crossings narrower than half a post spacing can be
// missed, also in the slivers next to a pole (there: an eighth of the spacing along the meridian). `layer` is
// the field's own.
std::optional<GroundHit> first_ground_hit(const HeightField& field, const GroundLayer& layer, const Ecef& eye,
                                          const glm::dvec3& direction, double reach_m,
                                          double exaggeration = 1.0);
// The same for a single ray: finds the layer itself.
std::optional<GroundHit> first_ground_hit(const HeightField& field, const Ecef& eye,
                                          const glm::dvec3& direction, double reach_m,
                                          double exaggeration = 1.0);

}  // namespace oro
