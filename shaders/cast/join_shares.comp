#version 460
// What each pixel sees of the sun past the terrain of all grids of a frame: the least that one of them leaves. Each has its turn.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/cast/casters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(uint pixel) {
    CasterShares shown = CasterShares(CasterList(FRAME.casters).at.shown_shares);
    shown.at[pixel] = min(shown.at[pixel], CasterShares(CASTERS.sun_shares).at[pixel]);
}

void main() {
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x < FRAME.width_px && pixel.y < FRAME.height_px) keep(pixel.y * FRAME.width_px + pixel.x);
}
