#include "core/earth/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace oro {
namespace {

// Columns right, up, back of the view in the local frame.
glm::dmat3 enu_from_view(const Attitude& attitude) {
    const SineCosine heading = sine_cosine_deg(attitude.heading_deg);
    const SineCosine pitch = sine_cosine_deg(attitude.pitch_deg);
    const SineCosine roll = sine_cosine_deg(attitude.roll_deg);
    const glm::dvec3 forward(heading.sine * pitch.cosine, heading.cosine * pitch.cosine, pitch.sine);
    const glm::dvec3 level_right(heading.cosine, -heading.sine, 0.0);
    const glm::dvec3 level_up = glm::cross(level_right, forward);
    return {level_right * roll.cosine - level_up * roll.sine,
            level_up * roll.cosine + level_right * roll.sine, -forward};
}

Plane plane_through_eye(const glm::dvec3& inward) {
    return {glm::normalize(inward), 0.0};
}

}  // namespace

glm::dmat3 Camera::view_from_ecef() const {
    return glm::transpose(ecef_from_enu(eye.lat_deg, eye.lon_deg) * enu_from_view(attitude));
}

glm::dvec2 Camera::half_fov_tangent() const {
    const double vertical = std::tan(radians_from_deg(0.5 * vertical_fov_deg).rad);
    return {vertical * width_px / height_px, vertical};
}

glm::dvec3 Camera::ecef_direction_at(glm::dvec2 point_px) const {
    const glm::dvec2 tangent = half_fov_tangent();
    const glm::dvec3 view((2.0 * point_px.x / width_px - 1.0) * tangent.x,
                          (1.0 - 2.0 * point_px.y / height_px) * tangent.y, -1.0);
    return glm::normalize(glm::transpose(view_from_ecef()) * view);
}

Attitude attitude_towards(const Geodetic& eye, const Geodetic& target) {
    const glm::dvec3 offset_m = ecef_from_geodetic(target).m - ecef_from_geodetic(eye).m;
    const double distance_m = glm::length(offset_m);
    if (distance_m == 0.0) return {};
    return attitude_of_direction(eye, offset_m / distance_m);
}

Attitude attitude_of_direction(const Geodetic& place, const glm::dvec3& ecef_direction) {
    const glm::dvec3 enu = glm::transpose(ecef_from_enu(place.lat_deg, place.lon_deg)) * ecef_direction;
    const double level = std::hypot(enu.x, enu.y);
    Attitude attitude;
    // Straight up or down has no heading of its own; what rounding leaves of one is not passed on.
    if (level > 1.0e-12) {
        const double heading_deg = deg_from_radians(Radians{std::atan2(enu.x, enu.y)});
        attitude.heading_deg = heading_deg < 0.0 ? heading_deg + 360.0 : heading_deg;
        if (attitude.heading_deg >= 360.0) attitude.heading_deg = 0.0;
    }
    attitude.pitch_deg = deg_from_radians(Radians{std::atan2(enu.z, level)});
    return attitude;
}

Projection projection_of_tile(const Camera& camera, const Tile& tile) {
    const glm::dvec2 tangent = camera.half_fov_tangent();
    const glm::dvec2 picture_px(camera.width_px, camera.height_px);
    const glm::dvec2 corner_px(tile.x_px, tile.y_px);
    const glm::dvec2 tile_px(tile.width_px, tile.height_px);
    // The rasteriser samples the middle of a pixel: the picture moves so that the wanted sample comes to lie
    // there.
    return {picture_px / (tile_px * tangent) * glm::dvec2(1.0, -1.0),
            (picture_px - 2.0 * corner_px - 2.0 * tile.sample_px + 1.0) / tile_px - 1.0, near_plane_m};
}

std::array<Plane, 5> frustum_planes_view(const Projection& projection) {
    const glm::dvec2 scale = projection.scale;
    const glm::dvec2 shift = projection.shift;
    return {plane_through_eye({scale.x, 0.0, -(1.0 + shift.x)}),
            plane_through_eye({-scale.x, 0.0, -(1.0 - shift.x)}),
            plane_through_eye({0.0, -scale.y, -(1.0 - shift.y)}),
            plane_through_eye({0.0, scale.y, -(1.0 + shift.y)}), Plane(0.0, 0.0, -1.0, -projection.near_m)};
}

}  // namespace oro
