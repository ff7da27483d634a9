// How high the ground is.
#pragma once

#include <optional>

#include "core/terrain/post_grid.h"

namespace oro {

// Height of the exaggerated surface above the ellipsoid at a place, as TrueSurface has it; nothing where
// there is no data (or none that can be read: field.health() tells). For a question or two: asks for the
// field's posts one by one.
std::optional<double> ground_h_m(const HeightField& field, double lat_deg, double lon_deg,
                                 double exaggeration = 1.0);

}  // namespace oro
