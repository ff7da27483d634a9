// A pixel's colour that is changed once it is shaded. Needs pixels_kept.glsl, srgb.glsl and the constant edges_follow.
layout(binding = 1, rgba32f) uniform image2D sum;  // of the samples so far, linear light; alpha: those with ground
layout(binding = 2, rgba8) uniform writeonly image2D picture;

// Reversed depth; 0 of the sky.
float depth_in(ivec2 pixel) {
    uvec2 word = VisibilityWords(FRAME.visibility).at[number_of(pixel)];
    return word.x == 0u ? 0.0 : uintBitsToFloat(word.y);
}
void change_colour(ivec2 pixel, vec4 before, vec4 after) {
    vec4 colour = after;
    if (edges_follow || FRAME.sample_count > 1u) {
        vec4 total = imageLoad(sum, pixel) + (after - before);
        imageStore(sum, pixel, total);
        if (!edges_follow && FRAME.sample_index + 1u < FRAME.sample_count) return;
        colour = edges_follow ? total : total / float(FRAME.sample_count);
    }
    imageStore(picture, pixel, vec4(dithered(srgb_from_linear(colour.rgb), pixel), colour.a));
}
vec3 ray_through(ivec2 pixel) {
    vec2 clip = (vec2(pixel) + 0.5) * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    return vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
}
