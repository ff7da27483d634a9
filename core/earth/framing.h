// Where an eye must stand for points to fill its picture.
#pragma once

#include <glm/mat3x3.hpp>
#include <span>

#include "core/earth/camera.h"

namespace oro {

// The attitude at a place of an eye whose picture has these unit axes: it looks along `forward_ecef`, and
// `right_ecef` (across it) is the picture's right. Rolls as far as that asks for.
Attitude attitude_of_axes(const Geodetic& place, const glm::dvec3& forward_ecef,
                          const glm::dvec3& right_ecef);

// The nearest place from which a picture turned as view_from_ecef (a rotation) holds all points, leaving
// `margin` (0 .. 0.4) of its width free on the left and on the right, and of its height above and below. On
// one of these pairs of sides points touch the margin on both; on the other they are centred. All points are
// at least nearest_m (> 0) before it along the line of sight: a picture so wide that it holds all of them
// from the very nearest touches them nowhere. Of the camera only its angle of view and its size count.
// `points`: at least one. Exact but for rounding (1e-8 of the distance).
Ecef eye_that_frames(const Camera& camera, const glm::dmat3& view_from_ecef, std::span<const Ecef> points,
                     double margin, double nearest_m);

}  // namespace oro
