// Heights of made terrain, of a rectangle of posts: an invocation each. The same bits as made_row_heights of core/made.
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_GOOGLE_include_directive : require

#define ORO_MADE_CONST const
#include "shaders/made/made_rule.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar) readonly buffer RuleOfTerrain { MadeRule rule; };
layout(buffer_reference, scalar) readonly buffer PlacesOfRows { ivec2 from_axis_and_north[]; };
layout(buffer_reference, scalar) readonly buffer PlacesOfColumns { ivec2 cosine_and_sine[]; };
layout(buffer_reference, scalar) writeonly buffer HeightsOfPosts { int steps[]; };
// first_post: the sum of the numbers of the first row and column; the parity of posts counts from it. Rows count downwards.
layout(push_constant, scalar) uniform Work {
    RuleOfTerrain terrain;
    PlacesOfRows rows;
    PlacesOfColumns columns;
    HeightsOfPosts heights;
    uint row_count;
    uint column_count;
    uint first_post;
    uint pole_rows;  // 1: the first row is a pole, 2: the last one is
} work;

#define rule work.terrain.rule
#define ORO_FUNCTION
#define ORO_INOUT(type) inout type
#define ORO_RULE
#define ORO_PASS
int made_high(int a, int b) {
    int high, low;
    imulExtended(a, b, high, low);
    return high;
}
uint made_high(uint a, uint b) {
    uint high, low;
    umulExtended(a, b, high, low);
    return high;
}
#include "shaders/made/made_heights.glsl"

void main() {
    uint post = gl_GlobalInvocationID.x;
    if (post >= work.row_count * work.column_count) return;
    uint row = post / work.column_count;
    uint column = post % work.column_count;
    ivec2 on_row = work.rows.from_axis_and_north[row];
    ivec2 on_column = work.columns.cosine_and_sine[column];
    bool is_pole = ((work.pole_rows & 1u) != 0u && row == 0u) || ((work.pole_rows & 2u) != 0u && row + 1u == work.row_count);
    uint parity = is_pole ? 0u : (work.first_post + row + column) & 1u;
    work.heights.steps[post] = made_height(made_place(on_row.x, on_column.x), made_place(on_row.x, on_column.y), on_row.y, parity);
}
