#include "apps/window/flight.h"

#include <algorithm>
#include <cmath>

#include "core/terrain/ground.h"

namespace oro {

double flight_speed_m_s(double above_ground_m) {
    return std::clamp(above_ground_m, 5.0, 5e6);
}

Camera above_ground(const Camera& camera, const HeightField& field, double exaggeration) {
    Camera lifted = camera;
    if (const auto ground = ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg, exaggeration))
        lifted.eye.h_m = std::max(lifted.eye.h_m, *ground + eye_clearance_m);
    return lifted;
}

Camera flown(const Camera& camera, const FlightStep& step, const HeightField& field, double exaggeration) {
    Camera next = camera;
    const double ground_m =
        ground_h_m(field, camera.eye.lat_deg, camera.eye.lon_deg, exaggeration).value_or(0.0);
    const double reach_m =
        flight_speed_m_s(camera.eye.h_m - ground_m) * (step.fast ? 5.0 : 1.0) * step.elapsed_s;
    if (step.forward != 0.0 || step.right != 0.0) {
        const double heading = radians_from_deg(camera.attitude.heading_deg).rad;
        const glm::dvec3 east_north_up(std::sin(heading) * step.forward + std::cos(heading) * step.right,
                                       std::cos(heading) * step.forward - std::sin(heading) * step.right,
                                       0.0);
        // A straight step climbs off the ellipsoid by its square over twice the radius; level flight takes
        // that back. The heading is carried along as a direction in space, so that it holds across a pole.
        const glm::dmat3 from_enu = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg);
        const glm::dvec3 ahead = from_enu * glm::dvec3(std::sin(heading), std::cos(heading), 0.0);
        next.eye = geodetic_from_ecef({camera.eye_ecef().m + from_enu * east_north_up * reach_m});
        next.eye.h_m = camera.eye.h_m;
        next.attitude.heading_deg = attitude_of_direction(next.eye, ahead).heading_deg;
    }
    next.eye.h_m = std::min(next.eye.h_m + step.up * reach_m, 1e9);
    next.attitude.heading_deg = std::fmod(next.attitude.heading_deg + step.turn_right_deg + 720.0, 360.0);
    next.attitude.pitch_deg = std::clamp(next.attitude.pitch_deg + step.turn_up_deg, -90.0, 90.0);
    return above_ground(next, field, exaggeration);
}

}  // namespace oro
