#version 460
// How much of the sun the ground in each pixel sees. First in every second pixel of every second row, then in all: where those found
// before all around a pixel see all of the sun, or none of it, it does as they do, and elsewhere it has a line of its own. What that misses
// is narrower than two pixels, and alone.
#extension GL_GOOGLE_include_directive : require
const bool as_map = false;
const bool in_air = false;
const bool draped = false;
const bool by_means = false;
const bool parts_follow = false;
const bool parts_alone = false;
const bool casts = true;
const bool opens = false;
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/surface.glsl"
#include "shaders/air/air.glsl"
#include "shaders/cast/casters.glsl"
#include "shaders/cast/shadow.glsl"
#include "shaders/cast/shown.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(constant_id = 1) const int apart_px = 2;  // of the pixels of this turn: 2, then 1
layout(binding = 0, r32ui) uniform readonly uimage2D ids;

float share_at(ivec2 pixel) {
    uint id = from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])
                           : imageLoad(ids, pixel).x;
    if (!is_of_grid(id)) return no_sun_share;
    vec2 clip = (vec2(pixel) + 0.5) * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    vec3 ray = vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
    uvec2 posts[3];
    vec3 at[3];
    float heights_m[3], scale;
    corners_of(triangle_of_id(id), posts, heights_m, at);
    vec2 shares = met_shares(ray, at, scale);
    SurfacePoint point;
    point.view = (1.0 - shares.x - shares.y) * at[0] + shares.x * at[1] + shares.y * at[2];
    point.post = (1.0 - shares.x - shares.y) * vec2(posts[0]) + shares.x * vec2(posts[1]) + shares.y * vec2(posts[2]);
    return sun_over_terrain(cast_point(triangle_of_id(id), point));
}

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(ivec2 pixel, float share) { CasterShares(CASTERS.sun_shares).at[pixel.y * int(FRAME.width_px) + pixel.x] = share; }

// The share that all pixels of the turn before around one have, three or four in a row and in a column; no_sun_share where they differ.
float share_around(ivec2 pixel) {
    const int step_px = 2 * apart_px;
    ivec2 first = (pixel / step_px - 1) * step_px, last = (pixel + step_px - 1) / step_px * step_px + step_px;
    if (any(lessThan(first, ivec2(0))) || last.x >= int(FRAME.width_px) || last.y >= int(FRAME.height_px)) return no_sun_share;
    CasterShares shares = CasterShares(CASTERS.sun_shares);
    float share = shares.at[first.y * int(FRAME.width_px) + first.x];
    if (share != 0.0 && share != 1.0) return no_sun_share;
    for (int y = first.y; y <= last.y; y += step_px)
        for (int x = first.x; x <= last.x; x += step_px)
            if (shares.at[y * int(FRAME.width_px) + x] != share) return no_sun_share;
    return share;
}

// The pixels of a workgroup's square that need lines of their own, one after the other, so that whole subgroups have none.
shared uint list_count;
shared uint list[gl_WorkGroupSize.x * gl_WorkGroupSize.y];

void list_pixel(ivec2 pixel) {
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    bool had_its_turn = apart_px < 2 && ((pixel.x | pixel.y) & (2 * apart_px - 1)) == 0;
    if (had_its_turn) return;
    float share = apart_px < 2 ? share_around(pixel) : no_sun_share;
    if (share == no_sun_share) list[atomicAdd(list_count, 1u)] = gl_LocalInvocationIndex;
    else keep(pixel, share);
}

void main() {
    if (gl_LocalInvocationIndex == 0u) list_count = 0u;
    barrier();
    list_pixel(ivec2(gl_GlobalInvocationID.xy) * apart_px);
    barrier();
    if (gl_LocalInvocationIndex >= list_count) return;
    uint within = list[gl_LocalInvocationIndex];
    ivec2 pixel = ivec2(gl_WorkGroupID.xy * gl_WorkGroupSize.xy + uvec2(within % gl_WorkGroupSize.x, within / gl_WorkGroupSize.x)) * apart_px;
    keep(pixel, share_at(pixel));
}
