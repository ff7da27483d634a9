#version 460
// The pyramid of the farthest depths: one workgroup for 64 x 64 pixels, one invocation for 4 x 4 of them. Reversed depths: the farthest
// is the least, and the background 0.
#extension GL_GOOGLE_include_directive : require
#ifdef FROM_IMAGES
#extension GL_EXT_samplerless_texture_functions : require
#endif
#include "shaders/place/frame.glsl"
#include "shaders/place/bend.glsl"
#include "shaders/choose/occlusion.glsl"

layout(local_size_x = 16, local_size_y = 16) in;
layout(push_constant, scalar) uniform Round { FrameRound round; };
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Pyramid { float at[]; };
#ifdef FROM_IMAGES
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(binding = 4) uniform texture2D depth;
#endif

shared float farthest[16][16];

float further(float a, float b) { return round.nearest != 0u ? max(a, b) : min(a, b); }

// Of one pixel; keeps its id for terrain_ties.frag.
float depth_of(ivec2 pixel) {
#ifdef FROM_IMAGES
    Words(FRAME.ids_before).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)] = imageLoad(ids, pixel).x;
    return texelFetch(depth, pixel, 0).x;
#else
    return uintBitsToFloat(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)].y);
#endif
}

void write_value(uint level, uvec2 square, float value) {
    uvec2 size = pyramid_size(level);
    if (square.x < size.x && square.y < size.y) Pyramid(FRAME.pyramid).at[pyramid_first(level) + square.y * size.x + square.x] = value;
}

void main() {
    uvec2 lane = gl_LocalInvocationID.xy, square = gl_WorkGroupID.xy * 16u + lane;
    // Beyond the picture its last pixel once more: it is in every larger square that reaches there.
    uvec2 last = uvec2(FRAME.width_px, FRAME.height_px) - 1u;
    float value = depth_of(ivec2(min(square * 4u, last)));
    for (uint i = 1u; i < 16u; ++i) value = further(value, depth_of(ivec2(min(square * 4u + uvec2(i & 3u, i >> 2u), last))));
    write_value(pyramid_finest, square, value);
    for (uint level = pyramid_finest + 1u; level <= pyramid_coarsest; ++level) {
        farthest[lane.y][lane.x] = value;
        barrier();
        uint side = 16u >> (level - pyramid_finest);
        bool takes = lane.x < side && lane.y < side;
        if (takes) {
            uvec2 at = lane * 2u;
            value = further(further(farthest[at.y][at.x], farthest[at.y][at.x + 1u]), further(farthest[at.y + 1u][at.x], farthest[at.y + 1u][at.x + 1u]));
            write_value(level, gl_WorkGroupID.xy * side + lane, value);
        }
        barrier();
    }
}
