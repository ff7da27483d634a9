// What may lie in the shadow of another grid's terrain.
#pragma once

#include "core/earth/ellipsoid.h"

namespace oro {

// Ground of another grid that a frame shows: in a sphere, in ECEF.
struct ShadowReceiver {
    Ecef centre;
    double radius_m;
    double error_per_slope_m;  // what casts shadows there may be off, a metre of light's rise a metre
    double lowest_m;           // above the ellipsoid; no ground there is lower
};

}  // namespace oro
