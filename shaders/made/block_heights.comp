#version 460
// Heights of fbm at many rows and columns, and those of its coarse octaves: an invocation for each post. The same bits as
// made_row_coarse_heights() of core/made.
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
// Rows are the y of workgroups.
layout(push_constant, scalar) uniform Work {
    RuleOfTerrain terrain;
    PlacesOfRows rows;
    PlacesOfColumns columns;
    HeightsOfPosts all;
    HeightsOfPosts coarse;
    uint column_count;
    uint coarse_octaves;  // 0xffffffff: not asked for
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
    uint column = gl_GlobalInvocationID.x;
    if (column >= work.column_count) return;
    uint post = gl_WorkGroupID.y * work.column_count + column;
    ivec2 on_row = work.rows.from_axis_and_north[gl_WorkGroupID.y];
    ivec2 on_column = work.columns.cosine_and_sine[column];
    int x = made_place(on_row.x, on_column.x);
    int y = made_place(on_row.x, on_column.y);
    int sum = 0;
    for (uint k = 0u; k < rule.octaves; ++k) {
        if (k == work.coarse_octaves) work.coarse.steps[post] = rule.low + ((rule.high - rule.low) >> 1) + ((sum + 2) >> 2);
        sum += made_fbm_octave(rule.octave[k], x, y, on_row.y);
    }
    if (work.coarse_octaves == rule.octaves) work.coarse.steps[post] = rule.low + ((rule.high - rule.low) >> 1) + ((sum + 2) >> 2);
    work.all.steps[post] = made_octaves_height(sum);
}
