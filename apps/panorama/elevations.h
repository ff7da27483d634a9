// Which elevations a panorama shows where nobody says: the skyline with sky above it, and ground below.
#pragma once

#include <vector>

#include "core/truth/oracle.h"
#include "core/truth/true_ground.h"

namespace oro {

// Where sight lines of an azimuth pass all ground, in degrees: by bisection between straight up and straight
// down, to 0.01 degree. Straight down where there is no ground at all.
double skyline_deg(const Oracle& oracle, const Geodetic& eye, double azimuth_deg, double reach_m);

struct Elevations {
    double low_deg{};
    double high_deg{};
    double skyline_deg{};    // its highest place, but for ground at the eye's feet
    bool leaves_out_near{};  // such ground stands higher than is shown
};
// Ground so near is at the eye's feet: beside a summit it would make the picture as high as it is wide.
inline constexpr double at_the_feet_m = 250.0;
// The highest and the lowest that is shown unasked.
inline constexpr double most_unasked_deg = 60.0;
// `from_deg`, `sweep_deg`: as PanoramaFrame has them.
Elevations elevations_for(const TrueGround& ground, const Geodetic& eye, const WorldModel& model,
                          double from_deg, double sweep_deg, int threads);

}  // namespace oro
