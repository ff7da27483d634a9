// Which elevations a panorama shows where nobody says: the skyline with sky above it, and ground below.
#pragma once

#include <vector>

#include "core/truth/oracle.h"
#include "core/truth/true_surface.h"

namespace oro {

// Where sight lines of an azimuth pass all ground, in degrees: by bisection between straight up and straight
// down, to 0.01 degree. Straight down where there is no ground at all.
double skyline_deg(const Oracle& oracle, const Geodetic& eye, double azimuth_deg, double reach_m);

struct Elevations {
    double low_deg{};
    double high_deg{};
    double skyline_deg{};  // its highest place; higher than `high_deg` where ground near by is left out
};
// What nobody asked for is not shown: ground beside the eye would make the picture as high as it is wide.
inline constexpr double most_unasked_deg = 35.0;
// Within -35 .. 35. `from_deg`, `sweep_deg`: as PanoramaFrame has them.
Elevations elevations_for(const TrueSurface& surface, const Geodetic& eye, const WorldModel& model,
                          double from_deg, double sweep_deg, int threads);

}  // namespace oro
