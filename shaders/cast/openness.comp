#version 460
// How much of the sky the ground sees, of 1, at the corners of the nodes of each page that is drawn: horizon angles in 16 directions, from
// the posts of ever coarser levels the farther away they are. The light of an even sky on level ground; the ground's own slope is not
// reckoned in. Source: I. Zakšek, K. Oštir, Ž. Kokalj, Sky-view factor as a relief visualization technique, Remote Sensing 3(2), 2011,
// with the light weighted by the cosine.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/cast/casters.glsl"

layout(local_size_x = 64) in;

const uint directions = 16u;
const uint rings = 8u;  // 2, 4, 8, 16, ... posts away
const float mean_earth_radius_m = 6371000.0;

// From where the sky is looked for.
struct OpenPlace {
    ivec2 post;   // of the region
    int height;
    uint level;
    vec2 post_m;  // from one of the region's posts to the next: south, east
};

// Height of the nearest post of a level to a place, steps; void_height where there is none.
int caster_height(inout uint level, vec2 place, out ivec2 post) {
    ivec2 last = ivec2(FRAME.last_row, FRAME.last_column);
    for (; level < CASTERS.level_count; ++level) {
        post = ivec2(round(place / float(1u << level))) << level;
        if (any(lessThan(post, ivec2(0))) || any(greaterThan(post, last))) return void_height;
        uint page = caster_page(level, post);
        if (page == no_page) continue;
        uvec2 within = uvec2(post) >> level & 127u;
        PageBlocks block = PageBlocks(CasterPages(CASTERS.pages).at[page].block);
        return post_height(block, within);
    }
    return void_height;
}

// The tangent of the horizon's angle in a direction (south, east), 0 where it is level or lower.
float horizon_tangent(OpenPlace at, vec2 direction) {
    float highest = 0.0;
    float row_m = at.post_m.x * float(1u << at.level);
    for (uint ring = 0u; ring < rings; ++ring) {
        float away_m = row_m * float(2u << ring);
        uint level = min(at.level + uint(max(int(ring) - 2, 0)), CASTERS.level_count - 1u);
        ivec2 post;
        int height = caster_height(level, vec2(at.post) + direction * away_m / at.post_m, post);
        vec2 to_m = vec2(post - at.post) * at.post_m;
        float squared = dot(to_m, to_m);
        if (height == void_height || squared <= 0.0) continue;
        float rise_m = float(height - at.height) * height_step_m - squared / (2.0 * mean_earth_radius_m);
        highest = max(highest, rise_m * inversesqrt(squared));
    }
    return highest;
}

float openness(OpenPlace at) {
    float open = 0.0;
    for (uint i = 0u; i < directions; ++i) {
        float angle = 6.2831853 * float(i) / float(directions);
        float tangent = horizon_tangent(at, vec2(-cos(angle), sin(angle)));
        open += 1.0 / (1.0 + tangent * tangent);
    }
    return open / float(directions);
}

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(uint place, float open) { CasterShares(CASTERS.openness).at[place] = open; }

void main() {
    uint group = folded(gl_WorkGroupID), number = group / open_groups_a_page;
    uint corner = group % open_groups_a_page * 64u + gl_LocalInvocationID.x;
    if (number >= FRAME.page_count || corner >= open_corners * open_corners) return;
    FramePage page = frame_pages().at[number];
    PageBlocks block = PageBlocks(page.block);
    uvec2 within = uvec2(corner / open_corners, corner % open_corners) * meshlet_quads;
    OpenPlace at;
    at.post = ivec2(uvec2(page.first_row, page.first_column) + (within << page.level));
    at.height = post_height(block, within);
    at.level = page.level;
    at.post_m = vec2(block.at[0].row_spacing_m, max(abs(RowTable(FRAME.row_terms).at[page.row_terms + within.x].cosine) * block.at[0].column_spacing_m, 1.0e-3));
    bool beyond = at.post.x > int(FRAME.last_row) || at.post.y > int(FRAME.last_column);
    keep(number * open_corners * open_corners + corner, beyond || at.height == void_height ? 1.0 : openness(at));
}
