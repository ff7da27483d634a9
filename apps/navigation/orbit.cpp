#include "apps/navigation/orbit.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "apps/navigation/flight_step.h"

namespace oro {
namespace {

// Where the eye is, from the pivot: in its local frame.
struct OrbitPlace {
    double azimuth_deg;
    double elevation_deg;
    double distance_m;
};

OrbitPlace orbit_place(const Camera& camera, const Ecef& pivot, const Geodetic& place) {
    const glm::dvec3 offset_m = camera.eye_ecef().m - pivot.m;
    const double distance_m = glm::length(offset_m);
    const glm::dvec3 enu =
        glm::transpose(ecef_from_enu(place.lat_deg, place.lon_deg)) * (offset_m / distance_m);
    const double level = std::hypot(enu.x, enu.y);
    constexpr double straight = 1e-9;
    const double azimuth_deg = level > straight ? deg_from_radians(Radians{std::atan2(enu.x, enu.y)})
                                                : camera.attitude.heading_deg + 180.0;
    return {azimuth_deg, deg_from_radians(Radians{std::atan2(enu.z, level)}), distance_m};
}

Geodetic eye_of(const OrbitPlace& orbit, const Ecef& pivot, const Geodetic& place) {
    const SineCosine azimuth = sine_cosine_deg(orbit.azimuth_deg);
    const SineCosine elevation = sine_cosine_deg(orbit.elevation_deg);
    const glm::dvec3 enu(azimuth.sine * elevation.cosine, azimuth.cosine * elevation.cosine, elevation.sine);
    return geodetic_from_ecef(
        {pivot.m + ecef_from_enu(place.lat_deg, place.lon_deg) * enu * orbit.distance_m});
}

bool is_over_ground(const Geodetic& eye, const GroundHeightAt& ground_h_m) {
    const auto ground = ground_h_m(eye.lat_deg, eye.lon_deg);
    return !ground || eye.h_m >= *ground + eye_clearance_m;
}

// The least elevation from one on at which the eye is over the ground; nothing where none is.
std::optional<double> free_elevation_deg(OrbitPlace orbit, const Ecef& pivot, const Geodetic& place,
                                         const GroundHeightAt& ground_h_m) {
    const auto is_free = [&](double elevation_deg) {
        orbit.elevation_deg = elevation_deg;
        return is_over_ground(eye_of(orbit, pivot, place), ground_h_m);
    };
    double low_deg = orbit.elevation_deg;
    if (is_free(low_deg)) return low_deg;
    constexpr int steps = 64;
    const double step_deg = (most_orbit_pitch_deg - low_deg) / steps;
    int step = 1;
    while (step <= steps && !is_free(low_deg + step * step_deg)) ++step;
    if (step > steps) return std::nullopt;
    double high_deg = low_deg + step * step_deg;
    low_deg = high_deg - step_deg;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
        const double middle_deg = 0.5 * (low_deg + high_deg);
        (is_free(middle_deg) ? high_deg : low_deg) = middle_deg;
    }
    return high_deg;
}

// The camera at a place of its orbit.
std::optional<Camera> camera_on(const Camera& camera, OrbitPlace orbit, double turn_deg, const Ecef& pivot,
                                const Geodetic& place, glm::dvec2 point_px, const GroundHeightAt& ground_h_m,
                                const Air& air) {
    const auto elevation_deg = free_elevation_deg(orbit, pivot, place, ground_h_m);
    if (!elevation_deg) return std::nullopt;
    orbit.elevation_deg = *elevation_deg;
    // The camera turns with the line to the pivot; the pixel asks for little more.
    const SineCosine turn = sine_cosine_deg(-turn_deg);
    const glm::dmat3 axes = ecef_from_enu(place.lat_deg, place.lon_deg);
    const glm::dmat3 about_up(glm::dvec3(turn.cosine, turn.sine, 0.0),
                              glm::dvec3(-turn.sine, turn.cosine, 0.0), glm::dvec3(0.0, 0.0, 1.0));
    const Camera there =
        carried_to(camera, eye_of(orbit, pivot, place), axes * about_up * glm::transpose(axes));
    // A camera that looks more steeply already may stay as steep.
    const double now_deg = camera.attitude.pitch_deg;
    const Holding holding =
        turned_to_hold(there, seen_direction(there, pivot, air), point_px,
                       std::min(-most_orbit_pitch_deg, now_deg), std::max(most_orbit_pitch_deg, now_deg));
    return holding.exact ? std::optional(holding.camera) : std::nullopt;
}

}  // namespace

Camera orbited(const Camera& camera, const Ecef& pivot, double d_azimuth_deg, double d_pitch_deg,
               const GroundHeightAt& ground_h_m, const Air& air) {
    const auto point_px = pixel_of(camera, pivot, air);
    if (!point_px || (d_azimuth_deg == 0.0 && d_pitch_deg == 0.0)) return camera;
    const Geodetic place = geodetic_from_ecef(pivot);
    const OrbitPlace now = orbit_place(camera, pivot, place);
    if (!(now.distance_m > 0.0)) return camera;
    const auto at_share = [&](double share) {
        OrbitPlace next = now;
        next.azimuth_deg += d_azimuth_deg;
        next.elevation_deg =
            std::clamp(now.elevation_deg - share * d_pitch_deg, -most_orbit_pitch_deg, most_orbit_pitch_deg);
        return camera_on(camera, next, d_azimuth_deg, pivot, place, *point_px, ground_h_m, air);
    };
    if (const auto whole = at_share(1.0)) return *whole;
    // Where the camera cannot be as steep as asked for, it is as steep as it can.
    Camera there = camera;
    double low = 0.0, high = 1.0;
    if (const auto level = at_share(0.0)) there = *level;
    constexpr int halvings = 40;
    for (int i = 0; i < halvings; ++i) {
        const double middle = 0.5 * (low + high);
        const auto next = at_share(middle);
        if (next) there = *next;
        (next ? low : high) = middle;
    }
    return there;
}

Camera north_up(const Camera& camera, const std::optional<Ecef>& pivot, double roll_deg,
                const GroundHeightAt& ground_h_m, const Air& air) {
    // The roll that framing made is a part of the turn of pictures from above.
    Camera there = camera;
    there.attitude.heading_deg = picture_top_deg(camera.attitude, roll_deg);
    there.attitude.roll_deg = roll_deg;
    constexpr int most_steps = 8;
    constexpr double north_deg = 1e-6;
    for (int i = 0; i < most_steps && pivot; ++i) {
        const double turn_deg = std::remainder(-there.attitude.heading_deg, 360.0);
        if (std::abs(turn_deg) < north_deg) break;
        there = orbited(there, *pivot, turn_deg, 0.0, ground_h_m, air);
    }
    there.attitude.heading_deg = 0.0;
    return there;
}

}  // namespace oro
