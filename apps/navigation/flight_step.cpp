#include "apps/navigation/flight_step.h"

#include <algorithm>
#include <cmath>

#include "core/terrain/ground.h"

namespace oro {
namespace {

GroundHeightAt heights_of(const HeightField& field, double exaggeration) {
    return [&field, exaggeration](double lat_deg, double lon_deg) {
        return ground_h_m(field, lat_deg, lon_deg, exaggeration);
    };
}

// Moved over the ellipsoid at its height, in the directions of a step.
Camera moved_level(const Camera& camera, const FlightStep& step, double reach_m) {
    Camera next = camera;
    if (step.forward == 0.0 && step.right == 0.0) return next;
    const double heading = radians_from_deg(camera.attitude.heading_deg).rad;
    const glm::dvec3 east_north_up(std::sin(heading) * step.forward + std::cos(heading) * step.right,
                                   std::cos(heading) * step.forward - std::sin(heading) * step.right, 0.0);
    // A straight step climbs off the ellipsoid by its square over twice the radius; level flight takes
    // that back. The heading is carried along as a direction in space, so that it holds across a pole.
    const glm::dmat3 from_enu = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg);
    const glm::dvec3 ahead = from_enu * glm::dvec3(std::sin(heading), std::cos(heading), 0.0);
    next.eye = geodetic_from_ecef({camera.eye_ecef().m + from_enu * east_north_up * reach_m});
    next.eye.h_m = camera.eye.h_m;
    next.attitude.heading_deg = attitude_of_direction(next.eye, ahead).heading_deg;
    return next;
}

}  // namespace

double flight_speed_m_s(double above_ground_m) {
    constexpr double low_m = 2000.0, share_above = 0.4;
    const double over_low_m = std::max(0.0, above_ground_m - low_m);
    return std::clamp(std::min(above_ground_m, low_m) + share_above * over_low_m, 5.0, 5e6);
}

Camera above_ground(const Camera& camera, const GroundHeightAt& ground_h_m) {
    Camera lifted = camera;
    if (const auto ground = ground_h_m(camera.eye.lat_deg, camera.eye.lon_deg))
        lifted.eye.h_m = std::max(lifted.eye.h_m, *ground + eye_clearance_m);
    return lifted;
}

Camera above_ground(const Camera& camera, const HeightField& field, double exaggeration) {
    return above_ground(camera, heights_of(field, exaggeration));
}

Camera turned(const Camera& camera, double right_deg, double up_deg) {
    Camera next = camera;
    next.attitude.heading_deg = std::fmod(next.attitude.heading_deg + right_deg + 720.0, 360.0);
    next.attitude.pitch_deg = std::clamp(next.attitude.pitch_deg + up_deg, -90.0, 90.0);
    return next;
}

Camera flown(const Camera& camera, const FlightStep& step, const GroundHeightAt& ground_h_m) {
    const double ground_m = ground_h_m(camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0);
    const double reach_m =
        flight_speed_m_s(camera.eye.h_m - ground_m) * (step.fast ? 5.0 : 1.0) * step.elapsed_s;
    Camera next = moved_level(camera, step, reach_m);
    next.eye.h_m = std::min(next.eye.h_m + step.up * reach_m, 1e9);
    return above_ground(turned(next, step.turn_right_deg, step.turn_up_deg), ground_h_m);
}

Camera flown(const Camera& camera, const FlightStep& step, const HeightField& field, double exaggeration) {
    return flown(camera, step, heights_of(field, exaggeration));
}

Camera walked(const Camera& camera, const FlightStep& step, const GroundHeightAt& ground_h_m) {
    constexpr double walk_m_s = 5.0;
    const Camera moved = moved_level(camera, step, walk_m_s * (step.fast ? 5.0 : 1.0) * step.elapsed_s);
    Camera next = turned(moved, step.turn_right_deg, step.turn_up_deg);
    if (const auto ground = ground_h_m(next.eye.lat_deg, next.eye.lon_deg))
        next.eye.h_m = *ground + eye_clearance_m;
    return next;
}

}  // namespace oro
