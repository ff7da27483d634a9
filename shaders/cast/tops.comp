#version 460
// How high each node of the pages that cast shadows reaches: its posts, and what it stands for at most so much above them.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/cast/casters.glsl"

layout(local_size_x = 64) in;

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(uint place, float top_m, float error_m) {
    CasterNodes(CASTERS.nodes).at[place].top_m = top_m;
    CasterNodes(CASTERS.nodes).at[place].error_m = error_m;
}

void main() {
    uint group = folded(gl_WorkGroupID), page = group / 4u, node = group % 4u * 64u + gl_LocalInvocationID.x;
    if (page >= CASTERS.page_count) return;
    PageBlocks block = PageBlocks(CasterPages(CASTERS.pages).at[page].block);
    uvec2 first = first_post(node);
    int highest = void_height;
    for (uint row = 0u; row < meshlet_posts; ++row)
        for (uint column = 0u; column < meshlet_posts; ++column) highest = max(highest, post_height(block, first + uvec2(row, column)));
    float error_m = block.at[0].meshlets[node].error_m;
    float top_m = error_m >= unfit_error_m ? 1.0e9 : highest == void_height ? -1.0e9 : float(highest) * height_step_m + error_m + 0.01;
    keep(page * meshlets_per_page + node, top_m, error_m);
}
