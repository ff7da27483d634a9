#version 460
// How much of the sun the ground in each pixel sees. First in every second pixel of every second row, then in all: where those found
// before all around a pixel see all of the sun, or none of it, it does as they do, and elsewhere it has a line of its own. What that misses
// is narrower than two pixels, and alone. With BESIDE also the ground of other grids of the frame, over this grid's terrain.
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
#ifdef BESIDE
#include "shaders/cast/beside.glsl"
#else
#include "shaders/cast/over_terrain.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
// The first turn; the second, a workgroup by itself; the second as two passes for the whole picture, the first of which only lists what needs
// lines. A GPU's workgroups get in each other's way where they list together, and a processor's driver stops and goes on at each barrier.
const uint first_turn = 0u, second_turn = 1u, both_turns = 2u, lists_second_turn = 3u;
layout(constant_id = 1) const uint does = first_turn;
layout(binding = 0, r32ui) uniform readonly uimage2D ids;

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
    uint id = from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])
                           : imageLoad(ids, pixel).x;
#ifdef BESIDE
    if (id == 0u) return no_sun_share;
    CastStart start;
    bool is_own = is_of_grid(id);
    if (!is_own) start = start_beside(CastPlaces(CasterList(FRAME.casters).at.places).at[pixel.y * int(FRAME.width_px) + pixel.x]);
    else if (!starts_on_ground(own_point(id, pixel), start)) return 1.0;
    return sun_from(start, is_own);
#else
    if (!is_of_grid(id)) return no_sun_share;
    CastStart start;
    return starts_on_ground(own_point(id, pixel), start) ? sun_over_terrain(start) : 1.0;
#endif
}

// Written by a function: glslang 12.0 does not end on such an assignment in main().
void keep(ivec2 pixel, float share) { CasterShares(CASTERS.sun_shares).at[pixel.y * int(FRAME.width_px) + pixel.x] = share; }

// The share that those of the first turn have that are within three pixels of one, three or four in a row and in a column; no_sun_share
// where they differ. All are asked for at once. (Those within two pixels alone miss 1 % of made ground's shadows.)
float share_around(ivec2 pixel) {
    ivec2 first = (pixel / 2 - 1) * 2, last = (pixel + 1) / 2 * 2 + 2;
    if (any(lessThan(first, ivec2(0))) || last.x >= int(FRAME.width_px) || last.y >= int(FRAME.height_px)) return no_sun_share;
    CasterShares shares = CasterShares(CASTERS.sun_shares);
    ivec4 rows = min(ivec4(0, 2, 4, 6) + first.y, ivec4(last.y)) * int(FRAME.width_px), at = min(ivec4(0, 2, 4, 6) + first.x, ivec4(last.x));
    vec4 a = vec4(shares.at[rows.x + at.x], shares.at[rows.x + at.y], shares.at[rows.x + at.z], shares.at[rows.x + at.w]);
    vec4 b = vec4(shares.at[rows.y + at.x], shares.at[rows.y + at.y], shares.at[rows.y + at.z], shares.at[rows.y + at.w]);
    vec4 c = vec4(shares.at[rows.z + at.x], shares.at[rows.z + at.y], shares.at[rows.z + at.z], shares.at[rows.z + at.w]);
    vec4 d = vec4(shares.at[rows.w + at.x], shares.at[rows.w + at.y], shares.at[rows.w + at.z], shares.at[rows.w + at.w]);
    float share = without_light(a).x;
    bool is_whole = share == 0.0 || share == 1.0 || share == turned_share;
    vec4 all = vec4(share);
    bool is_one = without_light(a) == all && without_light(b) == all && without_light(c) == all && without_light(d) == all;
    return is_whole && is_one ? a.x : no_sun_share;
}

// Behind the shares: how many pixels the second turn lists (none before it), and the workgroups of its dispatch; then the pixels.
const uint list_head = 4u, count_at = 0u, groups_at = 1u;
uint list_at() { return (FRAME.width_px * FRAME.height_px + 3u) / 4u * 4u; }

bool is_in_picture(ivec2 pixel) { return pixel.x < int(FRAME.width_px) && pixel.y < int(FRAME.height_px); }

// Written by functions, as keep(). The next place in the list, with room for it in the dispatch.
uint next_listed() {
    uint place = atomicAdd(Words(CASTERS.sun_shares).at[list_at() + count_at], 1u), groups = place / 64u + 1u, at = list_at() + groups_at;
    if (place % 64u != 0u) return place;
    atomicMax(Words(CASTERS.sun_shares).at[at], min(groups, groups_per_row));
    if (groups > groups_per_row) atomicMax(Words(CASTERS.sun_shares).at[at + 1u], (groups + groups_per_row - 1u) / groups_per_row);
    return place;
}
void put(uint at, uint value) { Words(CASTERS.sun_shares).at[at] = value; }

bool needs_line(ivec2 pixel) {
    bool had_its_turn = ((pixel.x | pixel.y) & 1) == 0;
    if (had_its_turn || !is_in_picture(pixel)) return false;
    float share = share_around(pixel);
    if (share != no_sun_share) keep(pixel, share);
    return share == no_sun_share;
}

void list_in_picture(ivec2 pixel) {
    if (!needs_line(pixel)) return;
    put(list_at() + list_head + next_listed(), uint(pixel.y) * FRAME.width_px + uint(pixel.x));
}
// The next pixel of the list; false behind its end.
bool is_listed_in_picture(out ivec2 pixel) {
    uint number = folded(gl_WorkGroupID) * 64u + gl_LocalInvocationIndex;
    if (number >= Words(CASTERS.sun_shares).at[list_at() + count_at]) return false;
    uint listed = Words(CASTERS.sun_shares).at[list_at() + list_head + number];
    pixel = ivec2(listed % FRAME.width_px, listed / FRAME.width_px);
    return true;
}

// The pixels of a workgroup's square that need lines of their own, one after the other, so that whole subgroups have none.
shared uint list_count;
shared uint list[gl_WorkGroupSize.x * gl_WorkGroupSize.y];
bool is_listed_in_square(out ivec2 pixel) {
    if (gl_LocalInvocationIndex == 0u) list_count = 0u;
    barrier();
    if (needs_line(ivec2(gl_GlobalInvocationID.xy))) list[atomicAdd(list_count, 1u)] = gl_LocalInvocationIndex;
    barrier();
    if (gl_LocalInvocationIndex >= list_count) return false;
    uint within = list[gl_LocalInvocationIndex];
    pixel = ivec2(gl_WorkGroupID.xy * gl_WorkGroupSize.xy + uvec2(within % gl_WorkGroupSize.x, within / gl_WorkGroupSize.x));
    return true;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy) * 2;
    if (does == lists_second_turn) {
        list_in_picture(ivec2(gl_GlobalInvocationID.xy));
        return;
    }
    bool is_second = does == both_turns && Words(CASTERS.sun_shares).at[list_at() + count_at] != 0u;
    if (does == second_turn && !is_listed_in_square(pixel)) return;
    if (is_second && !is_listed_in_picture(pixel)) return;
    if (is_in_picture(pixel)) keep(pixel, share_at(pixel));
}
