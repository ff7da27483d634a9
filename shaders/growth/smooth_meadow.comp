#version 460
// Softens grass in a shaded picture of one sample: a pixel takes of the colours of those around it that show another blade, or no grass, a
// sixteenth or an eighth each. Needs what shade_meadow.comp has left in `sum`.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/shared_meadow.h"
const bool in_air = true;
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 1, rgba32f) uniform readonly image2D shaded;  // linear light; alpha: 1 where there is ground
layout(binding = 2, rgba8) uniform writeonly image2D picture;
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer MeadowTables { MeadowTable at; };
layout(push_constant, scalar) uniform Growth { uvec2 growth_table; };

uint id_at(ivec2 pixel) { return id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]); }

void keep(ivec2 pixel, vec4 colour) { imageStore(picture, pixel, vec4(dithered(srgb_from_linear(colour.rgb), pixel), colour.a)); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), last = ivec2(FRAME.width_px, FRAME.height_px) - 1;
    if (any(greaterThan(pixel, last))) return;
    const uint ids_per_tile = meshlets_per_page * meshlet_triangles;
    uint first = MeadowTables(growth_table).at.growth.first_page * ids_per_tile + 1u, count = MeadowTables(growth_table).at.growth.tile_count * ids_per_tile;
    uint own_id = id_at(pixel);
    bool own_is_grass = own_id >= first && own_id - first < count, shows_grass = false;
    vec4 own = imageLoad(shaded, pixel), colour = own;
    for (int i = 0; i < 9; ++i) {
        ivec2 step = ivec2(i % 3, i / 3) - 1;
        if (step == ivec2(0)) continue;
        ivec2 beside = clamp(pixel + step, ivec2(0), last);
        uint id = id_at(beside);
        bool is_grass = id >= first && id - first < count;
        if (id == own_id || (!is_grass && !own_is_grass)) continue;
        colour += (step.x == 0 || step.y == 0 ? 0.125 : 0.0625) * (imageLoad(shaded, beside) - own);
        shows_grass = true;
    }
    if (shows_grass) keep(pixel, vec4(colour.rgb, own.a));
}
