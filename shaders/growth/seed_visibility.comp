#version 460
// Mesh path: the ids and depths of its images into a visibility buffer, for trees to be drawn into.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "shaders/place/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(binding = 4) uniform texture2D depths;
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Seeded { uvec2 at[]; };

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(ivec2 pixel, uint id, float depth) {
    Seeded(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)] = id == 0u ? uvec2(0u) : uvec2(~id, floatBitsToUint(depth));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    keep(pixel, imageLoad(ids, pixel).x, texelFetch(depths, pixel, 0).x);
}
