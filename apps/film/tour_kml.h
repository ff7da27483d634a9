// A camera's path as a tour of KML.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/film/camera_path.h"

namespace oro {

// The keys as the stops of a gx:Tour, which globes play, and read_kml_tour() reads. Degrees to 1e-9, metres
// to 1e-6, seconds to 1e-6; the first key is reached in no time. KML counts altitudes from sea level: N_m
// gives the geoid's undulation at a place. A tour has no angle of view. Source: OGC KML 2.3 (12-007r2),
// AbstractTourPrimitive; Google's KML reference, gx:Tour.
std::string keys_to_kml(const std::vector<CameraKey>& keys, const std::string& name,
                        const std::function<double(double lat_deg, double lon_deg)>& N_m);

}  // namespace oro
