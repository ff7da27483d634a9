// The eye goes to a point of the picture, and away from it.
#pragma once

#include "apps/navigation/grab.h"

namespace oro {

inline constexpr double least_zoom_m = 2.0;  // from the eye to what it goes to
inline constexpr double most_zoom_m = 5e7;

// The camera whose eye is `factor` (> 0; below 1: nearer) times as far from `place`, on the line through it
// and the eye, with the place at the same pixel; turned for that as the eye's vertical turns, its roll kept.
// The distance stays within least_zoom_m and most_zoom_m (an eye that is beyond goes no further that way), so
// that the eye never goes through the place. The eye is lifted where it would be lower than eye_clearance_m
// over the ground, and the place is still at its pixel. Where the camera would have to look past the nadir
// for that, its pitch is -90 and the eye leaves the line. Where nothing holds the place, the eye goes as far
// as it can. The camera is unchanged where the place is not before it.
Camera zoomed(const Camera& camera, const Ecef& place, double factor, const GroundHeightAt& ground_h_m,
              const Air& air = {});

}  // namespace oro
