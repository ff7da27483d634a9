#version 460
// Mesh path: the ids of a visibility buffer, once trees are drawn into it, back into the image.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32ui) uniform writeonly uimage2D ids;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    imageStore(ids, pixel, uvec4(id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])));
}
