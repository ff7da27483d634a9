#include "core/earth/world_model.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace oro {
namespace {

// Height in which the air's density falls by e. Source: U.S. Standard Atmosphere 1976, table 4, sea level: R
// T0 / (M g).
constexpr double scale_height_m = 8434.0;

Ecef on_sphere(const Geodetic& point) {
    const SineCosine lat = sine_cosine_deg(point.lat_deg), lon = sine_cosine_deg(point.lon_deg);
    return {(mean_radius_m + point.h_m) *
            glm::dvec3(lat.cosine * lon.cosine, lat.cosine * lon.sine, lat.sine)};
}

}  // namespace

double Air::k_at(double eye_h_m) const {
    return law == AirLaw::constant ? k : k * std::exp(-std::max(eye_h_m, 0.0) / scale_height_m);
}

Refraction::Refraction(const Geodetic& eye, const Air& air)
    : curvature_per_m_(air.k_at(eye.h_m) / gaussian_radius_m(eye.lat_deg)),
      up_(ecef_from_enu(eye.lat_deg, eye.lon_deg)[2]) {}

double Refraction::lift_m(const glm::dvec3& offset_m) const {
    if (curvature_per_m_ == 0.0) return 0.0;
    const glm::dvec3 across = offset_m - glm::dot(offset_m, up_) * up_;
    return 0.5 * curvature_per_m_ * glm::dot(across, across);
}

Ecef model_eye_ecef(Earth earth, const Geodetic& eye) {
    return earth == Earth::sphere ? on_sphere(eye) : ecef_from_geodetic(eye);
}

glm::dvec3 model_offset_m(Earth earth, const Geodetic& eye, const Geodetic& point) {
    if (earth == Earth::sphere) return on_sphere(point).m - on_sphere(eye).m;
    if (earth == Earth::ellipsoid) return ecef_from_geodetic(point).m - ecef_from_geodetic(eye).m;
    const double east_m = prime_vertical_radius_m(eye.lat_deg) * sine_cosine_deg(eye.lat_deg).cosine *
                          radians_from_deg(std::remainder(point.lon_deg - eye.lon_deg, 360.0)).rad;
    const double north_m = meridian_radius_m(eye.lat_deg) * radians_from_deg(point.lat_deg - eye.lat_deg).rad;
    return ecef_from_enu(eye.lat_deg, eye.lon_deg) * glm::dvec3(east_m, north_m, point.h_m - eye.h_m);
}

std::optional<Geodetic> model_point(Earth earth, const Geodetic& eye, const glm::dvec3& offset_m) {
    if (earth == Earth::ellipsoid) return geodetic_from_ecef({ecef_from_geodetic(eye).m + offset_m});
    constexpr double degree = 180.0 / 3.14159265358979323846;
    if (earth == Earth::sphere) {
        const glm::dvec3 at = on_sphere(eye).m + offset_m;
        const double across_m = std::hypot(at.x, at.y), radius_m = std::hypot(across_m, at.z);
        return Geodetic{degree * std::atan2(at.z, across_m), degree * std::atan2(at.y, at.x),
                        radius_m - mean_radius_m};
    }
    const glm::dvec3 enu_m = offset_m * ecef_from_enu(eye.lat_deg, eye.lon_deg);
    const double parallel_m =
        prime_vertical_radius_m(eye.lat_deg) * std::max(1.0e-12, sine_cosine_deg(eye.lat_deg).cosine);
    const double north_deg = degree * enu_m.y / meridian_radius_m(eye.lat_deg);
    const double east_deg = degree * enu_m.x / parallel_m;
    if (std::abs(eye.lat_deg + north_deg) > 90.0 || std::abs(east_deg) > 180.0) return std::nullopt;
    return Geodetic{eye.lat_deg + north_deg, eye.lon_deg + east_deg, eye.h_m + enu_m.z};
}

glm::dvec3 model_offset_m(const WorldModel& model, const Geodetic& eye, const Geodetic& point) {
    return Refraction(eye, model.air).apparent_m(model_offset_m(model.earth, eye, point));
}

}  // namespace oro
