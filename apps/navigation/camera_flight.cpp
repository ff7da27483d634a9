#include "apps/navigation/camera_flight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "apps/navigation/flight_step.h"
#include "geo/places/geodesic.h"

namespace oro {
namespace {

constexpr double rho = 1.42;
constexpr double no_distance_m = 1e-3;

double height_over_ground_m(const Camera& camera, const GroundHeightAt& ground_h_m) {
    const double ground_m = ground_h_m(camera.eye.lat_deg, camera.eye.lon_deg).value_or(0.0);
    return std::max(camera.eye.h_m - ground_m, eye_clearance_m);
}

// From 0 to 1 with no speed and no acceleration at the ends.
double eased(double share) {
    return share * share * share * (share * (6.0 * share - 15.0) + 10.0);
}

double between(double from, double to, double share) {
    return from + share * (to - from);
}

double shortest_turn_deg(double turn_deg) {
    return std::remainder(turn_deg, 360.0);
}

}  // namespace

Flight::Flight(const Camera& from, const Camera& to, GroundHeightAt ground_h_m)
    : from_(from),
      to_(to),
      ground_h_m_(std::move(ground_h_m)),
      from_width_m_(height_over_ground_m(from, ground_h_m_)),
      to_width_m_(height_over_ground_m(to, ground_h_m_)) {
    const GeodesicPath path =
        geodesic_between(from.eye.lat_deg, from.eye.lon_deg, to.eye.lat_deg, to.eye.lon_deg);
    distance_m_ = path.distance_m > no_distance_m ? path.distance_m : 0.0;
    start_bearing_deg_ = distance_m_ > 0.0 ? path.bearing_deg : 0.0;
    choose_path(from_width_m_, to_width_m_);
    from_turn_deg_ = from.attitude.heading_deg - bearing_at_deg(from.eye, 0.0);
    turn_deg_ =
        shortest_turn_deg(to.attitude.heading_deg - bearing_at_deg(to.eye, distance_m_) - from_turn_deg_);
    const double most_turn_deg =
        std::max({std::abs(turn_deg_), std::abs(to.attitude.pitch_deg - from.attitude.pitch_deg),
                  std::abs(shortest_turn_deg(to.attitude.roll_deg - from.attitude.roll_deg))});
    constexpr double pace_per_s = 2.5, turn_deg_s = 90.0;
    duration_s_ = std::clamp(std::max(length_ / pace_per_s, most_turn_deg / turn_deg_s), shortest_flight_s,
                             longest_flight_s);
}

// b, r and S of the source; without a distance the height changes evenly by its logarithm.
void Flight::choose_path(double from_width_m, double to_width_m) {
    const double least_m = 1e-6 * std::min(from_width_m, to_width_m);
    if (distance_m_ <= least_m) {
        length_ = std::abs(std::log(to_width_m / from_width_m)) / rho;
        return;
    }
    const double rho2_u = rho * rho * distance_m_;
    const double difference = (to_width_m - from_width_m) * (to_width_m + from_width_m);
    const double b_0 = (difference + rho2_u * rho2_u) / (2.0 * from_width_m * rho2_u);
    const double b_1 = (difference - rho2_u * rho2_u) / (2.0 * to_width_m * rho2_u);
    start_r_ = -std::asinh(b_0);
    length_ = (-std::asinh(b_1) - start_r_) / rho;
}

// u(s) / u1 of the source, by sinh(x - y) = sinh x cosh y - cosh x sinh y.
double Flight::ground_share(double pace) const {
    if (distance_m_ <= 1e-6 * std::min(from_width_m_, to_width_m_)) return pace;
    const double along = rho * length_ * pace;
    const double u_m = from_width_m_ / (rho * rho) * std::sinh(along) / std::cosh(along + start_r_);
    return std::clamp(u_m / distance_m_, 0.0, 1.0);
}

// w(s) of the source.
double Flight::width_m(double pace) const {
    if (distance_m_ <= 1e-6 * std::min(from_width_m_, to_width_m_))
        return from_width_m_ * std::pow(to_width_m_ / from_width_m_, pace);
    return from_width_m_ * std::cosh(start_r_) / std::cosh(rho * length_ * pace + start_r_);
}

// The direction of the geodesic at a place of it, so far from its start; north where there is no distance.
double Flight::bearing_at_deg(const Geodetic& place, double along_m) const {
    if (distance_m_ == 0.0) return 0.0;
    constexpr double beyond_m = 10.0;
    const auto point_m = [&](double at_m) {
        const LatLon at = geodesic_towards(from_.eye.lat_deg, from_.eye.lon_deg, start_bearing_deg_, at_m);
        return ecef_from_geodetic({at.lat_deg, at.lon_deg, 0.0}).m;
    };
    return attitude_of_direction(place, glm::normalize(point_m(along_m + beyond_m) - point_m(along_m)))
        .heading_deg;
}

// From far above what one goes to is below: 0 as high as an end of the flight, 1 where it is highest.
double Flight::looks_down(double width_m) const {
    const double end_m = std::max(from_width_m_, to_width_m_);
    const double highest_m = start_r_ < 0.0 ? from_width_m_ * std::cosh(start_r_) : end_m;
    constexpr double least_rise = 3.0;  // by e for each 1
    return std::clamp(std::log(width_m / end_m) / std::max(least_rise, std::log(highest_m / end_m)), 0.0,
                      1.0);
}

Camera Flight::camera_at(double time_s) const {
    Camera there = to_;
    if (!(time_s < duration_s_)) return there;
    if (time_s <= 0.0) {
        there = from_;
        there.width_px = to_.width_px, there.height_px = to_.height_px;
        return there;
    }
    const double pace = eased(time_s / duration_s_);
    const double share = ground_share(pace), width = width_m(pace);
    double bearing_deg = 0.0;
    if (distance_m_ > 0.0) {
        const double along_m = share * distance_m_;
        const LatLon at = geodesic_towards(from_.eye.lat_deg, from_.eye.lon_deg, start_bearing_deg_, along_m);
        there.eye.lat_deg = at.lat_deg, there.eye.lon_deg = at.lon_deg;
        bearing_deg = bearing_at_deg(there.eye, along_m);
    }
    there.eye.h_m = between(from_.eye.h_m - from_width_m_, to_.eye.h_m - to_width_m_, share) + width;
    const double heading_deg = bearing_deg + from_turn_deg_ + pace * turn_deg_;
    there.attitude.heading_deg = std::fmod(std::fmod(heading_deg, 360.0) + 360.0, 360.0);
    constexpr double down_deg = -60.0;
    const double level_deg = between(from_.attitude.pitch_deg, to_.attitude.pitch_deg, pace);
    const double pitch_deg = between(level_deg, std::min(level_deg, down_deg), looks_down(width));
    there.attitude.pitch_deg = std::clamp(pitch_deg, -90.0, 90.0);
    there.attitude.roll_deg =
        from_.attitude.roll_deg + pace * shortest_turn_deg(to_.attitude.roll_deg - from_.attitude.roll_deg);
    there.vertical_fov_deg =
        from_.vertical_fov_deg * std::pow(to_.vertical_fov_deg / from_.vertical_fov_deg, pace);
    return above_ground(there, ground_h_m_);
}

}  // namespace oro
