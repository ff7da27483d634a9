#version 460
// Softens the outlines of trees in a shaded picture of one sample: a pixel that shows another tree, or the ground, than one beside it takes
// an eighth of that one's colour, and more where trees are hardly larger than pixels: there they would glitter. Needs what shade_growth.comp has left in `sum`.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/shared_growth.h"
const bool in_air = true;
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1, rgba32f) uniform readonly image2D shaded;  // linear light; alpha: 1 where there is ground
layout(binding = 2, rgba8) uniform writeonly image2D picture;
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer GrowthTables { GrowthTable at; };
layout(push_constant, scalar) uniform Growth { uvec2 growth_table; };

// The tree that a pixel shows, or 0.
uint tree_in(ivec2 pixel) {
    uint id = id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]);
    uint first = GrowthTables(growth_table).at.first_page * (meshlets_per_page * meshlet_triangles) + 1u;
    uint count = GrowthTables(growth_table).at.tile_count * (meshlets_per_page * meshlet_triangles);
    return id >= first && id - first < count ? id : 0u;
}

void keep(ivec2 pixel, vec4 colour) { imageStore(picture, pixel, vec4(dithered(srgb_from_linear(colour.rgb), pixel), colour.a)); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), last = ivec2(FRAME.width_px, FRAME.height_px) - 1;
    if (any(greaterThan(pixel, last))) return;
    uint tree = tree_in(pixel);
    vec4 own = imageLoad(shaded, pixel), beside_it = vec4(0.0);
    float others = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 beside = clamp(pixel + ivec2(i == 0 ? 1 : i == 1 ? -1 : 0, i == 2 ? 1 : i == 3 ? -1 : 0), ivec2(0), last);
        if (tree_in(beside) == tree) continue;
        beside_it += imageLoad(shaded, beside) - own;
        others += 1.0;
    }
    // Without an outline it is as it was shaded.
    if (others > 0.0) keep(pixel, own + (others > 3.0 ? 0.2 : others > 2.0 ? 0.16 : 0.125) * beside_it);
}
