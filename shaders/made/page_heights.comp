#version 460
// Heights of a page of made terrain as they are drawn, with exaggeration and N, into the page's block: an invocation for each word of
// PageBlock.heights. The same bits as page_heights() of core/terrain makes of made_row_heights() of core/made.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_GOOGLE_include_directive : require

#define ORO_MADE_CONST const
#include "shaders/made/made_rule.glsl"
#include "shaders/made/page_source.glsl"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar) readonly buffer RuleOfTerrain { MadeRule rule; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer SourceOfPage { MadePageSource at; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer NodesOfN { float m[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer WordsOfHeights { uint at[]; };
layout(push_constant, scalar) uniform Work {
    RuleOfTerrain terrain;
    SourceOfPage source;
    NodesOfN N;
    WordsOfHeights heights;
    double exaggeration;
    int N_row;        // nodes from one row of N to the next, 0 where it has one; -1: N is 0 everywhere
    int N_column;     // ... from one column to the next
    int N_stride;     // ... in a row
    uint words;       // of heights
    uint sixteen;     // 1: two heights a word, codes of 16 bits (core/frame/height_quantization.h)
    uint code_shift;  // steps = code << shift + offset
    int code_offset;
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

const int void_steps = -2147483647 - 1;

// Functions of values alone: glslang 12 does not survive a precise sum of what it reads through an address.
double between(double first, double second, double share) {
    precise double rest = 1.0lf - share;
    precise double sum = rest * first + share * second;
    return sum;
}
// height_steps() of core/terrain/drawn_heights.h, of H in steps.
int drawn_steps(double H_m, double exaggeration, double N_m) {
    precise double h_m = H_m * exaggeration + N_m;
    precise double number = h_m * 2048.0lf + 0.5lf;
    double kept = clamp(number, -1073741824.0lf, 1073741824.0lf);
    int towards_zero = int(kept);
    return towards_zero - (kept < double(towards_zero) ? 1 : 0);
}

// As UndulationField::at_m().
double N_m_at(int row, double row_share, int column, double column_share) {
    int north = row * work.N_stride + column;
    double of_north = between(double(work.N.m[north]), double(work.N.m[north + work.N_column]), column_share);
    int south = north + work.N_row;
    double of_south = between(double(work.N.m[south]), double(work.N.m[south + work.N_column]), column_share);
    return between(of_north, of_south, row_share);
}

int steps_at(uint post) {
    MadePageRow row = work.source.at.rows[post / made_page_stride];
    MadePageColumn column = work.source.at.columns[post % made_page_stride];
    if ((row.is & column.is & made_post_there) == 0u) return void_steps;
    bool is_pole = (row.is & made_post_pole) != 0u;
    uint parity = is_pole ? 0u : ((row.is ^ column.is) & made_post_odd) >> 1u;
    int H = made_height(made_place(row.from_axis, column.cosine), made_place(row.from_axis, column.sine), row.north, parity);
    if (is_pole) column = work.source.at.of_poles;
    double N_m = work.N_row < 0 ? 0.0lf : N_m_at(row.N_first, row.N_share, column.N_first, column.N_share);
    return drawn_steps(double(H) * (1.0lf / 2048.0lf), work.exaggeration, N_m);
}

// As HeightQuantization::code().
uint code_of(int steps) {
    if (steps == void_steps) return 0x8000u;
    int half_step = (1 << work.code_shift) >> 1;
    return uint(clamp((steps - work.code_offset + half_step) >> work.code_shift, -32767, 32767)) & 0xffffu;
}

void main() {
    uint word = gl_GlobalInvocationID.x;
    if (word >= work.words) return;
    if (work.sixteen == 0u) {
        work.heights.at[word] = uint(steps_at(word));
        return;
    }
    uint last = made_page_stride * made_page_stride - 1u;
    uint second = 2u * word < last ? code_of(steps_at(2u * word + 1u)) : 0u;
    work.heights.at[word] = code_of(steps_at(2u * word)) | second << 16u;
}
