#version 460
// Chooses each patch's level: an invocation each.
#extension GL_GOOGLE_include_directive : require
#include "shaders/patches/patch.glsl"

layout(local_size_x = 64) in;  // patches_per_choice

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number >= frame.patches * frame.patches) return;
    uvec2 patch_at = uvec2(number % frame.patches, number / frame.patches);
    PatchLevels(frame.levels).at[number] = frame.level == patch_by_distance ? level_by_distance(patch_at) : frame.level;
}
