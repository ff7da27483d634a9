#version 460
// Decides what stands on each site that list_sites.comp asks for: where the materials of the ground are forest, a tree; and how much of the sun the terrain leaves it.
#extension GL_GOOGLE_include_directive : require
#define IN_AIR
const bool as_map = false;
const bool in_air = true;
layout(constant_id = 1) const bool casts = false;     // FrameStyle.shadows
const bool opens = false;
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
#include "shaders/growth/kept_rank.glsl"
#include "shaders/growth/site_ground.glsl"

layout(local_size_x = 128) in;  // site_group

// What of a place is forest of needle trees and of broad-leaved ones; and what is open ground where single trees stand.
struct Stands {
    float needle;
    float broad;
    float open;
};

const float foot_m = 4.0;  // borders are as sharp as sites are apart
const float trees_in_meadows = 0.006, trees_in_crops = 0.002, trees_in_shrub = 0.07;

Stands stands_of(MaterialShares shares) {
    float open = trees_in_meadows * shares.of[material_meadow] + trees_in_crops * shares.of[material_crops] + trees_in_shrub * shares.of[material_shrub];
    return Stands(shares.of[material_needle_forest], shares.of[material_broad_forest], open);
}

Stands stands_at(SitePlace place, SurfacePoint point) {
    pixel_noise = ground_noise(point.view, foot_m, 0.0005, true);
    // Crowns are wide: no tree stands beside a mesh, whatever a map says.
    if (mesh_distance_m(point.view).x < 9.0) return Stands(0.0, 0.0, 0.0);
    find_pixel_parcel(point, slope_deg(point), foot_m);
    pixel_second = patched(0.0, 1.0);
    float known = 0.0;
    Stands by_map = Stands(0.0, 0.0, 0.0);
    if (draped && has_cover()) by_map = stands_of(shares_by_map(place, point, known));
    if (known >= 1.0) return by_map;
    // Nothing by the rule stands in water that the heights tell.
    if (FRAME.style.water.on == 1u && water_share(frame_pages().at[place.page], place.post) > 0.1) return by_map;
    Stands by_rule = stands_of(shares_by_rule(point));
    float left = 1.0 - known;
    return Stands(by_map.needle + left * by_rule.needle, by_map.broad + left * by_rule.broad, by_map.open + left * by_rule.open);
}

// What of the sun's light falls on a closed canopy, which lies as its ground does: that on level ground is 1.
float sun_on_canopy(SurfacePoint point) {
    vec3 sun = sun_at(point.view);
    return sun_on_crowns(dot(steeper(point.normal, FRAME.style.relief), sun), sun.z);
}

// Of single trees, that have leaves: as the rule has forests.
float broad_share(SurfacePoint point) { return patched((1.9 * FRAME.style.cover.forest_m - above_snow_line_m(point)) / 220.0, 1.0); }

// Lower where they are few.
float size_at(SurfacePoint point, bool in_open, uint hash) {
    float size = size_of_trees(point);
    return in_open ? size * (0.3 + 0.5 * site_number(hash, 10u)) : size;
}

uint what_stands(uint hash, SitePlace place) {
    SurfacePoint point = ground_of(place);
    Stands stands = stands_at(place, point);
    float forest = stands.needle + stands.broad, number = site_number(hash, 11u);
    bool in_forest = number < forest;
    if (!in_forest && number >= forest + stands.open) return 0u;
    float needle = in_forest ? stands.needle / forest : 1.0 - broad_share(point);
    uint kind = site_number(hash, 12u) < needle ? site_needle : site_broad;
    // Where trees are left out the farther they are, the next of them are small already.
    float size = size_at(point, !in_forest, hash) * smoothstep(0.0, trees_grow_in, kept_rank(place) - site_rank(hash));
    uint size_code = uint(clamp(size, 0.0, 1.0) * 255.0 + 0.5);
    if (size_code < 20u) return 0u;
    float sun = sun_on_site(place, point, 0.6 * (size * tree_height_m(hash))) * (in_forest ? sun_on_canopy(point) : 1.0);
    uint sun_code = uint(sun / most_sun * 255.0 + 0.5);
    uint patch_code = uint((clamp(pixel_noise.patches / most_patch, -1.0, 1.0) + 1.0) * 127.0 + 0.5);
    return kind | (in_forest ? site_in_forest : 0u) | sun_code << site_sun_bit | size_code << site_size_bit | patch_code << site_patch_bit;
}

void main() {
    uint tile, site;
    if (!asked_site(tile, site)) return;
    GrowthTile of = GrowthTiles(GROWTH.tiles).at[tile];
    uint hash = hash_of_site(of, site);
    SitePlace place;
    place_of_site(of, site, hash, place);
    Words(GROWTH.sites).at[tile * sites_per_tile + site] = what_stands(hash, place);
}
