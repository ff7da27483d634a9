#version 460
// Colours the pixels that show grass: the light that the ground there sends back, as a blade has it at its place along it.
#extension GL_GOOGLE_include_directive : require
#define IN_AIR
const bool as_map = false;
const bool in_air = true;
const bool casts = false;  // clumps have their light
const bool opens = false;
const bool draped = false;
const bool by_means = false;
const bool parts_follow = false;
const bool parts_alone = false;
const bool of_materials = false;
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/surface.glsl"
#include "shaders/air/air.glsl"
#include "shaders/air/sky.glsl"
#include "shaders/air/aerial.glsl"
#include "shaders/shade/daylight.glsl"
#include "shaders/shade/srgb.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/meadow.glsl"
#include "shaders/growth/light_of_blade.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 5) const bool edges_follow = false;  // edges.comp mixes what is in `sum`
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Depths { float at[]; };
layout(binding = 1, rgba32f) uniform image2D sum;
layout(binding = 2, rgba8) uniform writeonly image2D picture;

// As shade.comp, but below 0: who reads depths tells the ground from what grows on it.
void keep_depth(ivec2 pixel, float depth) {
    if (FRAME.depths != uvec2(0u)) Depths(FRAME.depths).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)] = -depth;
}
void keep_colour(ivec2 pixel, vec3 colour) {
    float ground = 1.0;
    if (edges_follow) imageStore(sum, pixel, vec4(colour, ground));
    else if (FRAME.sample_count > 1u) {
        vec4 total = vec4(colour, ground) + (FRAME.sample_index == 0u ? vec4(0.0) : imageLoad(sum, pixel));
        imageStore(sum, pixel, total);
        if (FRAME.sample_index + 1u < FRAME.sample_count) return;
        colour = total.rgb / float(FRAME.sample_count);
        ground = total.a / float(FRAME.sample_count);
    }
    imageStore(picture, pixel, vec4(dithered(srgb_from_linear(colour), pixel), ground));
}

void shade(ivec2 pixel) {
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    uvec2 word = VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)];
    const uint ids_per_tile = meshlets_per_page * meshlet_triangles;
    uint id = id_of(word), first = GROWTH.first_page * ids_per_tile + 1u;
    if (id < first || id - first >= GROWTH.tile_count * ids_per_tile) return;
    uint standing = (id - first) / blades_per_clump, number = (id - first) % blades_per_clump;
    GrowthTile tile = GrowthTiles(GROWTH.tiles).at[standing / clumps_per_tile];
    MeadowClump clump = Clumps(GROWTH.sites).at[standing];
    uint clump_number = standing % clumps_per_tile, hash = hash_of_clump(tile, clump_number);
    MeadowBlade blade = blade_numbered(clump, hash, number, wind_on(tile, clump_number, hash));
    float depth = uintBitsToFloat(word.y);
    vec3 view = ray_of_pixel(pixel) * (FRAME.near_m / depth);
    mat3 axes = axes_of_foot(clump.foot);
    float t = along_blade(blade, dot(view - clump.foot, axes[2]) / FRAME.exaggeration - blade.foot.z);
    vec3 to_eye = normalize(-view * axes), ground = normalize(vec3(-unpackHalf2x16(clump.slope), 1.0));
    vec3 radiance = light_of(clump) * light_of_blade(blade, t, sun_at(view), to_eye) 
                    / (meadow_seen(dot(ground, to_eye)) * widened_light(length(clump.foot) / FRAME.pixels_per_tangent));
    keep_depth(pixel, depth);
    keep_colour(pixel, shown(through_air(radiance, view)));
}

void main() { shade(ivec2(gl_GlobalInvocationID.xy)); }
