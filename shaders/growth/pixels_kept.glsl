// What pixels show, as shade.comp and shade_growth.comp leave it in GrowthTable.canopy: each as four halves, its colour, linear light, and a
// number that is 1 and more of ground and the sky (by so many metres a forest without drawn trees rises above it), below 0 of water (its share,
// negative), and 0 of what has left nothing. Needs growth_table.glsl.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer KeptPixels { uvec2 at[]; };

uint number_of(ivec2 pixel) { return uint(pixel.y) * FRAME.width_px + uint(pixel.x); }
uvec2 kept_pixel(vec3 colour, float canopy_m, float water) {
    return uvec2(packHalf2x16(colour.rg), packHalf2x16(vec2(colour.b, water > 0.01 ? -water : 1.0 + canopy_m)));
}
vec4 colour_of_kept(uvec2 halves) { return vec4(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y)); }
vec4 kept_at(ivec2 pixel) { return colour_of_kept(KeptPixels(GROWTH.canopy).at[number_of(pixel)]); }
