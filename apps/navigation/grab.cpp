#include "apps/navigation/grab.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "apps/navigation/flight_step.h"

namespace oro {
namespace {

constexpr double least_grazing_to_grab_deg = 2.0;
constexpr double least_grazing_deg = 1.0;

// The camera's right, if it had no roll: always level.
glm::dvec3 level_right(const Camera& camera) {
    const SineCosine heading = sine_cosine_deg(camera.attitude.heading_deg);
    return ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg) *
           glm::dvec3(heading.cosine, -heading.sine, 0.0);
}

double heading_of_right(const Geodetic& place, const glm::dvec3& right_ecef) {
    const glm::dvec3 right = glm::transpose(ecef_from_enu(place.lat_deg, place.lon_deg)) * right_ecef;
    const double heading_deg = deg_from_radians(Radians{std::atan2(-right.y, right.x)});
    return heading_deg < 0.0 ? heading_deg + 360.0 : heading_deg + 0.0;
}

// Source: O. Rodrigues, 1840.
glm::dvec3 turned_about(const glm::dvec3& v, const glm::dvec3& turn_rad) {
    const double angle = glm::length(turn_rad);
    if (angle == 0.0) return v;
    const glm::dvec3 axis = turn_rad / angle;
    const double half = std::sin(0.5 * angle);
    return v + std::sin(angle) * glm::cross(axis, v) +
           2.0 * half * half * glm::cross(axis, glm::cross(axis, v));
}

// The sphere that lies in the ellipsoid most closely at the eye, and through the place.
struct HeldSphere {
    glm::dvec3 centre_m;
    glm::dvec3 up;  // at the eye
    double eye_m;   // distances from the centre
    double place_m;
};

HeldSphere sphere_of(const Camera& camera, const Ecef& place) {
    const glm::dvec3 up = ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)[2];
    const double eye_m = gaussian_radius_m(camera.eye.lat_deg) + camera.eye.h_m;
    const glm::dvec3 centre_m = camera.eye_ecef().m - up * eye_m;
    return {centre_m, up, eye_m, glm::length(place.m - centre_m)};
}

// Offset from the centre of where a line of sight meets the sphere, at least_grazing_deg or steeper: a
// flatter line is lowered. Sets `lowered`.
glm::dvec3 met_on(const HeldSphere& sphere, const glm::dvec3& direction, bool& lowered) {
    const double most_sine =
        std::min(1.0, sphere.place_m * std::cos(radians_from_deg(least_grazing_deg).rad) / sphere.eye_m);
    const glm::dvec3 level = direction - glm::dot(direction, sphere.up) * sphere.up;
    double sine = glm::length(level), cosine = -glm::dot(direction, sphere.up);
    const glm::dvec3 across = sine > 0.0 ? level / sine : glm::dvec3(0.0);
    lowered = cosine <= 0.0 || sine > most_sine;
    if (lowered) {
        sine = most_sine;
        cosine = std::sqrt(1.0 - sine * sine);
    }
    const double beside_m = sphere.eye_m * sine;
    const double length_m = sphere.eye_m * cosine -
                            std::sqrt(std::max(0.0, sphere.place_m * sphere.place_m - beside_m * beside_m));
    return sphere.up * (sphere.eye_m - length_m * cosine) + across * (length_m * sine);
}

// Newton's steps in two turns of the eye about the sphere's centre.
class Mover {
  public:
    Mover(const Camera& camera, const Ecef& place, const HeldSphere& sphere, const Air& air)
        : camera_(camera),
          place_(place),
          air_(air),
          centre_m_(sphere.centre_m),
          eye_m_(camera.eye_ecef().m - sphere.centre_m),
          right_(level_right(camera)) {}

    [[nodiscard]] Camera at(const glm::dvec3& turn_rad) const {
        Camera there = camera_;
        there.eye = geodetic_from_ecef({centre_m_ + turned_about(eye_m_, turn_rad)});
        there.eye.h_m = camera_.eye.h_m;
        there.attitude.heading_deg = heading_of_right(there.eye, turned_about(right_, turn_rad));
        return there;
    }
    [[nodiscard]] std::optional<glm::dvec2> pixel(const glm::dvec3& turn_rad) const {
        return pixel_of(at(turn_rad), place_, air_);
    }

    // From a first turn to one that has the place at the pixel; the distance left, in pixels.
    double solve(glm::dvec3& turn_rad, const glm::dvec3& u, const glm::dvec3& v, glm::dvec2 point_px) const {
        constexpr double enough_px = 1e-5;
        auto seen = pixel(turn_rad);
        if (!seen) return 1e9;
        double left_px = glm::distance(*seen, point_px);
        for (int i = 0; i < 30 && left_px > enough_px; ++i) {
            const double step_rad =
                1e-4 * glm::distance(at(turn_rad).eye_ecef().m, place_.m) / glm::length(eye_m_);
            const auto by_u = pixel(turn_rad + step_rad * u), by_v = pixel(turn_rad + step_rad * v);
            if (!by_u || !by_v) break;
            const glm::dmat2 slopes((*by_u - *seen) / step_rad, (*by_v - *seen) / step_rad);
            if (glm::determinant(slopes) == 0.0) break;
            const glm::dvec2 step = glm::inverse(slopes) * (point_px - *seen);
            double share = 1.0;
            for (; share > 1e-3; share *= 0.5) {
                const glm::dvec3 next_rad = turn_rad + share * (step.x * u + step.y * v);
                const auto next = pixel(next_rad);
                if (!next || !(glm::distance(*next, point_px) < left_px)) continue;
                turn_rad = next_rad, seen = next, left_px = glm::distance(*next, point_px);
                break;
            }
            if (share <= 1e-3) break;
        }
        return left_px;
    }

  private:
    const Camera& camera_;
    const Ecef& place_;
    const Air& air_;
    glm::dvec3 centre_m_;
    glm::dvec3 eye_m_;
    glm::dvec3 right_;
};

// Of a direction at a pixel of a picture without roll: to the right, up, and 1 ahead along the line of sight.
glm::dvec3 unrolled_ray(const Camera& camera, glm::dvec2 point_px) {
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const double x = (2.0 * point_px.x / camera.width_px - 1.0) * tangent.x;
    const double y = (1.0 - 2.0 * point_px.y / camera.height_px) * tangent.y;
    const SineCosine roll = sine_cosine_deg(camera.attitude.roll_deg);
    return {x * roll.cosine + y * roll.sine, y * roll.cosine - x * roll.sine, 1.0};
}

// The heading that has a direction (ENU) at an unrolled ray, at a pitch.
double heading_to_hold(const Camera& camera, const glm::dvec3& enu, const glm::dvec3& ray, double pitch_rad) {
    const double ahead = std::cos(pitch_rad) - ray.y * std::sin(pitch_rad);
    constexpr double straight = 1e-12;
    if (std::hypot(enu.x, enu.y) < straight || std::hypot(ray.x, ahead) < straight)
        return camera.attitude.heading_deg;
    const double heading_rad = std::atan2(enu.x, enu.y) - std::atan2(ray.x, ahead);
    const double heading_deg = std::fmod(deg_from_radians(Radians{heading_rad}) + 720.0, 360.0);
    return heading_deg;
}

}  // namespace

std::optional<glm::dvec2> pixel_of(const Camera& camera, const Ecef& point, const Air& air) {
    const glm::dvec3 offset_m = Refraction(camera.eye, air).apparent_m(point.m - camera.eye_ecef().m);
    const glm::dvec3 view = camera.view_from_ecef() * offset_m;
    if (!(view.z < 0.0)) return std::nullopt;
    const glm::dvec2 tangent = camera.half_fov_tangent();
    return glm::dvec2(0.5 * camera.width_px * (1.0 - view.x / view.z / tangent.x),
                      0.5 * camera.height_px * (1.0 + view.y / view.z / tangent.y));
}

glm::dvec3 seen_direction(const Camera& camera, const Ecef& point, const Air& air) {
    return glm::normalize(Refraction(camera.eye, air).apparent_m(point.m - camera.eye_ecef().m));
}

Camera carried_to(const Camera& camera, const Geodetic& eye, const glm::dmat3& rotation) {
    Camera there = camera;
    there.eye = eye;
    there.attitude.heading_deg = heading_of_right(eye, rotation * level_right(camera));
    return there;
}

Holding turned_to_hold(const Camera& camera, const glm::dvec3& ecef_direction, glm::dvec2 point_px,
                       double lowest_deg, double highest_deg) {
    const glm::dvec3 enu =
        glm::transpose(ecef_from_enu(camera.eye.lat_deg, camera.eye.lon_deg)) * ecef_direction;
    const glm::dvec3 ray = unrolled_ray(camera, point_px);
    // ray.y cos(pitch) + sin(pitch) = |ray| sin(elevation), solved for the pitch: two of them.
    const double reach = std::hypot(ray.y, 1.0), middle_rad = std::atan2(1.0, ray.y);
    const double cosine = glm::length(ray) * enu.z / reach;
    const double half_rad = std::acos(std::clamp(cosine, -1.0, 1.0));
    constexpr double rounding = 1e-12;
    Holding best;
    double best_pitch_deg = 1e9;
    for (const double pitch_rad : {middle_rad - half_rad, middle_rad + half_rad}) {
        const double whole_deg = std::remainder(deg_from_radians(Radians{pitch_rad}), 360.0);
        const double pitch_deg = std::clamp(whole_deg, lowest_deg, highest_deg);
        Holding one{camera, std::abs(cosine) <= 1.0 + rounding && std::abs(pitch_deg - whole_deg) < 1e-9};
        one.camera.attitude.pitch_deg = pitch_deg;
        one.camera.attitude.heading_deg = heading_to_hold(camera, enu, ray, radians_from_deg(pitch_deg).rad);
        const double turn_deg =
            std::remainder(one.camera.attitude.heading_deg - camera.attitude.heading_deg, 360.0);
        if (std::abs(turn_deg) > 90.0) one.exact = false;
        const double change_deg = std::abs(whole_deg - camera.attitude.pitch_deg);
        if (best_pitch_deg < 1e9 && (best.exact != one.exact ? best.exact : change_deg >= best_pitch_deg))
            continue;
        best = one, best_pitch_deg = change_deg;
    }
    const double turn_deg =
        std::remainder(best.camera.attitude.heading_deg - camera.attitude.heading_deg, 360.0);
    if (!best.exact && std::abs(turn_deg) > 90.0)
        best.camera.attitude.heading_deg = camera.attitude.heading_deg;
    return best;
}

Holding moved_to_hold(const Camera& camera, const Ecef& place, glm::dvec2 point_px, const Air& air) {
    const HeldSphere sphere = sphere_of(camera, place);
    bool lowered = false;
    const glm::dvec3 from = met_on(sphere, camera.ecef_direction_at(point_px), lowered);
    glm::dvec2 held_px = point_px;
    if (lowered) held_px = pixel_of(camera, {sphere.centre_m + from}).value_or(point_px);
    const glm::dvec3 to = place.m - sphere.centre_m;
    const glm::dvec3 outward = glm::normalize(from);
    const glm::dvec3 normal = glm::cross(outward, to);
    const double sine = glm::length(normal);
    glm::dvec3 turn_rad(0.0);
    if (sine > 0.0) turn_rad = normal / sine * std::atan2(sine, glm::dot(outward, to));
    const glm::dvec3 u = glm::normalize(
        glm::cross(outward, std::abs(outward.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
    const Mover mover(camera, place, sphere, air);
    constexpr double exact_px = 1e-3;
    const double left_px = mover.solve(turn_rad, u, glm::cross(outward, u), held_px);
    Holding moved{mover.at(turn_rad), true};
    if (!(left_px < exact_px))
        moved = turned_to_hold(moved.camera, seen_direction(moved.camera, place, air), held_px);
    moved.exact = moved.exact && !lowered;
    return moved;
}

bool grab_moves_eye(const GrabStart& start) {
    if (!start.place) return false;
    const HeldSphere sphere = sphere_of(start.camera, *start.place);
    const glm::dvec3 to_eye_m = start.camera.eye_ecef().m - start.place->m;
    const double rise = glm::dot(to_eye_m, start.place->m - sphere.centre_m);
    return rise >
           std::sin(radians_from_deg(least_grazing_to_grab_deg).rad) * glm::length(to_eye_m) * sphere.place_m;
}

Camera grabbed(const GrabStart& start, glm::dvec2 cursor_px, const GroundHeightAt& ground_h_m,
               const Air& air) {
    const Camera& camera = start.camera;
    if (cursor_px == start.pressed_px) return camera;
    if (!grab_moves_eye(start)) {
        const glm::dvec3 held = start.place ? seen_direction(camera, *start.place, air)
                                            : camera.ecef_direction_at(start.pressed_px);
        return turned_to_hold(camera, held, cursor_px).camera;
    }
    const Camera moved = moved_to_hold(camera, *start.place, cursor_px, air).camera;
    const Camera lifted = above_ground(moved, ground_h_m);
    if (lifted.eye.h_m == moved.eye.h_m) return moved;
    const auto held_px = pixel_of(moved, *start.place, air);
    return turned_to_hold(lifted, seen_direction(lifted, *start.place, air), held_px.value_or(cursor_px))
        .camera;
}

}  // namespace oro
