#version 460
// The compute way: draws a blade an invocation into the visibility buffer, step by step along it. Triangles that reach beyond the near plane
// or far beside the picture are left out: the eye is high above its grass here.
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/grass.glsl"

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

layout(local_size_x = 256) in;  // clumps_per_raster * blades_per_clump

void draw_triangle(vec4 a, vec4 b, vec4 c, uint id) {
    ScreenTriangle t;
    if (!fits_grid(a, b, c) || !screen_triangle(a, b, c, id, t)) return;
    ivec4 box = pixel_box(t);
    if (box.x <= box.z && box.y <= box.w) draw_all(t, box);
}

void main() {
    raster_frame = RasterFrame(width_px(), height_px(), grass_near_m, grass.visibility, uvec2(0u), uvec2(0u));
    uint at = gl_GlobalInvocationID.x / blades_per_clump, blade = gl_GlobalInvocationID.x % blades_per_clump;
    if (at >= listed_clumps(0u) + listed_clumps(1u)) return;
    uint number = clump_of_both(at), id = blade_id(number, blade);
    GrassClump clump = clump_numbered(number);
    GrassBlade shape = blade_of_clump(clump, blade);
    uint vertices = vertices_of_clump(clump);
    vec4 left = grass_clip(grass.view, blade_vertex(shape, 0u, vertices)), right = grass_clip(grass.view, blade_vertex(shape, 1u, vertices));
    [[dont_unroll]] for (uint i = 2u; i < vertices; i += 2u) {
        vec4 next_left = grass_clip(grass.view, blade_vertex(shape, i, vertices));
        vec4 next_right = grass_clip(grass.view, blade_vertex(shape, i + 1u, vertices));
        draw_triangle(left, right, next_left, id);
        // At the tip both are one place.
        if (i + 2u < vertices) draw_triangle(right, next_left, next_right, id);
        left = next_left;
        right = next_right;
    }
}
