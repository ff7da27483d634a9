// The line that a window's user draws to measure it.
#pragma once

#include "apps/window/viewer.h"

namespace oro {

// Adds what is seen at a point of the picture. Nothing where there is no ground. Errors: posts.
Result<void> add_place(Viewer& viewer, glm::dvec2 point_px);
Result<void> take_back_place(Viewer& viewer);
// Measures a line of places anew, in the place of that which is there. Errors: likewise.
Result<void> measure_places(Viewer& viewer, const std::vector<LatLon>& places);
Result<void> clear_places(Viewer& viewer);

}  // namespace oro
