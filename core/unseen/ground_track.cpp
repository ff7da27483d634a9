#include "core/unseen/ground_track.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace oro {
namespace {

const glm::dvec3 axes_m(wgs84_a_m, wgs84_a_m, wgs84_b_m);

// Angles of A cos + B sin = C within (0, most).
void add_roots(double a, double b, double c, double most_rad, std::vector<double>& angles_rad) {
    const double length = std::hypot(a, b);
    if (!(length > 0.0) || std::abs(c) > length) return;
    const double middle = std::atan2(b, a), half = std::acos(c / length);
    constexpr double turn = 2.0 * std::numbers::pi;
    for (const double root : {middle - half, middle + half}) {
        const double angle = root - turn * std::floor(root / turn);
        if (angle > 0.0 && angle < most_rad) angles_rad.push_back(angle);
    }
}

}  // namespace

GroundTrack::GroundTrack(const Geodetic& eye, const glm::dvec3& ahead)
    : eye_m_(ecef_from_geodetic(eye).m), ahead_(ahead), up_(ecef_from_enu(eye.lat_deg, eye.lon_deg)[2]) {
    const glm::dvec3 foot_m = ecef_from_geodetic({eye.lat_deg, eye.lon_deg, 0.0}).m;
    const glm::dvec3 squashed = glm::cross(up_, ahead_) * axes_m;
    const glm::dvec3 normal = glm::normalize(squashed);
    const glm::dvec3 foot = foot_m / axes_m;
    centre_ = normal * glm::dot(normal, foot);
    below_ = foot - centre_;
    onwards_ = glm::cross(normal, below_);
    if (glm::dot(onwards_, ahead_ / axes_m) < 0.0) onwards_ = -onwards_;
}

glm::dvec3 GroundTrack::ecef_m(double angle_rad) const {
    return (centre_ + std::cos(angle_rad) * below_ + std::sin(angle_rad) * onwards_) * axes_m;
}

GroundTrack::Vertical GroundTrack::vertical_at(double angle_rad) const {
    const glm::dvec3 foot_m = ecef_m(angle_rad);
    const glm::dvec3 normal = glm::normalize(foot_m / (axes_m * axes_m));
    const glm::dvec3 offset_m = foot_m - eye_m_;
    return {glm::dot(offset_m, ahead_), glm::dot(offset_m, up_), glm::dot(normal, ahead_),
            glm::dot(normal, up_)};
}

Geodetic GroundTrack::place_at(double angle_rad) const {
    const glm::dvec3 foot_m = ecef_m(angle_rad);
    const double across_m = std::hypot(foot_m.x, foot_m.y);
    return {deg_from_radians(Radians{std::atan2(foot_m.z, (1.0 - wgs84_e2) * across_m)}),
            deg_from_radians(Radians{std::atan2(foot_m.y, foot_m.x)}), 0.0};
}

void GroundTrack::add_crossings_of_parallel(double lat_deg, double most_rad,
                                            std::vector<double>& angles_rad) const {
    const SineCosine lat = sine_cosine_deg(lat_deg);
    // Height of the parallel on the unit sphere: the sine of the reduced latitude.
    const double z = lat.sine * (1.0 - wgs84_f) / std::hypot(lat.cosine, (1.0 - wgs84_f) * lat.sine);
    add_roots(below_.z, onwards_.z, z - centre_.z, most_rad, angles_rad);
}

void GroundTrack::add_crossings_of_meridian(double lon_deg, double most_rad,
                                            std::vector<double>& angles_rad) const {
    // The whole circle through both poles: its other half cuts what needs no cut, which does no harm.
    const SineCosine lon = sine_cosine_deg(lon_deg);
    const glm::dvec3 east(-lon.sine, lon.cosine, 0.0);
    add_roots(glm::dot(east, below_), glm::dot(east, onwards_), -glm::dot(east, centre_), most_rad,
              angles_rad);
}

}  // namespace oro
