#version 460
// Gives forests that are farther than their trees are drawn the height of their canopy, in a picture whose ground is coloured: what stands on
// the ground of a pixel reaches up into the pixels above it, so far as its height goes there, and hides what is farther. A pixel asks those below
// it.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/growth/growth_table.glsl"
#include "shaders/growth/reach.glsl"
#include "shaders/growth/pixels_kept.glsl"
const bool in_air = true;
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 5) const bool edges_follow = false;  // edges.comp mixes what is in `sum`
#include "shaders/growth/kept_colour.glsl"
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Depths { float at[]; };

// As shade_growth.comp does: below 0. Edges of the ground are looked for by the depth of the ground.
void keep_depth(ivec2 pixel, float depth) {
    if (FRAME.depths != uvec2(0u) && !edges_follow) Depths(FRAME.depths).at[number_of(pixel)] = -depth;
}

// How many pixels to the right and down what is a metre higher moves, where it is a metre away along the view's axis.
vec2 px_upwards(vec3 ray) {
    vec2 size = vec2(FRAME.width_px, FRAME.height_px);
    return 0.5 * size * FRAME.projection_scale * (FRAME.up_view.xy + ray.xy * FRAME.up_view.z);
}

// The side of a forest is darker towards its foot.
float lit_at(float share_up) { return mix(0.75, 1.0, smoothstep(0.0, 0.5, share_up)); }
// Of tops beside and behind each other the higher ones are seen; with this their mean is that of drawn trees.
const float of_tops = 0.93;

void raise(ivec2 pixel) {
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    vec4 own = kept_at(pixel);
    if (own.w == 0.0) return;
    vec3 ray = ray_through(pixel);
    vec2 upwards = px_upwards(ray) * FRAME.exaggeration;
    float steps_per_m = max(abs(upwards.x), abs(upwards.y));
    if (steps_per_m <= 0.0) return;
    vec2 down = -upwards / steps_per_m;
    float depth = depth_in(pixel), hidden = 0.0, nearest = 0.0;
    vec3 colour = vec3(0.0);
    ivec2 last = ivec2(FRAME.width_px, FRAME.height_px) - 1;
    // The nearest stands lowest in the picture.
    for (int i = int(canopy_most_px(steps_per_m * length(ray), GROWTH.reach_m)); i > 0 && hidden < 0.999; --i) {
        ivec2 foot = pixel + ivec2(round(float(i) * down));
        if (any(lessThan(foot, ivec2(0))) || any(greaterThan(foot, last))) continue;
        vec4 there = kept_at(foot);
        if (there.w <= 1.01) continue;
        float foot_depth = depth_in(foot);
        if (foot_depth <= depth) continue;
        float high_px = of_tops * (there.w - 1.0) * steps_per_m * foot_depth / FRAME.near_m, covers = clamp(high_px - float(i) + 1.0, 0.0, 1.0);
        if (covers <= 0.0) continue;
        colour += (1.0 - hidden) * covers * lit_at(float(i) / high_px) * there.rgb;
        hidden += (1.0 - hidden) * covers;
        nearest = max(nearest, foot_depth);
    }
    if (hidden <= 0.0) return;
    vec4 before = vec4(own.rgb, depth == 0.0 ? 0.0 : 1.0);
    if (hidden >= 0.5) keep_depth(pixel, nearest);
    colour += (1.0 - hidden) * own.rgb;
    // For what water mirrors. Nobody asks what has no forest.
    if (own.w <= 1.01) KeptPixels(GROWTH.canopy).at[number_of(pixel)] = kept_pixel(colour, 0.0, max(-own.w, 0.0) * (1.0 - hidden));
    change_colour(pixel, before, vec4(colour, max(before.a, hidden)));
}

void main() { raise(ivec2(gl_GlobalInvocationID.xy)); }
