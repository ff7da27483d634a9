#version 460
// Draws a listed cluster by compute, as raster.comp draws a meshlet: places its vertices, then one triangle an invocation.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/raster/raster.glsl"
#include "shaders/raster/draw_alone.glsl"
#include "shaders/clusters/cluster.glsl"

layout(local_size_x = 128) in;  // cluster_triangles, cluster_vertices
#include "shaders/raster/list_large.glsl"

shared vec4 vertices[cluster_vertices];  // clip coordinates

// What becomes of an invocation's triangle.
uint kind_of_triangle(vec4 a, vec4 b, vec4 c, uint id, out ScreenTriangle t) {
    if (max(a.w, max(b.w, c.w)) < FRAME.near_m) return shows_nowhere;
    if (!fits_grid(a, b, c)) {
        list_clip(id);
        return shows_nowhere;
    }
    return screen_triangle(a, b, c, id, t) ? kind_of(t) : shows_nowhere;
}

void main() {
    uint listed = folded(gl_WorkGroupID);
    if (listed >= lists().at.meshlets) return;
    uint number = Words(FRAME.meshlet_list).at[listed];
    DrawnCluster drawn = drawn_cluster(number);
    ClusterBlocks block = ClusterBlocks(drawn.block);
    uint lane = gl_LocalInvocationIndex, triangles = triangles_of_cluster(drawn);
    begin_listing();
    if (lane < vertices_of_cluster(drawn)) {
        vertices[lane] = project(vertex_in_view(block.at.vertices[lane]));
        // A post exactly beside the eye has w = 0: moved by less than any float at its distance shows.
        if (vertices[lane].w == 0.0) vertices[lane].w = -1.0e-30;
    }
    barrier();
    ScreenTriangle t;
    uint kind = shows_nowhere;
    if (lane < triangles) {
        uvec3 at = corners_in_cluster(block, lane);
        kind = kind_of_triangle(vertices[at.x], vertices[at.y], vertices[at.z], number * cluster_triangles + lane + 1u, t);
    }
    ToList noted = note_triangle(kind, t);
    barrier();
    draw_rest(noted, list_noted(noted, t), t);
    if (lane != 0u) return;
    atomicAdd(Counts(FRAME.counts).at.triangles_drawn, triangles);
    atomicAdd(Counts(FRAME.counts).at.meshlets_drawn, 1u);
}
