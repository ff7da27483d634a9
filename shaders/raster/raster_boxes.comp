#version 460
// Triangles of middling size, one a team of invocations.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/raster/raster.glsl"

const uint team = 32u;
layout(local_size_x = 128) in;  // boxes_per_group teams

void main() {
    uint number = folded(gl_WorkGroupID) * boxes_per_group + gl_LocalInvocationIndex / team;
    if (number >= min(lists().at.boxes, boxes_room)) return;
    ScreenTriangle t = large_triangle(large_max + number);
    draw_near(t, pixel_box(t), gl_LocalInvocationIndex % team, team);
}
