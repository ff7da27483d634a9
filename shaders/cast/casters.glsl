// The pages that cast shadows, as shaders reach them. Needs frame.glsl and place.glsl.
#include "shaders/shared_places.h"
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer CasterList { FrameCasters at; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer CasterPages { CasterPage at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer CasterNodes { CasterNode at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer CasterShares { float at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer CastPlaces { CastPlace at[]; };
#define CASTERS CasterList(FRAME.casters).at.own

const float no_sun_share = -1.0;  // of a pixel without ground
const float turned_share = -2.0;  // ... on a triangle that is turned away from the sun: none, but none was lost
// To the share of others are added so many of these as light falls on their triangle.
const float share_step = 2.0;
vec4 without_light(vec4 shares) { return shares - share_step * floor(max(shares, vec4(0.0)) / share_step); }

// The number of the page of a level that holds a post of the region, or no_page.
uint caster_page(uint level, ivec2 post) {
    CasterLevel held = CASTERS.levels[level];
    uvec2 page = uvec2(post) >> (level + 7u);
    uvec2 within = page - uvec2(held.first_row, held.first_column);
    if (within.x >= held.rows || within.y >= held.columns) return no_page;
    return Words(CASTERS.table).at[held.first + within.x * held.columns + within.y];
}

// The number of its node there, page * 256 + node.
uint caster_node(uint page, uint level, ivec2 post) {
    uvec2 node = uvec2(post) >> (level + 3u) & 15u;
    return page * meshlets_per_page + node.x * meshlets_per_side + node.y;
}

// A cell of a level: its north-west and south-east post by their numbers in the region, and the heights of its four, in steps.
struct CasterCell {
    ivec2 from;
    ivec2 to;
    ivec4 heights;  // north-west, north-east, south-west, south-east
    bool sw_ne;     // from its south-west to its north-east post
};
// All but which way it is split, for what looks at its posts alone.
CasterCell unsplit_caster_cell(PageBlocks block, uint level, ivec2 post) {
    uvec2 number = uvec2(post) >> level;
    CasterCell cell;
    cell.from = ivec2(number << level);
    cell.to = min(cell.from + (1 << level), ivec2(FRAME.last_row, FRAME.last_column));
    uvec2 place = (number & 127u) + 1u;
    [[unroll]] for (uint i = 0u; i < 4u; ++i) cell.heights[i] = stored_height(block, place + uvec2(i >> 1u, i & 1u));
    cell.sw_ne = false;
    return cell;
}
bool caster_sw_ne(PageBlocks block, uint level, ivec2 post) { return sw_ne_at(block, uvec2(post) >> level & 127u); }
CasterCell caster_cell(PageBlocks block, uint level, ivec2 post) {
    CasterCell cell = unsplit_caster_cell(block, level, post);
    cell.sw_ne = caster_sw_ne(block, level, post);
    return cell;
}

const float no_ground_m = -1.0e9;

// How far a place in a cell, of 1, is on the side of its western triangle.
float west_of_diagonal(CasterCell cell, vec2 share) { return cell.sw_ne ? 1.0 - share.x - share.y : share.x - share.y; }

// Metres above a height (in steps) of a cell's triangle at a place in it, of 1; no_ground_m where it has none.
float above_base(CasterCell cell, vec2 share, bool west, int base) {
    // A cell that rises is one that falls, seen in a mirror: its east is west there.
    ivec4 heights = cell.sw_ne ? cell.heights.yxwz : cell.heights;
    if (cell.sw_ne) share.y = 1.0 - share.y;
    bool first = west != cell.sw_ne;
    int corner = first ? heights.z : heights.y;
    if (heights.x == void_height || heights.w == void_height || corner == void_height) return no_ground_m;
    float north = float(heights.x - base), south = float(heights.w - base), other = float(corner - base);
    float along_first = first ? share.x : share.y, along_second = first ? share.y : share.x;
    return height_step_m * (north + along_first * (other - north) + along_second * (south - other));
}
