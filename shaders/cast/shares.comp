#version 460
// How much of the sun the ground in each pixel sees. First in every second pixel of every second row, then in all: where those found
// before all around a pixel see all of the sun, or none of it, it does as they do, and elsewhere it has a line of its own. What that misses
// is narrower than two pixels, and alone. With OTHER_GRIDS also the ground of other grids of the frame, over this grid's terrain.
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
#include "shaders/cast/share_list.glsl"
#include "shaders/cast/shadow.glsl"
#include "shaders/cast/start.glsl"
#include "shaders/cast/smooth.glsl"
#include "shaders/cast/shown.glsl"
#ifdef OTHER_GRIDS
#include "shaders/cast/other_grids.glsl"
#else
#include "shaders/cast/over_terrain.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;
// What a program does. A processor's driver stops and goes on at each barrier, and makes each program anew in each process: there one has both
// turns. A GPU's have less to keep in registers each by itself.
const uint first_turn = 0u, second_turn = 1u, both_turns = 2u;
layout(constant_id = 1) const uint does = first_turn;

CastPoint own_point(uint id, ivec2 pixel) {
    vec2 clip = (vec2(pixel) + 0.5) * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    vec3 ray = vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
    uvec2 posts[3];
    vec3 at[3];
    float heights_m[3], scale;
    FramePage page = corners_of(triangle_of_id(id), posts, heights_m, at);
    vec2 shares = met_shares(ray, at, scale);
    SurfacePoint point;
    point.view = (1.0 - shares.x - shares.y) * at[0] + shares.x * at[1] + shares.y * at[2];
    point.post = place_on_page(page, triangle_of_id(id), posts, vec3(1.0 - shares.x - shares.y, shares));
    return cast_point(triangle_of_id(id), point);
}

float share_at(ivec2 pixel) {
    uint id = id_at(pixel);
#ifdef OTHER_GRIDS
    if (id == 0u) return no_sun_share;
    CastStart start;
    bool is_own = is_of_grid(id);
    if (!is_own) start = start_on_other_grid(CastPlaces(CasterList(FRAME.casters).at.places).at[pixel.y * int(FRAME.width_px) + pixel.x]);
    else if (!starts_on_ground(own_point(id, pixel), start)) return 1.0;
    return sun_from(start, is_own);
#else
    if (!is_of_grid(id)) return no_sun_share;
    CastStart start;
    return starts_on_ground(own_point(id, pixel), start) ? sun_over_terrain(start) : 1.0;
#endif
}

// The next pixel of the list; false behind its end.
bool is_listed(out ivec2 pixel) {
    uint number = folded(gl_WorkGroupID) * 64u + gl_LocalInvocationIndex;
    if (number >= Words(CASTERS.sun_shares).at[list_at() + count_at]) return false;
    uint listed = Words(CASTERS.sun_shares).at[list_at() + list_head + number];
    pixel = ivec2(listed % FRAME.width_px, listed / FRAME.width_px);
    return true;
}

void begin_list() {
    uvec4 head = uvec4(0u, 0u, 1u, 1u);
    for (uint i = 0u; i < list_head; ++i) put(list_at() + i, head[i]);
}

void main() {
    ivec2 square = ivec2(gl_GlobalInvocationID.xy), pixel = 2 * square;
    if (does == first_turn && square == ivec2(0)) begin_list();
    bool is_second = does == second_turn || (does == both_turns && Words(CASTERS.sun_shares).at[list_at() + count_at] != 0u);
    if (is_second && !is_listed(pixel)) return;
    if (is_in_picture(pixel)) keep(pixel, share_at(pixel));
}
