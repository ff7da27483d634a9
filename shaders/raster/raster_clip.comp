#version 460
// Triangles that cross the near plane or leave the grid: cut to what is in front and on the grid, then handed on as large ones.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/raster/raster.glsl"
#ifdef CLUSTERS
#include "shaders/clusters/cluster.glsl"
#endif

layout(local_size_x = 64) in;

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

void main() {
    uint number = folded(gl_WorkGroupID) * gl_WorkGroupSize.x + gl_LocalInvocationIndex;
    if (number >= min(lists().at.clips, clips_max)) return;
    uint id = Words(FRAME.clip_list).at[number], own = triangle_of_id(id);
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
    int count = 3;
    [[dont_unroll]] for (int plane = 0; plane < clip_planes && count >= 3; ++plane) count = clipped(corners, count, plane);
    [[dont_unroll]] for (int i = 1; i + 1 < count; ++i) {
        ScreenTriangle t;
        if (!screen_triangle(corners[0], corners[i], corners[i + 1], id, t)) continue;
        ivec4 box = pixel_box(t);
        if (box.z < box.x || box.w < box.y) continue;
        if (!list_large(t, box)) draw_far(t, box);
    }
}
