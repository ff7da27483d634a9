#version 460
// How high each node of the pages that cast shadows reaches: its posts, and what it stands for at most so much above them. And which are
// gentle: light comes down to them more steeply than any of their triangles rises.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/air/air.glsl"
#include "shaders/cast/casters.glsl"
#include "shaders/cast/shadow.glsl"

layout(local_size_x = 64) in;

// Of a node's posts: the highest, and how fast its triangles rise at most along a line (row, column: steps for a post of the level), steps.
struct NodePosts {
    int highest;
    float rise;
    bool has_voids;
};
NodePosts posts_of(PageBlocks block, uint node, vec2 along) {
    uvec2 first = first_post(node);
    NodePosts posts = NodePosts(void_height, -1.0e9, false);
    int above[meshlet_posts];
    for (uint row = 0u; row < meshlet_posts; ++row) {
        int before = 0;
        for (uint column = 0u; column < meshlet_posts; ++column) {
            int here = post_height(block, first + uvec2(row, column));
            posts.highest = max(posts.highest, here);
            posts.has_voids = posts.has_voids || here == void_height;
            if (row > 0u && column > 0u) {
                // Whichever way the cell is split.
                vec2 south = along.x * vec2(here - above[column], before - above[column - 1u]);
                vec2 east = along.y * vec2(here - before, above[column] - above[column - 1u]);
                posts.rise = max(posts.rise, max(south.x, south.y) + max(east.x, east.y));
            }
            if (column > 0u) above[column - 1u] = before;
            before = here;
        }
        above[meshlet_posts - 1u] = before;
    }
    return posts;
}

int highest_of(PageBlocks block, uint node) {
    uvec2 first = first_post(node);
    int highest = void_height;
    for (uint row = 0u; row < meshlet_posts; ++row)
        for (uint column = 0u; column < meshlet_posts; ++column) highest = max(highest, post_height(block, first + uvec2(row, column)));
    return highest;
}
float top_of(PageBlocks block, uint node, int highest) {
    float error_m = block.at[0].meshlets[node].error_m;
    return error_m >= unfit_error_m ? 1.0e9 : highest == void_height ? -1.0e9 : float(highest) * height_step_m + error_m + 0.01;
}

// Whether light comes down to a node more steeply than any of its triangles rises: then a line towards the sun that is above it where it
// comes in leaves it behind. With room for the sun's disc, and for how the sun's height differs over the node.
struct LightOn {
    vec2 per_m;   // posts of the level along a metre of it
    float rise;   // the most that ground may, metres on that
};
LightOn light_on(CasterPage page, ivec2 post) {
    float size_m = float(8 << page.level) * CASTERS.row_rad * 6371000.0;
    CastPoint point;
    point.latitude = turned_by(FRAME.eye_post.latitude, (FRAME.eye_post.post.x - float(post.x)) * CASTERS.row_rad);
    point.longitude = turned_by(vec2(1.0, 0.0), (float(post.y) - FRAME.eye_post.post.y) * CASTERS.column_rad);
    CastFrame at = cast_frame(point, 0.0);
    float level_sun = max(length(at.sun.xy), 0.02);
    return LightOn(begins_per_m(at).xy / float(1 << page.level), at.sun.z - (1.7 * sun_radius_rad + size_m / 3.0e6) / level_sun);
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
    LightOn light = light_on(page, post);
    NodePosts posts = posts_of(PageBlocks(page.block), within, light.per_m);
    node.top_m = top_of(PageBlocks(page.block), within, posts.highest);
    node.error_m = PageBlocks(page.block).at[0].meshlets[within].error_m;
    node.above_top_m = node.above_error_m = no_node_m;
    uint above = page.level + 1u < CASTERS.level_count ? caster_page(page.level + 1u, post) : no_page;
    if (above != no_page) {
        PageBlocks block = PageBlocks(CasterPages(CASTERS.pages).at[above].block);
        uint there = caster_node(0u, page.level + 1u, post);
        node.above_top_m = top_of(block, there, highest_of(block, there));
        node.above_error_m = block.at[0].meshlets[there].error_m;
    }
    bool has_finer = page.level > 0u && caster_page(page.level - 1u, post) != no_page;
    // Where the region ends cells are narrower; a net's directions differ.
    bool ends = any(greaterThan(post + (8 << page.level), ivec2(FRAME.last_row, FRAME.last_column)));
    bool is_gentle = !posts.has_voids && !ends && FRAME.has_net == 0u && posts.rise * height_step_m <= light.rise;
    node.flags = (has_finer ? node_has_finer : 0u) | (is_gentle ? node_is_gentle : 0u) | (posts.has_voids ? node_has_voids : 0u);
    keep(number * meshlets_per_page + within, node);
}
