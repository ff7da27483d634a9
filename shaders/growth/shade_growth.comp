#version 460
// Colours the pixels that show trees: from a site and a ray back to a place on its crown, and that into light.
#extension GL_GOOGLE_include_directive : require
#define IN_AIR
const bool as_map = false;
const bool in_air = true;
const bool casts = false;  // sites have their share of the sun
layout(constant_id = 2) const bool opens = false;  // FrameStyle.sky_openness
const bool draped = false;
const bool by_means = false;
const bool parts_follow = false;
const bool parts_alone = false;
const bool of_materials = true;
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/surface.glsl"
#include "shaders/air/air.glsl"
#include "shaders/air/sky.glsl"
#include "shaders/air/aerial.glsl"
#include "shaders/cast/casters.glsl"
#include "shaders/cast/shadow.glsl"
#include "shaders/cast/shown.glsl"
#include "shaders/shade/daylight.glsl"
#include "shaders/shade/light.glsl"
#include "shaders/shade/srgb.glsl"
#include "shaders/shade/water.glsl"
#include "shaders/shade/outside.glsl"
#include "shaders/shade/drape.glsl"
#include "shaders/shade/cover_tiles.glsl"
#include "shaders/shade/ground.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/crown.glsl"
#include "shaders/growth/shade_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 5) const bool edges_follow = false;  // edges.comp mixes what is in `sum`
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Depths { float at[]; };
#include "shaders/growth/pixels_kept.glsl"
layout(binding = 1, rgba32f) uniform image2D sum;
layout(binding = 2, rgba8) uniform writeonly image2D picture;

// As shade.comp, but below 0: who reads depths tells the ground from what grows on it.
void keep_depth(ivec2 pixel, float depth) {
    if (FRAME.depths != uvec2(0u)) Depths(FRAME.depths).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)] = -depth;
}
void keep_pixel(ivec2 pixel, vec3 colour) { KeptPixels(GROWTH.canopy).at[number_of(pixel)] = kept_pixel(colour, 0.0, 0.0); }
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

// A crown in the sun is lighter than a forest's mean, which holds the shade between crowns.
const float needle_lighter = 3.3, broad_lighter = 1.25;

// Lighter and darker parts of forests have lighter and darker trees.
float patch_of_site(uint stands) { return most_patch * (float(stands >> site_patch_bit) / 127.0 - 1.0); }

// What leaves send back of the sun's light and the sky's.
GroundLight light_of_crown(Crown crown, CrownHit hit, uint stands, vec3 sun, vec3 to_eye, float pixel_m) {
    uint material = crown.kind == site_needle ? material_needle_forest : material_broad_forest;
    vec3 albedo = FRAME.style.materials.of[material].colour + (crown.colour + patch_of_site(stands)) * FRAME.style.materials.of[material].patches;
    albedo = max(albedo, vec3(0.0));
    // Trees of a kind differ: some are older, drier, of another species.
    float lighter = crown.kind == site_needle ? needle_lighter : broad_lighter;
    albedo *= lighter * (1.0 + 0.3 * crown.colour) * mix(vec3(1.0), vec3(1.1, 1.0, 0.85), clamp(crown.colour + 0.25, 0.0, 1.0));
    if (hit.is_stem) albedo = vec3(0.085, 0.07, 0.055);
    float detail = detail_at(pixel_m);
    vec3 normal = hit.is_stem ? normalize(vec3(hit.at.xy, 0.01)) : normal_of_crown(crown, hit.at, detail, leaves_at(pixel_m));
    // Leaves of a bunch look every way: its normal is most of it, and a smooth crown's the rest; light that goes
    // from leaf to leaf comes from above.
    vec3 smooth_normal = hit.is_stem ? normal : normal_of_crown(crown, hit.at, 0.0, vec2(0.0));
    normal = normalize(mix(smooth_normal, normal, 0.65) + vec3(0.0, 0.0, hit.is_stem ? 0.0 : 0.45));
    if (!hit.is_stem) albedo *= 1.0 + detail * 0.7 * (leaf_noise(5.5 * hit.at, crown.hash + 4u) - 0.5);
    float up = clamp((hit.at.z - crown.low_m) / max(crown.high_m - crown.low_m, 0.1), 0.0, 1.0);
    bool in_forest = (stands & site_in_forest) != 0u;
    // Neighbours take light from the lower part of a crown, and leaves from what is inside.
    float reached = in_forest ? mix(0.18, 1.0, smoothstep(0.05, 0.75, up)) : mix(0.6, 1.0, smoothstep(0.0, 0.5, up));
    float outside = hit.is_stem ? 1.0 : 1.0 - 0.75 * hit.inside;
    float cosine = dot(normal, sun), facing_sun = max(0.75 * cosine + 0.25, 0.0) * step(0.0, sun.z);
    // Leaves let some light through: crowns before the sun have a bright rim.
    float through = crown.kind == site_needle ? 0.12 : 0.3;
    float rim = pow(1.0 - clamp(dot(smooth_normal, to_eye), 0.0, 1.0), 2.0), before_sun = max(-dot(to_eye, sun), 0.0);
    GroundLight light;
    // All that comes from around, of which the sky is the upper part.
    light.colour = 0.6 * albedo * outside * mix(0.25, 1.0, in_forest ? up : 0.5 + 0.5 * up);
    light.open = light.colour * (0.55 + 0.45 * normal.z);
    light.lit = albedo * (reached * outside * (facing_sun + through * rim * before_sun * before_sun * step(0.0, sun.z)));
    return light;
}

void shade(ivec2 pixel) {
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    uint id = id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]);
    const uint ids_per_tile = meshlets_per_page * meshlet_triangles;
    uint first = GROWTH.first_page * ids_per_tile + 1u;
    if (id < first || id - first >= GROWTH.tile_count * ids_per_tile) return;
    uint tile_number = (id - first) / ids_per_tile, site = (id - first) % ids_per_tile / ids_per_site;
    GrowthTile tile = GrowthTiles(GROWTH.tiles).at[tile_number];
    uint stands = Words(GROWTH.sites).at[tile_number * sites_per_tile + site], hash = hash_of_site(tile, site);
    SitePlace place;
    place_of_site(tile, site, hash, place);
    Crown crown = crown_at(place.view, hash, stands);
    vec3 ray = ray_of_pixel(pixel);
    float pixel_m = pixel_m_at(crown.foot);
    CrownHit hit;
    if (!hits_crown(crown, ray, pixel_m, no_hit, hit)) {
        // Another program may round a rim otherwise.
        hit.depth_m = -(crown.foot.z + 0.6 * crown.high_m * crown.axes[2].z);
        hit.at = vec3(0.0, 0.0, 0.6 * crown.high_m);
        hit.inside = 0.0;
        hit.is_stem = false;
    }
    vec3 view = ray * hit.depth_m, sun = sun_at(view);
    float site_sun = most_sun * float((stands >> site_sun_bit) & 255u) / 255.0;
    if (opens) {
        SurfacePoint ground;
        ground.view = place.view;
        ground.shaded_page = place.page;
        ground.shaded_post = place.post;
        open_share = sky_openness(ground);
    }
    GroundLight light = light_of_crown(crown, hit, stands, sun, normalize(-ray * crown.axes), pixel_m);
    // Its own leaves are told by how far inside they are.
    light.lit *= site_sun * (0.25 + 0.75 * light_past_trees(view, 1.5 + crown.radius_m));
    LitPlace lit = LitPlace(light, view, place.h_m + hit.at.z, sun, 0.0);
    keep_depth(pixel, FRAME.near_m / hit.depth_m);
    vec3 colour = shown(through_air(sent_by(lit), view));
    keep_pixel(pixel, colour);
    keep_colour(pixel, colour);
}

void main() { shade(ivec2(gl_GlobalInvocationID.xy)); }
