// From a tour of KML to the keys of a camera.
#pragma once

#include <string>
#include <vector>

#include "apps/film/camera_path.h"
#include "core/base/result.h"
#include "geo/region/region.h"
#include "geo/vectors/kml_tour.h"

namespace oro {

// The keys of a tour's stops (one or more), all heights above the ellipsoid. The film begins at the first
// stop itself; a stop that is reached in no time takes a thousandth of a second. A Camera looks up by its
// tilt less 90 degrees, and its roll turns its right side down, as Cesium reads KML; a LookAt has no roll.
// Altitudes of KML are above sea level. Errors: no ground below what is placed over it (no_data).
Result<std::vector<CameraKey>> keys_of_tour(const std::vector<TourStop>& stops, double vertical_fov_deg,
                                            const Region& region, double exaggeration,
                                            const std::string& where);

}  // namespace oro
