#version 460
// Draws trees near the eye as the sun sees them: how near to it their first leaves are. A workgroup takes one (draw_crowns.comp).
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/air/air.glsl"
#include "shaders/air/sky.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/crown.glsl"
#include "shaders/growth/shade_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

void draw(Crown crown, mat3 axes) {
    ShadePlace foot = shade_place(crown.foot, axes), top = shade_place(crown.foot + crown.high_m * crown.axes[2], axes);
    float reach = crown.radius_m / shade_map_cell_m;
    ivec2 first = max(ivec2(floor(min(foot.cell, top.cell) - reach)), ivec2(0));
    ivec2 last = min(ivec2(ceil(max(foot.cell, top.cell) + reach)), ivec2(int(shade_map_side) - 1));
    for (int y = first.y + int(gl_LocalInvocationID.y); y <= last.y; y += int(gl_WorkGroupSize.y)) {
        for (int x = first.x + int(gl_LocalInvocationID.x); x <= last.x; x += int(gl_WorkGroupSize.x)) {
            vec2 at_m = (vec2(x, y) + 0.5 - 0.5 * float(shade_map_side)) * shade_map_cell_m;
            vec3 from = axes * vec3(at_m, foot.towards_m);
            CrownHit hit;
            if (!meets_crown(crown, from, -axes[2], shade_map_cell_m, -1.0e9, no_hit, hit)) continue;
            float towards_m = foot.towards_m - hit.depth_m + shade_map_base_m;
            if (towards_m > 0.0) atomicMax(Words(GROWTH.shade_map).at[uint(y) * shade_map_side + uint(x)], floatBitsToUint(towards_m));
        }
    }
}

void main() {
    uint site = ListsOfCrowns(GROWTH.lists).at.shades[gl_WorkGroupID.x];
    Crown crown;
    if (crown_of_site(site / sites_per_tile, site % sites_per_tile, crown)) draw(crown, shade_axes());
}
