#version 460
// Draws a cluster by compute, as raster.comp draws a meshlet: places its vertices, then one triangle an invocation.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/raster/raster.glsl"
#include "shaders/raster/draw_alone.glsl"
#include "shaders/clusters/cluster.glsl"

layout(local_size_x = 128) in;  // cluster_triangles, cluster_vertices

shared vec4 vertices[cluster_vertices];  // clip coordinates

void main() {
    uint number = folded(gl_WorkGroupID);
    if (number >= FRAME.clusters.count) return;
    DrawnCluster drawn = drawn_cluster(number);
    ClusterBlocks block = ClusterBlocks(drawn.block);
    uint lane = gl_LocalInvocationIndex, triangles = triangles_of_cluster(drawn);
    if (lane < vertices_of_cluster(drawn)) {
        vertices[lane] = project(vertex_in_view(block.at.vertices[lane]));
        // A post exactly beside the eye has w = 0: moved by less than any float at its distance shows.
        if (vertices[lane].w == 0.0) vertices[lane].w = -1.0e-30;
    }
    barrier();
    if (lane < triangles) {
        uvec3 at = corners_in_cluster(block, lane);
        draw_corners(vertices[at.x], vertices[at.y], vertices[at.z], number * cluster_triangles + lane + 1u);
    }
    if (lane != 0u) return;
    atomicAdd(Counts(FRAME.counts).at.triangles_drawn, triangles);
    atomicAdd(Counts(FRAME.counts).at.meshlets_drawn, 1u);
}
