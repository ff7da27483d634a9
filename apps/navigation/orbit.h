// The eye goes round a place that it looks at.
#pragma once

#include "apps/navigation/grab.h"

namespace oro {

inline constexpr double most_orbit_pitch_deg = 89.9;  // up and down

// The camera whose eye is turned about the vertical of `pivot`, clockwise from above by d_azimuth_deg (any
// number), and about the level line across it by d_pitch_deg: below 0 the eye rises and looks down more
// steeply. The pivot stays as far away (to 1e-9 of the distance and some 1e-8 m) and at its pixel, the roll
// stays. Pitches, the camera's and that of the line to the pivot, stay within most_orbit_pitch_deg, and the
// eye eye_clearance_m over the ground: it rises as far as that asks for. Unchanged where there is no such
// camera, and where the pivot is not before it.
Camera orbited(const Camera& camera, const Ecef& pivot, double d_azimuth_deg, double d_pitch_deg,
               const GroundHeightAt& ground_h_m, const Air& air = {});

// The camera with north up, in a picture from above (core/earth/place_framing.h: steep_pitch_deg) as in an
// oblique one: orbited round the pivot until the heading is 0 (below 1e-6 degree), the roll that framing made
// taken away; turned where it is where there is no pivot, or where the ground does not let it. roll_deg: the
// user's own (apps/window/jump.h).
Camera north_up(const Camera& camera, const std::optional<Ecef>& pivot, double roll_deg,
                const GroundHeightAt& ground_h_m, const Air& air = {});

}  // namespace oro
