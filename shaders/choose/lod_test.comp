#version 460
// First step of a frame: one workgroup a page, one invocation a node. Which nodes may stand for all that they cover, and which
// pages have a node that is drawn: one that may while its parent may not.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/bend.glsl"

layout(local_size_x = 256) in;

shared uint accepted_here[accepted_words];
shared uint live;

// A node of a page, and for a quarter that has nothing finer, whatever there is.
bool acceptable(FramePage page, uvec2 node) {
    MeshletBounds bounds = PageBlocks(page.block).at[0].meshlets[node.x * meshlets_per_side + node.y];
    uint quarter = node.x / (meshlets_per_side / 2u) * 2u + node.y / (meshlets_per_side / 2u);
    if ((page.fallback_quarters >> quarter & 1u) != 0u) return bounds.radius >= 0.0;
    if ((page.cull & never_coarsen) != 0u) return false;
    precise vec3 centre_view = page.view_from_page * bounds.centre + page.origin_view;
    if (FRAME.refraction_per_m != 0.0) bend_node(bounds, centre_view);
    return node_acceptable(page.level, bounds, centre_view, FRAME.pixels_per_tangent, FRAME.corner_tangent, FRAME.tau_px);
}

void main() {
    uint page_number = folded(gl_WorkGroupID);
    if (page_number >= FRAME.page_count) return;
    uint lane = gl_LocalInvocationIndex;
    if (lane < accepted_words) accepted_here[lane] = 0u;
    if (lane == 0u) live = 0u;
    barrier();
    FramePage page = frame_pages().at[page_number];
    uvec2 node = uvec2(lane / meshlets_per_side, lane % meshlets_per_side);
    if (acceptable(page, node)) {
        atomicOr(accepted_here[lane / 32u], 1u << (lane % 32u));
        uvec2 above = node / 2u + uvec2(page.quarter / 2u, page.quarter % 2u) * (meshlets_per_side / 2u);
        if (page.parent == no_page || !acceptable(frame_pages().at[page.parent], above)) atomicOr(live, 1u);
    }
    barrier();
    if (lane < accepted_words) Words(FRAME.accepted).at[page_number * accepted_words + lane] = accepted_here[lane];
    if (lane == 0u) Words(FRAME.live).at[page_number] = live;
}
