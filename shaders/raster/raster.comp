#version 460
// Draws a meshlet by compute: places its 81 posts, then one triangle an invocation. Triangles of some size, and those that must be
// clipped, are handed on.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/choose/lists.glsl"
#include "shaders/raster/raster.glsl"
#include "shaders/raster/draw_alone.glsl"

layout(local_size_x = 128) in;  // a triangle an invocation
#include "shaders/raster/list_large.glsl"

shared vec4 posts[meshlet_vertices];  // clip coordinates; w = 0 where void
shared uint places[meshlet_vertices];  // row << 8 | column in the page, after stitching
shared uint drawn_count;

uint post_number(uvec2 post) { return post.x * meshlet_posts + post.y; }

// False for a triangle that is not drawn: with a void corner, that stitching has left without an area, or cut.
bool corners(uint frame_page, uint meshlet, uint triangle, uint edges, out vec4 a, out vec4 b, out vec4 c) {
    uvec2 pa, pb, pc;
    triangle_posts(frame_pages().at[frame_page], meshlet, triangle, edges, pa, pb, pc);
    a = posts[post_number(pa)];
    b = posts[post_number(pb)];
    c = posts[post_number(pc)];
    uint at_a = places[post_number(pa)], at_b = places[post_number(pb)], at_c = places[post_number(pc)];
    return a.w != 0.0 && b.w != 0.0 && c.w != 0.0 && has_area(at_a, at_b, at_c) && !is_cut(frame_page, at_a, at_b, at_c);
}

// What becomes of an invocation's triangle.
uint kind_of_triangle(uint frame_page, uint meshlet, uint triangle, uint edges, out ScreenTriangle t) {
    vec4 a, b, c;
    if (!corners(frame_page, meshlet, triangle, edges, a, b, c)) return shows_nowhere;
    atomicAdd(drawn_count, 1u);
    if (max(a.w, max(b.w, c.w)) < FRAME.near_m) return shows_nowhere;
    uint id = triangle_id(frame_page, meshlet, triangle);
    if (!fits_grid(a, b, c)) {
        list_clip(id);
        return shows_nowhere;
    }
    return screen_triangle(a, b, c, id, t) ? kind_of(t) : shows_nowhere;
}

void main() {
    uint number = folded(gl_WorkGroupID);
    if (number >= lists().at.meshlets) return;
    uint listed = Words(FRAME.meshlet_list).at[number];
    uint frame_page = (listed & 0xfffffffu) / meshlets_per_page, meshlet = listed % meshlets_per_page;
    uint lane = gl_LocalInvocationIndex;
    if (lane == 0u) drawn_count = 0u;
    begin_listing();
    if (lane < meshlet_vertices) {
        FramePage page = frame_pages().at[frame_page];
        PageBlocks block = PageBlocks(page.block);
        uvec2 post = vertex_post(page, meshlet, uvec2(lane / meshlet_posts, lane % meshlet_posts), listed >> 28);
        int height = post_height(block, post);
        bool there = height != void_height;
        places[lane] = post.x << 8 | post.y;
        posts[lane] = there ? project(place_in_view(page, post, height)) : vec4(0.0);
        // A post exactly beside the eye has w = 0, too: moved by less than any float at its distance shows.
        if (there && posts[lane].w == 0.0) posts[lane].w = -1.0e-30;
    }
    barrier();
    ScreenTriangle t;
    ToList noted = note_triangle(kind_of_triangle(frame_page, meshlet, lane, listed >> 28, t), t);
    barrier();
    if (lane == 0u) atomicAdd(Counts(FRAME.counts).at.triangles_drawn, drawn_count);
    draw_rest(noted, list_noted(noted, t), t);
}
