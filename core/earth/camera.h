// The eye: where it is in ECEF, how it looks, and which part of space a picture of it holds.
#pragma once

#include <array>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "core/earth/ellipsoid.h"

namespace oro {

// How an eye looks, in the local frame of its place. Heading is true, clockwise from north; pitch is 0 level
// and negative downwards; roll is clockwise as the viewer sees it (the right side goes down).
struct Attitude {
    double heading_deg{};
    double pitch_deg{};
    double roll_deg{};
};

// A pinhole eye: from where a picture is taken, in which direction, and how many pixels it has. View axes are
// x right, y up, z backwards (the eye looks along -z).
//     Camera camera;
//     camera.eye = {36.55, -84.25, 620.0};       // latitude, longitude, h
//     camera.attitude = {30.0, -10.0, 0.0};      // heading, pitch, roll
//     camera.width_px = 320, camera.height_px = 240;
//     const glm::dvec3 towards = camera.ecef_direction_at({160.5, 180.5});
struct Camera {
    Geodetic eye;
    Attitude attitude;
    double vertical_fov_deg{45.0};  // 0.05 .. 120
    int width_px{1};
    int height_px{1};

    [[nodiscard]] Ecef eye_ecef() const { return ecef_from_geodetic(eye); }
    // Rotation: view direction = view_from_ecef * ecef direction. Orthonormal to 1e-15.
    [[nodiscard]] glm::dmat3 view_from_ecef() const;
    // Tangents of half the field of view, (horizontal, vertical).
    [[nodiscard]] glm::dvec2 half_fov_tangent() const;
    // Unit ECEF direction through a point of the picture, pixels from the top left corner (0.5, 0.5 is the
    // centre of the first).
    [[nodiscard]] glm::dvec3 ecef_direction_at(glm::dvec2 point_px) const;
};

// The eye's heading and pitch that put `target` into the picture's centre.
Attitude attitude_towards(const Geodetic& eye, const Geodetic& target);

// Attitude of a unit ECEF direction at a place (roll 0).
Attitude attitude_of_direction(const Geodetic& place, const glm::dvec3& ecef_direction);

// The rectangle of the whole picture that one frame draws, and the shift of its sample within the pixel.
struct Tile {
    int x_px{0};
    int y_px{0};
    int width_px{1};
    int height_px{1};
    glm::dvec2 sample_px{0.5, 0.5};  // where in each pixel the ray goes through, in [0, 1)
};

// Clip coordinates of a view position v for a tile: (scale.x v.x + shift.x w, scale.y v.y + shift.y w, near,
// w) with w = -v.z. Depth is reversed (near plane 1, infinity 0); y of the framebuffer points down. The float
// forms go to the GPU.
struct Projection {
    glm::dvec2 scale;
    glm::dvec2 shift;
    double near_m;
};
inline constexpr double near_plane_m = 0.01;
Projection projection_of_tile(const Camera& camera, const Tile& tile);

// A plane n.p + d >= 0 inside, n of unit length: (n, d).
using Plane = glm::dvec4;
// Left, right, bottom, top, near planes of a tile in view coordinates, pointing inwards. There is no far
// plane.
std::array<Plane, 5> frustum_planes_view(const Projection& projection);

}  // namespace oro
