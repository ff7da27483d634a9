#version 460
// Places the clumps of a field, once: one invocation a clump.
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/grass.glsl"

layout(local_size_x = 128) in;  // clumps_per_cull

void main() {
    uint number = gl_GlobalInvocationID.x;
    if (number < grass.field.clumps) GrassClumps(grass.clumps).at[number] = clump_at(grass.field, number);
}
