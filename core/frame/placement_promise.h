// How near to its exact place every post is drawn: within 1 mm up to 4 km from the eye, and within 1 mm and
// 3.2e-7 of its distance beyond. Measured against GeographicLib (docs/PLACEMENT.md).
#pragma once

namespace oro {

inline constexpr double placement_near_m = 0.001;
inline constexpr double placement_near_reach_m = 4000.0;
inline constexpr double placement_far_share = 3.2e-7;  // of the distance, besides

// The most that a post at this distance is off, metres.
constexpr double placement_error_m(double distance_m) {
    return distance_m <= placement_near_reach_m ? placement_near_m
                                                : placement_near_m + placement_far_share * distance_m;
}

}  // namespace oro
