#version 460
// Lists the sites whose tree, or its shadow, may be in the picture, by where they are alone: what stands there is dear to find out, and is
// asked of these (grow_sites.comp).
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/kept_rank.glsl"

layout(local_size_x = 128) in;  // site_group

bool may_show(SitePlace place) {
    float distance_m = length(place.view);
    if (distance_m > GROWTH.reach_m || distance_m < 3.0) return false;
    float tall = max(FRAME.exaggeration, 1.0);
    vec3 middle = place.view + 15.0 * tall * normalize(place.view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    // Near the eye those beside the picture, too: their shadows may be in it.
    float w = -middle.z, reach_m = tall * (distance_m < shade_map_reach_m ? 80.0 : 24.0);
    if (w < -reach_m) return false;
    vec2 side = FRAME.projection_scale * middle.xy + FRAME.projection_shift * w, slack = reach_m * (abs(FRAME.projection_scale) + 1.0 + abs(FRAME.projection_shift));
    return all(lessThanEqual(abs(side), vec2(w) + slack));
}

// Whether neither the largest tree there nor its shadow is seen.
bool is_hidden(SitePlace place) {
    // With what it leans; broad-leaved ones that stand alone are the widest.
    float tallest_m = 33.0 * FRAME.exaggeration, widest_m = 11.5 + 0.1 * tallest_m;
    if (length(place.view) < shade_map_reach_m + 40.0) return false;
    vec3 up = normalize(place.view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view), top = place.view + tallest_m * up;
    ivec4 box = pixels_around(place.view, top, widest_m);
    return is_empty(box) || is_behind_ground(box, nearest_depth(place.view, top, widest_m));
}

// Whether a tree there may be in the picture, or its shadow.
bool may_stand(GrowthTile tile, uint site, out SitePlace place) {
    uint hash = hash_of_site(tile, site);
    float rank = site_rank(hash);
    return rank < stocked_sites && place_of_site(tile, site, hash, place) && may_show(place) && !is_hidden(place) && rank < kept_rank(place);
}

shared uint count;
shared uint first;  // of the group's, in the list
shared uint found[site_group];

void lengthen_list() {
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    first = atomicAdd(lists.at.asked_count, count);
    uint groups = (first + count + site_group - 1u) / site_group;
    atomicMax(lists.at.site_groups[0], min(groups, groups_per_row));
    atomicMax(lists.at.site_groups[1], (groups + groups_per_row - 1u) / groups_per_row);
}

void main() {
    uint group = folded(gl_WorkGroupID), tile = group / site_groups_per_tile;
    if (tile >= GROWTH.tile_count) return;
    if (gl_LocalInvocationIndex == 0u) count = 0u;
    barrier();
    uint site = site_of_group(group % site_groups_per_tile, gl_LocalInvocationIndex);
    SitePlace place;
    if (may_stand(GrowthTiles(GROWTH.tiles).at[tile], site, place)) found[atomicAdd(count, 1u)] = tile * sites_per_tile + site;
    barrier();
    if (gl_LocalInvocationIndex == 0u && count > 0u) lengthen_list();
    barrier();
    if (gl_LocalInvocationIndex < count) Words(GROWTH.asked).at[first + gl_LocalInvocationIndex] = found[gl_LocalInvocationIndex];
}
