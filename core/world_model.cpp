#include "core/world_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace oro {
namespace {

// Height in which the air's density falls by e. Source: U.S. Standard Atmosphere 1976, table 4, sea level: R
// T0 / (M g).
constexpr double scale_height_m = 8434.0;

}  // namespace

Refraction::Refraction(const Geodetic& eye, double k)
    : curvature_per_m_(k * std::exp(-std::max(eye.h_m, 0.0) / scale_height_m) /
                       std::sqrt(prime_vertical_radius_m(eye.lat_deg) * meridian_radius_m(eye.lat_deg))),
      up_(ecef_from_enu(eye.lat_deg, eye.lon_deg)[2]) {}

double Refraction::lift_m(const glm::dvec3& offset_m) const {
    if (curvature_per_m_ == 0.0) return 0.0;
    const glm::dvec3 across = offset_m - glm::dot(offset_m, up_) * up_;
    return 0.5 * curvature_per_m_ * glm::dot(across, across);
}

}  // namespace oro
