#version 460
// Keeps what a tile of a picture shows for the tiles that are drawn after it: their water mirrors it. Of several samples, or pixels, the mean
// colour of those that show what can be mirrored, their share and the nearest depth.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/growth/growth_table.glsl"
#include "shaders/growth/pixels_kept.glsl"
const bool in_air = true;
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
const bool edges_follow = false;
#include "shaders/growth/kept_colour.glsl"
#include "shaders/growth/picture_kept.glsl"

// What is mirrored of a square of pixels: the sum of its colours, in how many it is, and the nearest depth.
struct Mirrored {
    vec3 colours;
    float count;
    float depth;
};
Mirrored mirrored_in(ivec2 first, ivec2 end) {
    Mirrored all = Mirrored(vec3(0.0), 0.0, 0.0);
    for (int y = first.y; y < end.y; ++y)
        for (int x = first.x; x < end.x; ++x) {
            vec4 one = kept_at(ivec2(x, y));
            float depth = depth_in(ivec2(x, y));
            if (depth == 0.0 || one.w <= 0.0) continue;
            all.colours += one.rgb;
            all.count += 1.0;
            all.depth = max(all.depth, depth);
        }
    return all;
}

void main() {
    ivec2 own = ivec2(PICTURE.own_x_px, PICTURE.own_y_px), own_size = ivec2(PICTURE.own_width_px, PICTURE.own_height_px);
    int step_px = int(PICTURE.step_px);
    ivec2 kept = (own + first_of_frame()) / step_px + ivec2(gl_GlobalInvocationID.xy);
    ivec2 begin = kept * step_px - first_of_frame();
    // Whose middle a tile has, that it keeps.
    ivec2 middle = min(begin + step_px / 2, size_of_picture() - 1 - first_of_frame());
    if (!is_within(kept * step_px, size_of_picture()) || !is_within(middle - own, own_size)) return;
    ivec2 first = max(begin, ivec2(0)), end = min(begin + step_px, size_of_frame());
    float asked = float((end.x - first.x) * (end.y - first.y));
    Mirrored all = mirrored_in(first, end);
    uint at = number_in_picture(kept);
    if (FRAME.sample_index > 0u) {
        KeptOfPicture before = KeptPicture(PICTURE.pixels).at[at];
        vec4 colour = colour_of_kept(before.pixel);
        float count = before.depth == 0.0 || colour.w <= 0.0 ? 0.0 : colour.w * asked * float(FRAME.sample_index);
        all = Mirrored(all.colours + count * colour.rgb, all.count + count, max(all.depth, count > 0.0 ? before.depth : 0.0));
    }
    vec4 shown = all.count > 0.0 ? vec4(all.colours / all.count, all.count / (asked * float(FRAME.sample_index + 1u))) : kept_at(middle);
    KeptPicture(PICTURE.pixels).at[at] = KeptOfPicture(uvec2(packHalf2x16(shown.rg), packHalf2x16(shown.ba)), all.count > 0.0 ? all.depth : depth_in(middle));
}
