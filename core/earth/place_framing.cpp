#include "core/earth/place_framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/earth/framing.h"

namespace oro {
namespace {

double heading_within_turn(double heading_deg) {
    return std::fmod(std::fmod(heading_deg, 360.0) + 360.0, 360.0);
}

// Rows right, up, back of a view along a line of sight, in ECEF axes.
glm::dmat3 view_along(const Geodetic& place, const LineOfSight& line, double roll_deg) {
    Camera there;
    there.eye = place;
    there.attitude = {line.heading_deg, line.pitch_deg, roll_deg};
    return there.view_from_ecef();
}

bool is_straight(const LineOfSight& line) {
    return std::abs(line.pitch_deg) >= 90.0;
}

// Of an eye that looks along a line of sight, forward_ecef there: the line's turn is its heading, and never a
// roll. Straight up or down no direction tells a heading; the line itself does.
Attitude attitude_along(const Geodetic& eye, const glm::dvec3& forward_ecef, const LineOfSight& line,
                        double roll_deg) {
    Attitude attitude = attitude_of_direction(eye, forward_ecef);
    if (is_straight(line))
        attitude = {heading_within_turn(line.heading_deg), std::copysign(90.0, line.pitch_deg), 0.0};
    attitude.roll_deg = roll_deg;
    return attitude;
}

// The camera whose picture holds all points, and that looks straight down (or up) where it is itself.
// Turning it by as much as its place is beside `middle` moves its place by less than that again.
Camera straight_camera(Camera there, const Geodetic& middle, const LineOfSight& line, double nearest_m,
                       std::span<const Ecef> points, double margin) {
    constexpr int most_turns = 40;
    constexpr double near_enough = 1e-12;
    const double roll_deg = there.attitude.roll_deg;
    there.eye = middle;
    there.attitude = attitude_along(middle, {}, line, roll_deg);
    for (int i = 0; i < most_turns; ++i) {
        const Ecef last = there.eye_ecef();
        there.eye =
            geodetic_from_ecef(eye_that_frames(there, there.view_from_ecef(), points, margin, nearest_m));
        if (i > 0 && glm::distance(there.eye_ecef().m, last.m) < near_enough * wgs84_a_m) break;
    }
    return there;
}

}  // namespace

std::vector<LineOfSight> lines_to_try(const AskedLine& asked) {
    constexpr std::array<double, 8> turns_deg{0.0, 45.0, -45.0, 90.0, -90.0, 135.0, -135.0, 180.0};
    constexpr std::array<double, 3> steeper_deg{-40.0, -60.0, -85.0};
    std::vector<double> headings, pitches{asked.pitch_deg.value_or(asked.usual_pitch_deg)};
    for (const double turn_deg : turns_deg)
        if (!asked.heading_deg) headings.push_back(heading_within_turn(asked.usual_heading_deg + turn_deg));
    if (asked.heading_deg) headings.push_back(*asked.heading_deg);
    for (const double pitch_deg : steeper_deg)
        if (!asked.pitch_deg && pitch_deg < pitches.back()) pitches.push_back(pitch_deg);
    std::vector<LineOfSight> lines;
    for (const double pitch_deg : pitches)
        for (const double heading_deg : headings) lines.push_back({heading_deg, pitch_deg});
    return lines;
}

Camera camera_on_place(const Camera& camera, const Geodetic& place, const LineOfSight& line, double radius_m,
                       double margin) {
    const glm::dvec2 reach = camera.half_fov_tangent() * (1.0 - 2.0 * margin);
    const double distance_m = radius_m / std::sin(std::atan(std::min(reach.x, reach.y)));
    const glm::dmat3 axes = glm::transpose(view_along(place, line, 0.0));
    Camera there = camera;
    there.eye = geodetic_from_ecef({ecef_from_geodetic(place).m + axes[2] * distance_m});
    there.attitude = attitude_along(there.eye, -axes[2], line, camera.attitude.roll_deg);
    return there;
}

// Where the eye stands decides how an oblique picture is turned for its horizon to be level, and the other
// way round; a picture from far above has no horizon, and is turned by its middle.
Camera camera_on_points(const Camera& camera, const Geodetic& middle, double radius_m,
                        const LineOfSight& line, std::span<const Ecef> points, double margin) {
    const double roll_deg = camera.attitude.roll_deg, nearest_m = std::max(1.0, 0.1 * radius_m);
    Camera there = camera;
    if (is_straight(line)) return straight_camera(camera, middle, line, nearest_m, points, margin);
    glm::dmat3 axes = glm::transpose(view_along(middle, line, roll_deg));
    const bool oblique = std::abs(line.pitch_deg) < steep_pitch_deg;
    for (int i = 0; i < (oblique ? 8 : 1); ++i) {
        there.eye =
            geodetic_from_ecef(eye_that_frames(there, glm::transpose(axes), points, margin, nearest_m));
        there.attitude = oblique ? attitude_of_direction(there.eye, -axes[2])
                                 : attitude_of_axes(there.eye, -axes[2], axes[0]);
        if (!oblique) break;
        there.attitude.roll_deg = roll_deg;
        axes = glm::transpose(there.view_from_ecef());
    }
    return there;
}

double foreground_share(const Camera& camera, const Geodetic& place, const GroundHeightAt& ground_h_m) {
    Camera level = camera;
    level.attitude.roll_deg = 0.0;
    const glm::dvec3 eye = level.eye_ecef().m, up = ecef_from_enu(place.lat_deg, place.lon_deg)[2];
    const double over_m = glm::dot(eye - ecef_from_geodetic(place).m, up);
    int seen = 0, with_ground = 0;
    for (const double across : {0.1, 0.5, 0.9}) {
        for (const double down : {0.6, 0.75, 0.9}) {
            const glm::dvec3 towards =
                level.ecef_direction_at({across * level.width_px, down * level.height_px});
            const double falls = -glm::dot(towards, up);
            if (over_m <= 0.0 || falls <= 0.0) continue;
            const Geodetic at = geodetic_from_ecef({eye + towards * (over_m / falls)});
            ++seen;
            with_ground += ground_h_m(at.lat_deg, at.lon_deg) ? 1 : 0;
        }
    }
    return seen == 0 ? 1.0 : static_cast<double>(with_ground) / seen;
}

double picture_top_deg(const Attitude& attitude, double roll_deg) {
    const double made_deg = attitude.roll_deg - roll_deg;
    if (std::abs(attitude.pitch_deg) < steep_pitch_deg) return attitude.heading_deg;
    return heading_within_turn(attitude.heading_deg + (attitude.pitch_deg < 0.0 ? made_deg : -made_deg));
}

bool is_line_free(const Geodetic& eye, const Geodetic& place, double step_m,
                  const GroundHeightAt& ground_h_m) {
    constexpr double room = 0.05;
    constexpr double most_samples = 2048.0;
    const glm::dvec3 from = ecef_from_geodetic(place).m, along = ecef_from_geodetic(eye).m - from;
    const double length_m = glm::length(along);
    const int samples = static_cast<int>(std::clamp(std::ceil(length_m / step_m), 1.0, most_samples));
    for (int i = 1; i <= samples; ++i) {
        const double share = static_cast<double>(i) / samples;
        const Geodetic at = geodetic_from_ecef({from + along * share});
        const std::optional<double> ground_m = ground_h_m(at.lat_deg, at.lon_deg);
        if (ground_m && at.h_m < *ground_m + room * share * length_m) return false;
    }
    return true;
}

}  // namespace oro
