#version 460
// Of triangles as near as what a pixel shows: those with a lower id than it had before this round take it over. They come highest id
// first, so that the lowest stays.
#extension GL_EXT_mesh_shader : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer Before { uint at[]; };
layout(location = 0) perprimitiveEXT flat in uint in_id;
layout(location = 0) out uint out_id;

void main() {
    uint before = Before(FRAME.ids_before).at[uint(gl_FragCoord.y) * FRAME.width_px + uint(gl_FragCoord.x)];
    if (in_id >= before) discard;
    out_id = in_id;
}
