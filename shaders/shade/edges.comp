#version 460
// Smooths the edges of a shaded picture of one sample: where ground meets sky, or nearer ground meets farther ground, a pixel gets the
// share of what is beyond the edge that a straight edge through its steps would cover. From colours and depths alone, so that both ways
// of drawing give the same. Source: A. Reshetov, Morphological antialiasing, High Performance Graphics 2009, sections 2 and 3.
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 2) const bool in_air = false;  // FrameStyle.air
#include "shaders/place/frame.glsl"
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1, rgba32f) uniform readonly image2D shaded;          // linear light; alpha: 1 where there is ground
layout(binding = 2, rgba8) uniform writeonly image2D picture;
const int longest_px = 16;  // a step that is followed

float depth_at(ivec2 pixel) { return Floats(FRAME.depths).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]; }
bool within(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(FRAME.width_px, FRAME.height_px))); }

// Is there an edge between a pixel and the next one? Reversed depth is linear over a plane: it is none where depth goes on as before or
// after.
bool is_edge(ivec2 pixel, ivec2 step) {
    ivec2 next = pixel + step, before = pixel - step, after = next + step;
    if (!within(pixel) || !within(next)) return false;
    float here = depth_at(pixel), there = depth_at(next);
    if (here == 0.0 || there == 0.0) return here != there;
    float jump = abs(there - here);
    if (jump < 0.015 * min(here, there)) return false;
    float slope = 0.0;
    if (within(before) && depth_at(before) > 0.0) slope = abs(here - depth_at(before));
    if (within(after) && depth_at(after) > 0.0) slope = max(slope, abs(depth_at(after) - there));
    return jump > 2.0 * slope;
}

// How far the edge between a pixel and its neighbour goes on along `along`, in pixels beside this one, and where it ends: towards the
// pixel's own side 0.5, away from it -0.5, neither 0.
float followed(ivec2 pixel, ivec2 to_neighbour, ivec2 along, out float end) {
    int length_px = 0;
    while (length_px < longest_px && is_edge(pixel + along * (length_px + 1), to_neighbour)) ++length_px;
    ivec2 last = pixel + along * length_px;
    bool own = is_edge(last, along), other = is_edge(last + to_neighbour, along);
    end = length_px == longest_px || own == other ? 0.0 : own ? 0.5 : -0.5;
    return float(length_px);
}

// What a line covers of a pixel from its end, `from` pixels away, to the middle of the step, where it crosses the pixels' border.
float covered(float end, float from, float length_px) {
    float low = from, high = min(from + 1.0, 0.5 * length_px);
    return high <= low ? 0.0 : end * ((high - high * high / length_px) - (low - low * low / length_px));
}

// The share of a neighbour in a pixel.
float share_of(ivec2 pixel, ivec2 to_neighbour) {
    if (!is_edge(pixel, to_neighbour)) return 0.0;
    float end_before, end_after;
    ivec2 along = to_neighbour.yx;
    float before = followed(pixel, to_neighbour, -along, end_before), after = followed(pixel, to_neighbour, along, end_after);
    float length_px = before + after + 1.0;
    return max(covered(end_before, before, length_px) + covered(end_after, after, length_px), 0.0);
}

void keep(ivec2 pixel, vec4 colour) { imageStore(picture, pixel, vec4(dithered(srgb_from_linear(colour.rgb), pixel), colour.a)); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!within(pixel)) return;
    vec4 own = imageLoad(shaded, pixel), colour = own;
    const ivec2 steps[4] = {ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1)};
    for (int i = 0; i < 4; ++i) {
        float share = share_of(pixel, steps[i]);
        if (share > 0.0) colour += share * (imageLoad(shaded, pixel + steps[i]) - own);
    }
    keep(pixel, colour);
}
