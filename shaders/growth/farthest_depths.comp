#version 460
// The farthest depth of the ground in each block of 8 x 8 pixels of the visibility buffer: what is behind it there is hidden.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/growth/growth_table.glsl"

layout(local_size_x = 8, local_size_y = 8) in;  // depth_block_px

layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer FarthestDepths { float at[]; };
shared uint farthest;

void main() {
    if (gl_LocalInvocationIndex == 0u) farthest = 0xffffffffu;
    barrier();
    uvec2 pixel = gl_GlobalInvocationID.xy;
    if (pixel.x < FRAME.width_px && pixel.y < FRAME.height_px) {
        uvec2 word = VisibilityWords(FRAME.visibility).at[pixel.y * FRAME.width_px + pixel.x];
        // Depths are not negative, and their bits are in their order.
        atomicMin(farthest, id_of(word) == 0u ? 0u : word.y);
    }
    barrier();
    if (gl_LocalInvocationIndex == 0u)
        FarthestDepths(GROWTH.farthest).at[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = uintBitsToFloat(farthest);
}
