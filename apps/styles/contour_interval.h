// How far apart contour lines stand in a view.
#pragma once

#include "core/earth/camera.h"
#include "core/terrain/post_grid.h"

namespace oro {

// The interval of H in metres (1, 2 or 5 times a power of ten, 1 to 5,000) with which contour lines stand
// some 11 px apart on the ground of a picture as it is at the median: 5 to 40 px at most of it. Towards 5 px
// where there would be less than five lines between the low ground and the high. The same for the same view.
// 100 where a picture shows no ground. Looks along 400 sight lines, in steps: a narrow ridge may be missed.
double contour_interval_m(const Camera& camera, double exaggeration, const HeightField& field);

// The interval of an eye that moves: the one that is shown, as long as the one that the view would have is
// the same, or the next or the last of 1, 2, 5, 10 and so on. So lines stay where they are while they stand
// 2 to 100 px apart instead of 5 to 40, and each change is followed by a long stretch without another.
double steady_interval_m(double shown_m, double wanted_m);

}  // namespace oro
