#version 460
// Colours each pixel once: turns its triangle id back into a place on the surface, and that into light.
#extension GL_GOOGLE_include_directive : require
// Six programs, by what is defined (HAS_NET too, frame.glsl): the drivers that compile for processors join all that a program names before they leave out what its
// constants never ask for, and that takes them longer than to draw.
#ifdef AS_MAP
const bool as_map = true;  // any FrameStyle that is not tints by height, as light, in the sun and in air
#else
const bool as_map = false;
#endif
#ifdef IN_AIR
const bool in_air = true;  // FrameStyle.air
#else
const bool in_air = false;
#endif
layout(constant_id = 1) const bool casts = false;     // FrameStyle.shadows
layout(constant_id = 2) const bool opens = false;     // FrameStyle.sky_openness
layout(constant_id = 3) const bool draped = false;    // FrameConstants.drape
layout(constant_id = 4) const bool by_means = false;  // FrameStyle.footprint
// On a GPU two programs share the pixels of a style in air: near ground and the sky, in small code; then footprints of several parts, what may
// be water, and what is no ground.
layout(constant_id = 6) const bool parts_follow = false;
layout(constant_id = 7) const bool parts_alone = false;
layout(constant_id = 8) const bool of_materials = false;  // FrameStyle.materials
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/srgb.glsl"
#define FILE_COLOURS
#include "shaders/shade/surface.glsl"
#include "shaders/air/air.glsl"
#include "shaders/air/sky.glsl"
#include "shaders/air/aerial.glsl"
#include "shaders/cast/casters.glsl"
#include "shaders/cast/shadow.glsl"
#include "shaders/cast/shown.glsl"
#include "shaders/shade/daylight.glsl"
#include "shaders/shade/light.glsl"
#include "shaders/shade/water.glsl"
#include "shaders/shade/outside.glsl"
#include "shaders/shade/drape.glsl"
#include "shaders/shade/cover_tiles.glsl"
#include "shaders/shade/ground.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 5) const bool edges_follow = false;  // edges.comp mixes what is in `sum`
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
// Written by a function: glslang 12.0 does not end on such an assignment in main().
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Depths { float at[]; };
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(binding = 1, rgba32f) uniform image2D sum;  // of the samples so far, linear light; alpha: those with ground
layout(binding = 2, rgba8) uniform writeonly image2D picture;  // sRGB-encoded; alpha: the share of samples with ground

void keep_depth(ivec2 pixel, float depth) {
    if (FRAME.depths != uvec2(0u)) Depths(FRAME.depths).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)] = depth;
}

uint id_in(ivec2 pixel) {
    return from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]) : imageLoad(ids, pixel).x;
}
#include "shaders/cast/cast_on.glsl"
#ifdef IN_AIR
#include "shaders/growth/growth_table.glsl"
#include "shaders/growth/shade_map.glsl"
#include "shaders/growth/pixels_kept.glsl"
void keep_pixel(ivec2 pixel, vec3 colour, float water) {
    if (!of_materials || (FRAME.style.materials.on & materials_with_trees) == 0u) return;
    KeptPixels(GROWTH.canopy).at[number_of(pixel)] = kept_pixel(colour, pixel_canopy_m, water);
}
#endif

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer TilesInParts { uint at[]; };
uint tile_number() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
bool tile_has_parts() { return TilesInParts(FRAME.tiles_in_parts).at[tile_number()] != 0u; }
void keep_tile() { atomicOr(TilesInParts(FRAME.tiles_in_parts).at[tile_number()], 1u); }

void keep_colour(ivec2 pixel, vec3 colour, float ground) {
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

// False where the pixel is left to the other of two programs.
bool shade(ivec2 pixel) {
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return true;
    vec2 clip = (vec2(pixel) + 0.5) * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    vec3 ray = vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
    uint id = id_in(pixel);
    if (FRAME.other_grids != 0u && is_left_to_others(id)) return true;
    float depth = 0.0;
    vec3 colour;
#ifdef IN_AIR
    LitPlace place;
    bool is_sky = false;
#endif
    if (id == 0u) {
#ifdef IN_AIR
        bool is_left;
        is_sky = sees_sky(normalize(ray), colour, place, is_left);
        if (is_left) return false;
#else
        colour = seen_background(normalize(ray));
#endif
    } else {
        SurfacePoint point = surface_at(triangle_of_id(id), ray);
        if (point.is_left) return false;
        depth = FRAME.near_m / -point.view.z;
        cast_on(point, id, pixel);
        look_for_snow(point);
#ifdef IN_AIR
        if (casts && (FRAME.style.materials.on & materials_with_trees) != 0u) shown_share *= light_past_trees(point.view, 0.4);
        place = ground_place(point);
    }
    if (!is_sky) colour = through_air(sent_by(place), place.view);
    colour = shown(colour);
    keep_pixel(pixel, colour, is_sky || id == 0u ? 0.0 : place.water);
#else
        colour = colour_of_surface(point);
    }
#endif
    // From the triangle and the pixel alone, so that both ways of drawing give the same.
    keep_depth(pixel, depth);
    keep_colour(pixel, colour, id == 0u ? 0.0 : 1.0);
    return true;
}

void main() {
    if (parts_alone && !tile_has_parts()) return;
    if (!shade(ivec2(gl_GlobalInvocationID.xy)) && parts_follow) keep_tile();
}
