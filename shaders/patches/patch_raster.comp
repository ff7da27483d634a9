#version 460
// The compute way: a workgroup a patch, a square an invocation, into the visibility buffer. Triangles that reach beyond the near plane or
// far beside the picture are left out: the eye is far from its ground here.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/patches/patch.glsl"

// What shaders/raster/raster.glsl asks of a frame; it has no lists here.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Words { uint at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer LargeTriangles { LargeTriangle at[]; };
struct RasterFrame {
    uint width_px;
    uint height_px;
    float near_m;
    uvec2 visibility;
    uvec2 overdraw;
    uvec2 large_list;
};
RasterFrame raster_frame;
#define FRAME raster_frame
#include "shaders/raster/raster.glsl"

layout(local_size_x = 64) in;  // patch_group_size

shared vec4 clip_of[patch_vertices_most];

void main() {
    raster_frame = RasterFrame(frame.size_px & 0xffffu, frame.size_px >> 16, patch_near_m, frame.visibility, uvec2(0u), uvec2(0u));
    uvec2 patch_at = gl_WorkGroupID.xy;
    PatchSteps steps = steps_of(patch_at);
    uint squares = squares_of(steps), vertices = (squares + 1u) * (squares + 1u);
    for (uint v = gl_LocalInvocationIndex; v < vertices; v += patch_group_size) clip_of[v] = patch_clip(patch_vertex(patch_at, steps, v));
    barrier();
    if (gl_LocalInvocationIndex >= squares * squares) return;
    [[dont_unroll]] for (uint i = 0u; i < 2u; ++i) {
        uint triangle = 2u * gl_LocalInvocationIndex + i;
        uvec3 corners = patch_triangle(squares, triangle);
        ScreenTriangle t;
        vec4 a = clip_of[corners.x], b = clip_of[corners.y], c = clip_of[corners.z];
        if (!fits_grid(a, b, c) || !screen_triangle(a, b, c, patch_id(patch_at, triangle), t)) continue;
        ivec4 box = pixel_box(t);
        if (box.x <= box.z && box.y <= box.w) draw_all(t, box);
    }
}
