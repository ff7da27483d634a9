#version 460
// Writes the triangle's id as terrain.frag does, and counts the triangles that cover each pixel, those behind others, too.
#extension GL_EXT_mesh_shader : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"

layout(location = 0) perprimitiveEXT flat in uint in_id;
layout(location = 0) out uint out_id;

void main() {
    atomicAdd(Words(FRAME.overdraw).at[uint(gl_FragCoord.y) * FRAME.width_px + uint(gl_FragCoord.x)], 1u);
    out_id = in_id;
}
