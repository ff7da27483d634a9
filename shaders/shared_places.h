// What casts shadows in a frame of several grids, on each other's ground, as both sides know it.
#ifndef OROGRAPH_SHADERS_SHARED_PLACES_H
#define OROGRAPH_SHADERS_SHARED_PLACES_H
#include "shaders/shared.h"

#ifdef __cplusplus
namespace oro::gpu {
#endif

// What FrameConstants.casters points at.
struct FrameCasters {
    Casters own;         // the grid's
    uvec2 shown_shares;  // float for each pixel, row by row: what it sees of the sun past all grids of the
                         // frame. Of a single grid own.sun_shares
    uvec2 places;        // CastPlace for each pixel, row by row; 0 in a frame of one grid
};
// Where the ground in a pixel is, whatever grid it is of.
struct CastPlace {
    vec2 from_eye_rad;  // latitude and longitude less the eye's
    float h_m;          // above the ellipsoid, as drawn
    float distance_m;   // from the eye
};

#ifdef __cplusplus
}  // namespace oro::gpu
#endif
#endif
