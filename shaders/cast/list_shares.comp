#version 460
// Which pixels have a line to the sun of their own in the second turn of shares.comp: all but those around which the first turn's pixels see
// all of the sun, or none of it. Those get what they see. With OTHER_GRIDS also the ground of other grids of the frame.
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/cast/casters.glsl"
#include "shaders/cast/share_list.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// A processor's driver stops and goes on at each barrier: there pixels are listed by squares of two by two. On a GPU by workgroups: where all
// ask for a place in one list they wait for each other.
layout(constant_id = 1) const bool by_group = false;

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

// Written by functions, as put(). The next places in the list, with room for them in the dispatch.
uint next_listed(uint count) {
    uint place = atomicAdd(Words(CASTERS.sun_shares).at[list_at() + count_at], count), at = list_at() + groups_at;
    uint groups = (place + count - 1u) / 64u + 1u;
    if (place % 64u != 0u && place / 64u + 1u == groups) return place;
    atomicMax(Words(CASTERS.sun_shares).at[at], min(groups, groups_per_row));
    if (groups > groups_per_row) atomicMax(Words(CASTERS.sun_shares).at[at + 1u], (groups + groups_per_row - 1u) / groups_per_row);
    return place;
}

// Of what may be read once for many pixels.
const int squares_across = 11;  // of a workgroup of eight by eight, and those beside them
shared uint kinds[squares_across * squares_across];
ivec2 first_square() { return ivec2(gl_WorkGroupID.xy) * 8 - 1; }
uint neighbour_kind(ivec2 square) {
    if (!by_group) return kind_at(square);
    ivec2 within = square - first_square();
    return kinds[within.y * squares_across + within.x];
}

// Which of a square's pixels (bits 0 to 3, row by row) do as those of the first turn that are within three pixels of them, three or four in a
// row and in a column, and all see the same. (Those within two pixels alone miss 1 % of made ground's shadows.)
uint as_around(ivec2 square) {
    uint kind = neighbour_kind(square), three = 0u, four = 0u;  // of each row: the first three, and all four
    if (kind == no_kind) return 0u;
    for (int row = 0; row < 4; ++row) {
        bool same = true;
        for (int column = 0; column < 3; ++column) same = same && neighbour_kind(square + ivec2(column, row) - 1) == kind;
        three |= same ? 1u << row : 0u;
        four |= same && neighbour_kind(square + ivec2(2, row - 1)) == kind ? 1u << row : 0u;
    }
    return ((four & 7u) == 7u ? 2u : 0u) | (three == 15u ? 4u : 0u) | (four == 15u ? 8u : 0u);
}

bool has_ground(ivec2 pixel) {
    uint id = id_at(pixel);
#ifdef OTHER_GRIDS
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

void main() {
    ivec2 square = ivec2(gl_GlobalInvocationID.xy);
    if (by_group) list_by_group(square);
    else list_by_square(square);
}
