#version 460
// How high each node of the pages that cast shadows reaches: its posts, and what it stands for at most so much above them.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/cast/casters.glsl"

layout(local_size_x = 64) in;

float top_of(PageBlocks block, uint node) {
    uvec2 first = first_post(node);
    int highest = void_height;
    for (uint row = 0u; row < meshlet_posts; ++row)
        for (uint column = 0u; column < meshlet_posts; ++column) highest = max(highest, post_height(block, first + uvec2(row, column)));
    float error_m = block.at[0].meshlets[node].error_m;
    return error_m >= unfit_error_m ? 1.0e9 : highest == void_height ? -1.0e9 : float(highest) * height_step_m + error_m + 0.01;
}

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(uint place, CasterNode node) { CasterNodes(CASTERS.nodes).at[place] = node; }

void main() {
    uint group = folded(gl_WorkGroupID), number = group / 4u, within = group % 4u * 64u + gl_LocalInvocationID.x;
    if (number >= CASTERS.page_count) return;
    CasterPage page = CasterPages(CASTERS.pages).at[number];
    ivec2 post = ivec2(uvec2(page.row, page.column) * page_quads + first_post(within)) << page.level;
    CasterNode node;
    node.block = page.block;
    node.top_m = top_of(PageBlocks(page.block), within);
    node.error_m = PageBlocks(page.block).at[0].meshlets[within].error_m;
    node.above_top_m = node.above_error_m = no_node_m;
    uint above = page.level + 1u < CASTERS.level_count ? caster_page(page.level + 1u, post) : no_page;
    if (above != no_page) {
        PageBlocks block = PageBlocks(CasterPages(CASTERS.pages).at[above].block);
        uint there = caster_node(0u, page.level + 1u, post);
        node.above_top_m = top_of(block, there);
        node.above_error_m = block.at[0].meshlets[there].error_m;
    }
    node.finer = page.level > 0u && caster_page(page.level - 1u, post) != no_page ? 1u : 0u;
    keep(number * meshlets_per_page + within, node);
}
