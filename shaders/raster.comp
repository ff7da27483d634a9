#version 460
// Draws a meshlet by compute: places its 81 posts, then one triangle an invocation. Triangles of some size are drawn by the whole
// workgroup; larger ones, and those that must be clipped, are handed on.
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "select.glsl"
#include "place.glsl"
#include "lists.glsl"
#include "raster.glsl"

layout(local_size_x = 128) in;  // a triangle an invocation

const int alone_max_px = 8;  // sides of the largest box that one invocation draws by itself

shared vec4 posts[meshlet_vertices];  // clip coordinates; w = 0 where void
shared uint shared_count;
shared uint shared_triangles[meshlet_triangles];
shared uint drawn_count;

uint post_number(uvec2 post) { return post.x * meshlet_posts + post.y; }

void corners(uint triangle, out vec4 a, out vec4 b, out vec4 c) {
    uvec2 pa, pb, pc;
    triangle_posts(triangle, pa, pb, pc);
    a = posts[post_number(pa)];
    b = posts[post_number(pb)];
    c = posts[post_number(pc)];
}

bool fits_near(ScreenTriangle t) {
    ivec2 size = max(t.a, max(t.b, t.c)) - min(t.a, min(t.b, t.c));
    return max(size.x, size.y) <= int(large_square_px) * subpixels;
}

void list_clip(uint id) {
    uint at = atomicAdd(lists().at.clips, 1u);
    if (at >= clips_max) {
        atomicAdd(Counts(FRAME.counts).at.triangles_not_clipped, 1u);
        return;
    }
    Words(FRAME.clip_list).at[at] = id;
    uint groups = at / 64u + 1u;
    atomicMax(lists().at.clip_groups[0], min(groups, groups_per_row));
    atomicMax(lists().at.clip_groups[1], (groups + groups_per_row - 1u) / groups_per_row);
}

// What one invocation does with its triangle.
void draw_triangle(uint frame_page, uint meshlet, uint triangle) {
    vec4 a, b, c;
    corners(triangle, a, b, c);
    if (a.w == 0.0 || b.w == 0.0 || c.w == 0.0) return;
    atomicAdd(drawn_count, 1u);
    if (max(a.w, max(b.w, c.w)) < FRAME.near_m) return;
    uint id = triangle_id(frame_page, meshlet, triangle);
    if (!fits_grid(a, b, c)) {
        list_clip(id);
        return;
    }
    ScreenTriangle t;
    if (!screen_triangle(a, b, c, id, t)) return;
    ivec4 box = pixel_box(t);
    ivec2 size = box.zw - box.xy + 1;
    if (min(size.x, size.y) <= 0) return;
    if (!fits_near(t)) {
        if (!list_large(t, box)) draw_far(t, box, 0u, 1u);
    } else if (max(size.x, size.y) <= alone_max_px) {
        draw_near(t, box, 0u, 1u);
    } else {
        shared_triangles[atomicAdd(shared_count, 1u)] = triangle;
    }
}

void main() {
    uint number = folded_group();
    if (number >= lists().at.meshlets) return;
    uint listed = Words(FRAME.meshlet_list).at[number];
    uint frame_page = listed / meshlets_per_page, meshlet = listed % meshlets_per_page;
    uint lane = gl_LocalInvocationIndex;
    if (lane == 0u) {
        shared_count = 0u;
        drawn_count = 0u;
    }
    if (lane < meshlet_vertices) {
        FramePage page = frame_pages().at[frame_page];
        PageBlocks block = PageBlocks(page.block);
        uvec2 post = uvec2(meshlet / meshlets_per_side, meshlet % meshlets_per_side) * meshlet_quads +
                     uvec2(lane / meshlet_posts, lane % meshlet_posts);
        float dh = post_dh(block, post.x, post.y);
        posts[lane] = is_void(dh) ? vec4(0.0) : project(place_in_view(block, page, post.x, post.y, dh));
        // A post exactly beside the eye has w = 0, too: moved by less than any float at its distance shows.
        if (!is_void(dh) && posts[lane].w == 0.0) posts[lane].w = -1.0e-30;
    }
    barrier();
    draw_triangle(frame_page, meshlet, lane);
    barrier();
    for (uint i = 0u; i < shared_count; ++i) {
        uint triangle = shared_triangles[i];
        vec4 a, b, c;
        corners(triangle, a, b, c);
        ScreenTriangle t;
        screen_triangle(a, b, c, triangle_id(frame_page, meshlet, triangle), t);
        draw_near(t, pixel_box(t), lane, 128u);
    }
    if (lane == 0u) atomicAdd(Counts(FRAME.counts).at.triangles_drawn, drawn_count);
}
