#version 460
// Decides how many blades of each clump near the eye are drawn, and what light the ground there sends back: an invocation takes a clump.
#extension GL_GOOGLE_include_directive : require
#define IN_AIR
#define GROWS_GRASS
const bool as_map = false;
const bool in_air = true;
layout(constant_id = 1) const bool casts = false;     // FrameStyle.shadows
layout(constant_id = 2) const bool opens = false;     // FrameStyle.sky_openness
layout(constant_id = 3) const bool draped = false;    // FrameConstants.drape
layout(constant_id = 4) const bool by_means = false;  // pages have PageMeans
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
#include "shaders/cast/start.glsl"
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
#include "shaders/growth/site_ground.glsl"
#include "shaders/growth/shade_map.glsl"
#include "shaders/growth/meadow.glsl"

layout(local_size_x = 128) in;  // clump_group

const float steep_from_deg = 34.0, steep_to_deg = 52.0;  // grass thins out over these slopes

// Whether a ball meets the picture.
bool may_show(vec3 middle, float radius_m) {
    float w = -middle.z;
    if (w < -radius_m) return false;
    vec2 side = FRAME.projection_scale * middle.xy + FRAME.projection_shift * w;
    vec2 slack = radius_m * sqrt(FRAME.projection_scale * FRAME.projection_scale + (1.0 + abs(FRAME.projection_shift)) * (1.0 + abs(FRAME.projection_shift)));
    return all(lessThanEqual(abs(side), vec2(w) + slack));
}

bool is_hidden(vec3 foot, vec3 top, float radius_m) {
    if (min(-foot.z, -top.z) < radius_m + 1.0) return false;
    ivec4 box = pixels_around(foot, top, radius_m);
    return is_empty(box) || is_behind_ground(box, nearest_depth(foot, top, radius_m));
}

// The meadow's share of a place, and its colour there, linear light.
float share_of_meadow(SitePlace place, SurfacePoint point, out vec3 colour) {
    float known = 0.0, share = 0.0;
    colour = pixel_materials[material_meadow];
    if (draped && has_images()) return 0.0;
    if (draped && has_cover()) {
        uint texel = texel_of_map(place, point);
        share = shares_of_texel(texel, known).of[material_meadow];
        if (share > 0.0) colour = cover_of_texel(texel).rgb / known;
        if (known >= 1.0) return share;
    }
    if (FRAME.style.water.on == 1u && water_share(frame_pages().at[place.page], place.post) > 0.1) return share;
    return share + (1.0 - known) * shares_by_rule(point).of[material_meadow];
}

// What the ground sends back, before the air. False where no more of it is meadow than a number of 0 to 1 says.
bool is_meadow(SitePlace place, SurfacePoint point, float number, out vec3 light_here) {
    vec3 sun = sun_at(point.view), colour;
    find_pixel_materials(point, sun);
    light_here = vec3(0.0);
    if (number >= share_of_meadow(place, point, colour)) return false;
    if (opens) {
        point.shaded_page = place.page;
        point.shaded_post = place.post;
        open_share = sky_openness(point);
    }
    vec3 normal = steeper(point.normal, FRAME.style.relief);
    GroundLight light = GroundLight(colour, colour * facing(normal, sun), colour * (0.5 + 0.5 * normal.z));
    if (casts && light.lit != vec3(0.0)) shown_share = sun_on_site(place, point, 0.0) * light_past_trees(point.view, 0.4);
    light_here = sent_by(LitPlace(light, point.view, point.h_m, sun, 0.0));
    return true;
}

// What the drawn triangle rises for a metre east, and north, not exaggerated.
vec2 slope_of(SitePlace place, mat3 axes) {
    vec3 normal = cross(place.corners[1] - place.corners[0], place.corners[2] - place.corners[0]) * axes;
    return clamp(-normal.xy / (normal.z * FRAME.exaggeration), -3.0, 3.0);
}

MeadowClump clump_that_stands(GrowthTile tile, uint number) {
    MeadowClump clump = MeadowClump(vec3(0.0), 0u, 0u, 0u, 0.0);
    uint hash = hash_of_clump(tile, number);
    SitePlace place;
    if (!place_in_tile(tile, place_of_clump(number, hash), place)) return clump;
    float distance_m = length(place.view), kept = meadow_at(distance_m) * blades_kept(distance_m / FRAME.pixels_per_tangent);
    if (kept <= 0.02) return clump;
    mat3 axes = axes_of_foot(place.view);
    float tallest_m = FRAME.exaggeration * clump_height_m(clump_size_most), reach_m = clump_reach_m(clump_size_most);
    vec2 slope = slope_of(place, axes);
    float radius_m = reach_m + 0.02 + clump_spread_m * max(FRAME.exaggeration, 1.0) * (abs(slope.x) + abs(slope.y)) + 2.0 * distance_m / FRAME.pixels_per_tangent;
    vec3 top = place.view + tallest_m * axes[2];
    if (!may_show(0.5 * (place.view + top), 0.5 * tallest_m + radius_m) || is_hidden(place.view, top, radius_m)) return clump;
    SurfacePoint point = ground_of(place);
    point.drape_post = place.whole;
    point.drape_part = place.part;
    kept *= 1.0 - smoothstep(steep_from_deg, steep_to_deg, slope_deg(point));
    vec3 light;
    if (kept <= 0.02 || !is_meadow(place, point, site_number(hash, 3u), light)) return clump;
    clump.foot = place.view;
    clump.slope = packHalf2x16(slope);
    clump.red_green = packHalf2x16(light.xy);
    clump.blue_kept = packHalf2x16(vec2(light.z, 0.0)) & 0xffffu | uint(min(kept, float(blades_per_clump)) * 1024.0 + 0.5) << 16u;
    clump.size = clamp(0.75 + 0.5 * site_number(hash, 8u) + 0.12 * pixel_noise.patches, 0.55, clump_size_most);
    return clump;
}

void list_pieces(uint tile, uint number, uint count) {
    Pieces pieces = Pieces(MEADOW.pieces);
    uint at = atomicAdd(pieces.head.count, count);
    for (uint i = 0u; i < count && at + i < MEADOW.piece_max; ++i) pieces.at[at + i] = (tile * clumps_per_tile + number) * (blades_per_clump / blades_per_piece) + i;
    atomicMax(pieces.head.groups[0], (min(at + count, MEADOW.piece_max) + pieces_per_group - 1u) / pieces_per_group);
}

void grow(uint tile, uint number) {
    MeadowClump clump = clump_that_stands(GrowthTiles(GROWTH.tiles).at[tile], number);
    Clumps(GROWTH.sites).at[tile * clumps_per_tile + number] = clump;
    uint blades = uint(ceil(kept_of(clump)));
    if (blades > 0u) list_pieces(tile, number, (blades + blades_per_piece - 1u) / blades_per_piece);
}

void main() {
    uint group = folded(gl_WorkGroupID), tile = group / clump_groups_per_tile;
    if (tile < GROWTH.tile_count) grow(tile, group % clump_groups_per_tile * clump_group + gl_LocalInvocationIndex);
}
