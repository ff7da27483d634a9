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
#include "shaders/cast/start.glsl"
#include "shaders/cast/smooth.glsl"
#include "shaders/cast/shown.glsl"
#ifdef BESIDE
#include "shaders/cast/beside.glsl"
#else
#include "shaders/cast/over_terrain.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
// What a program does. A processor's driver stops and goes on at each barrier: there one has both turns, and another, which only lists the
// pixels that need lines, runs between. A GPU's have less to keep in registers each by itself, and list by workgroups: where all pixels ask
// for a place in one list they wait for each other.
const uint first_turn = 0u, second_turn = 1u, both_turns = 2u, lists_by_square = 3u, lists_by_group = 4u;
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

uint id_at(ivec2 pixel) {
    return from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]) : imageLoad(ids, pixel).x;
}

float share_at(ivec2 pixel) {
    uint id = id_at(pixel);
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

// What a share of the first turn tells of the pixels around it: all of the sun is seen, or none, or that cannot be said.
const uint no_kind = 3u;
uint kind_of(float kept) {
    float share = without_light(vec4(kept)).x;
    return share == 0.0 ? 0u : share == 1.0 ? 1u : share == turned_share ? 2u : no_kind;
}
// The first turn's pixel of a square of two by two; outside of the picture there is none.
uint kind_at(ivec2 square) {
    ivec2 pixel = 2 * square;
    bool within = all(greaterThanEqual(pixel, ivec2(0))) && pixel.x < int(FRAME.width_px) && pixel.y < int(FRAME.height_px);
    return within ? kind_of(CasterShares(CASTERS.sun_shares).at[pixel.y * int(FRAME.width_px) + pixel.x]) : no_kind;
}

// Behind the shares: how many pixels the second turn lists (none before it), and the workgroups of its dispatch; then the pixels.
const uint list_head = 4u, count_at = 0u, groups_at = 1u;
uint list_at() { return (FRAME.width_px * FRAME.height_px + 3u) / 4u * 4u; }

bool is_in_picture(ivec2 pixel) { return pixel.x < int(FRAME.width_px) && pixel.y < int(FRAME.height_px); }

// Written by functions, as keep(). The next places in the list, with room for them in the dispatch.
uint next_listed(uint count) {
    uint place = atomicAdd(Words(CASTERS.sun_shares).at[list_at() + count_at], count), at = list_at() + groups_at;
    uint groups = (place + count - 1u) / 64u + 1u;
    if (place % 64u != 0u && place / 64u + 1u == groups) return place;
    atomicMax(Words(CASTERS.sun_shares).at[at], min(groups, groups_per_row));
    if (groups > groups_per_row) atomicMax(Words(CASTERS.sun_shares).at[at + 1u], (groups + groups_per_row - 1u) / groups_per_row);
    return place;
}
void put(uint at, uint value) { Words(CASTERS.sun_shares).at[at] = value; }

// Of what may be read once for many pixels.
const int squares_across = 11;  // of a workgroup of eight by eight, and those beside them
shared uint kinds[squares_across * squares_across];
ivec2 first_square() { return ivec2(gl_WorkGroupID.xy) * 8 - 1; }
uint kind_beside(ivec2 square) {
    if (does != lists_by_group) return kind_at(square);
    ivec2 within = square - first_square();
    return kinds[within.y * squares_across + within.x];
}

// Which of a square's pixels (bits 0 to 3, row by row) do as those of the first turn that are within three pixels of them, three or four in a
// row and in a column, and all see the same. (Those within two pixels alone miss 1 % of made ground's shadows.)
uint as_around(ivec2 square) {
    uint kind = kind_beside(square), three = 0u, four = 0u;  // of each row: the first three, and all four
    if (kind == no_kind) return 0u;
    for (int row = 0; row < 4; ++row) {
        bool same = true;
        for (int column = 0; column < 3; ++column) same = same && kind_beside(square + ivec2(column, row) - 1) == kind;
        three |= same ? 1u << row : 0u;
        four |= same && kind_beside(square + ivec2(2, row - 1)) == kind ? 1u << row : 0u;
    }
    return ((four & 7u) == 7u ? 2u : 0u) | (three == 15u ? 4u : 0u) | (four == 15u ? 8u : 0u);
}

bool has_ground(ivec2 pixel) {
    uint id = id_at(pixel);
#ifdef BESIDE
    return id != 0u;
#else
    return is_of_grid(id);
#endif
}

// Which of a square's pixels need lines; the others get what they see.
uint need_lines(ivec2 square) {
    ivec2 first = 2 * square;
    if (!is_in_picture(first)) return 0u;
    uint as = as_around(square), need = 0u;
    for (uint i = 1u; i < 4u; ++i) {
        ivec2 pixel = first + ivec2(i & 1u, i >> 1u);
        if (!is_in_picture(pixel)) continue;
        if (!has_ground(pixel)) keep(pixel, no_sun_share);
        else if ((as >> i & 1u) != 0u) keep(pixel, CasterShares(CASTERS.sun_shares).at[first.y * int(FRAME.width_px) + first.x]);
        else need |= 1u << i;
    }
    return need;
}

// From a place in the list on.
void list_pixels(ivec2 square, uint need, uint place) {
    for (uint i = 1u; i < 4u; ++i) {
        uvec2 pixel = uvec2(2 * square) + uvec2(i & 1u, i >> 1u);
        if ((need >> i & 1u) != 0u) put(list_at() + list_head + place++, pixel.y * FRAME.width_px + pixel.x);
    }
}
void list_by_square(ivec2 square) {
    uint need = need_lines(square);
    if (need != 0u) list_pixels(square, need, next_listed(uint(bitCount(need))));
}

// The next pixel of the list; false behind its end.
bool is_listed(out ivec2 pixel) {
    uint number = folded(gl_WorkGroupID) * 64u + gl_LocalInvocationIndex;
    if (number >= Words(CASTERS.sun_shares).at[list_at() + count_at]) return false;
    uint listed = Words(CASTERS.sun_shares).at[list_at() + list_head + number];
    pixel = ivec2(listed % FRAME.width_px, listed / FRAME.width_px);
    return true;
}

// A workgroup's places follow each other.
shared uint list_count, list_first;
void list_by_group(ivec2 square) {
    uint lane = gl_LocalInvocationIndex, within = 0u;
    if (lane == 0u) list_count = 0u;
    for (int i = int(lane); i < squares_across * squares_across; i += 64) kinds[i] = kind_at(first_square() + ivec2(i % squares_across, i / squares_across));
    barrier();
    uint need = need_lines(square);
    if (need != 0u) within = atomicAdd(list_count, uint(bitCount(need)));
    barrier();
    if (lane == 0u && list_count > 0u) list_first = next_listed(list_count);
    barrier();
    if (need != 0u) list_pixels(square, need, list_first + within);
}

void begin_list() {
    uvec4 head = uvec4(0u, 0u, 1u, 1u);
    for (uint i = 0u; i < list_head; ++i) put(list_at() + i, head[i]);
}

void main() {
    ivec2 square = ivec2(gl_GlobalInvocationID.xy), pixel = 2 * square;
    if (does == lists_by_square) {
        list_by_square(square);
        return;
    }
    if (does == lists_by_group) {
        list_by_group(square);
        return;
    }
    if (does == first_turn && square == ivec2(0)) begin_list();
    bool is_second = does == second_turn || (does == both_turns && Words(CASTERS.sun_shares).at[list_at() + count_at] != 0u);
    if (is_second && !is_listed(pixel)) return;
    if (is_in_picture(pixel)) keep(pixel, share_at(pixel));
}
