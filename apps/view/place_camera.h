// The camera that shows a place, for who did not ask to stand on it.
#pragma once

#include <string>

#include "core/base/result.h"
#include "core/earth/camera.h"
#include "core/earth/place_framing.h"
#include "geo/places/place.h"
#include "geo/region/region.h"

namespace oro {

// What a picture of a place shows around it, unless it is a cell: so many posts on each side.
inline constexpr double posts_around_place = 40.0;

// A cell of at least 4 posts a side is framed: all of its ground is in the picture, as an overview has that
// of a region, whatever is asked of its line of sight. Any other place is in the middle of the picture, with
// posts_around_place of ground around it (less where the grid is smaller), seen from a side and a height from
// which no ground hides it, and so that the picture's foreground is ground where any such side has that.
// Of the camera only its roll, angle of view and size count. Heights are exaggerated. `name` is how errors
// call the place ("--at 46,8"). Errors: no elevation data there (no_data), with the data's box; no eye on the
// asked line of sight sees the place (usage).
Result<Camera> camera_showing(const Camera& camera, const Place& place, const AskedLine& asked,
                              const Region& region, double exaggeration, const std::string& name);

// Whether camera_showing() frames a place, and does not look at it alone.
bool is_framed(const Place& place, const Region& region);

}  // namespace oro
