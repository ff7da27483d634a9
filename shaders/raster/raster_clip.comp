#version 460
// Triangles that cross the near plane or leave the grid: cut to what is in front and on the grid, then handed on as large ones.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/raster/raster.glsl"
#include "shaders/raster/draw_alone.glsl"
#ifdef CLUSTERS
#include "shaders/clusters/cluster.glsl"
#endif

layout(local_size_x = 64) in;
#include "shaders/raster/list_large.glsl"

// Few triangles come here, and a driver takes twice as long to compile the copies of a loop as the loop: none is unrolled.
const int corners_max = 9;  // three, and one more for each of five planes, and one to spare

// Source: I. E. Sutherland, G. W. Hodgman, Reentrant polygon clipping, Communications of the ACM 17(1), 1974.
int clipped(inout vec4 corners[corners_max], int count, int plane) {
    vec4 kept[corners_max];
    int kept_count = 0;
    [[dont_unroll]] for (int i = 0; i < count; ++i) {
        vec4 here = corners[i], next = corners[(i + 1) % count];
        float at_here = side_of(plane, here), at_next = side_of(plane, next);
        if (at_here >= 0.0 && kept_count < corners_max) kept[kept_count++] = here;
        if ((at_here >= 0.0) != (at_next >= 0.0) && kept_count < corners_max) {
            // Always from the inside outwards, so that both triangles at an edge cut it at the same point; and an edge whose ends
            // fit the grid is never cut, so that a neighbour that is drawn as it is meets the same edge.
            vec4 inside = at_here >= 0.0 ? here : next, outside = at_here >= 0.0 ? next : here;
            float from = at_here >= 0.0 ? at_here : at_next, to = at_here >= 0.0 ? at_next : at_here;
            precise vec4 cut = inside + (outside - inside) * (from / (from - to));
            kept[kept_count++] = cut;
        }
    }
    corners = kept;
    return kept_count;
}

bool is_cut_by(int plane, vec4 corners[corners_max], int count) {
    bool inside = true;
    for (int i = 0; i < count; ++i) inside = inside && side_of(plane, corners[i]) >= 0.0;
    return !inside;
}

shared int most_corners;  // of the workgroup's triangles, cut

void main() {
    if (gl_LocalInvocationIndex == 0u) most_corners = 0;
    barrier();
    uint number = folded(gl_WorkGroupID) * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    // All of a workgroup go on to the end, where they list together what is large. Those beyond the last triangle go with the first, for
    // nothing.
    bool there = number < min(lists().at.clips, clips_room);
    uint id = Words(FRAME.clip_list).at[there ? number : 0u], own = triangle_of_id(id);
    vec4 corners[corners_max];
    // Not by functions: each would copy all corners.
#ifdef CLUSTERS
    ClusterBlocks block = ClusterBlocks(drawn_cluster(own / cluster_triangles).block);
    uvec3 at = corners_in_cluster(block, own % cluster_triangles);
    for (int i = 0; i < 3; ++i) corners[i] = project(vertex_in_view(block.at.vertices[at[i]]));
#else
    uint triangle = own % meshlet_triangles, meshlet = own / meshlet_triangles % meshlets_per_page;
    FramePage page = frame_pages().at[own / (meshlet_triangles * meshlets_per_page)];
    PageBlocks block = PageBlocks(page.block);
    uint edges = edges_of(own / meshlet_triangles);
    uvec2 posts[3];
    triangle_posts(page, meshlet, triangle, edges, posts[0], posts[1], posts[2]);
    for (int i = 0; i < 3; ++i) {
        uvec2 post = vertex_post(page, meshlet, posts[i], edges);
        corners[i] = project(place_in_view(page, post, post_height(block, post)));
    }
#endif
    int count = there ? 3 : 0;
    [[dont_unroll]] for (int plane = 0; plane < clip_planes && count >= 3; ++plane) {
        if (is_cut_by(plane, corners, count)) count = clipped(corners, count, plane);
    }
    atomicMax(most_corners, count);
    barrier();
    [[dont_unroll]] for (int i = 1; i + 1 < most_corners; ++i) {
        begin_listing();
        barrier();
        ScreenTriangle t;
        bool drawn = i + 1 < count && screen_triangle(corners[0], corners[i], corners[i + 1], id, t);
        ivec4 box = drawn ? pixel_box(t) : ivec4(0, 0, -1, -1);
        // Teams draw at the same time as these are cut, so all are listed square by square.
        ToList noted = note_triangle(box.z >= box.x && box.w >= box.y ? is_large : shows_nowhere, t);
        barrier();
        if (!list_noted(noted, t)) draw_all(t, box);
        barrier();
    }
}
