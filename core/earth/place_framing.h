// Where an eye must be to show a place, or a part of the ground: obliquely, and so that nothing stands before
// it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/earth/camera.h"

namespace oro {

// The line of sight along which a place is looked at, in the local frame of that place: heading true,
// clockwise from north; pitch negative downwards.
struct LineOfSight {
    double heading_deg{};
    double pitch_deg{};
};

// What is asked of a line of sight: nothing where any heading or pitch will do, of which the usual one is
// tried first.
struct AskedLine {
    std::optional<double> heading_deg;
    std::optional<double> pitch_deg;
    double usual_heading_deg{};
    double usual_pitch_deg{-20.0};
};

// The lines of sight that are worth a trial, the most wanted first: at the usual pitch from the usual side
// and then from the seven others, 45 degrees apart; then steeper ones, the last of them from almost straight
// above. What is asked for is in each of them. There is at least one.
std::vector<LineOfSight> lines_to_try(const AskedLine& asked);

// From so far above a picture has no horizon that tells how it is turned.
inline constexpr double steep_pitch_deg = 75.0;

// The camera that has `place` in the very middle of its picture, along a line of sight, as near as a ball of
// radius_m (> 0) around the place leaves `margin` (0 .. 0.4) of the narrower side of the picture free on both
// sides. Roll, angle of view and size are those of `camera`; the heading is that of the line, as the eye has
// it. Exact but for rounding (1e-8 of the distance).
Camera camera_on_place(const Camera& camera, const Geodetic& place, const LineOfSight& line, double radius_m,
                       double margin);

// The camera whose picture holds all points with `margin` around them, as eye_that_frames() puts it, along a
// line of sight in the local frame of `middle`. radius_m: of a ball around their mean that holds all points;
// they are at least a tenth of it (and 1 m) before the eye. Roll, angle of view and size are those of
// `camera`. Oblique pictures have a level horizon at roll 0. Pictures from steep_pitch_deg up are turned as
// `middle` has it: their roll may hold a part of that turn (picture_top_deg() tells the whole). Straight down
// or up is so where the eye is, with the line's own heading and the roll of `camera`.
Camera camera_on_points(const Camera& camera, const Geodetic& middle, double radius_m,
                        const LineOfSight& line, std::span<const Ecef> points, double margin);

// Gives the height of the ground above the ellipsoid at a place, in metres; nothing where there are no data.
using GroundHeightAt = std::function<std::optional<double>(double lat_deg, double lon_deg)>;

// How much of a picture's foreground is ground: the share, 0 .. 1, of nine points all over its lower half (at
// roll 0) where the level plane through `place` has data; 1 where none of them is on that plane.
double foreground_share(const Camera& camera, const Geodetic& place, const GroundHeightAt& ground_h_m);

// The direction, clockwise from north, that is up in a picture but for a roll of roll_deg: its heading, and
// from steep_pitch_deg up the whole turn that framing divided between heading and roll.
double picture_top_deg(const Attitude& attitude, double roll_deg);

// Whether the ground lets an eye see a place, with some room: at places step_m (> 0) apart along the straight
// line between them, at most 2,048 of them, and under the eye itself, the line is above the ground by 5 % of
// its length from the place to there (some 3 degrees). What has no data hides nothing.
bool is_line_free(const Geodetic& eye, const Geodetic& place, double step_m,
                  const GroundHeightAt& ground_h_m);

}  // namespace oro
