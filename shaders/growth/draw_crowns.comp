#version 460
// Draws trees: an invocation takes a site. Those that cover many pixels are left to draw_large_crowns.comp, piece by piece; those whose
// shadows may be seen to draw_shade_map.comp. Pixels by rays, so that silhouettes are exact.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/air/air.glsl"
#include "shaders/air/sky.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/crown.glsl"
#include "shaders/growth/crown_pixels.glsl"
#include "shaders/growth/shade_map.glsl"

layout(local_size_x = 128) in;  // site_group

const int alone_px = 256;

bool is_seen_piece(CrownPixels of, int piece, int across, int side) {
    ivec2 first = of.box.xy + ivec2(piece % across, piece / across) * side;
    return !is_behind_ground(ivec4(first, min(first + side - 1, of.box.zw)), of.nearest);
}

// False where the list has no room for all of them. Whoever finds none gives its places back, so that the list's number is right in the end.
bool list_pieces(CrownPixels of, uint site) {
    int side = piece_px(of);
    ivec2 count = (of.box.zw - of.box.xy) / side + 1;
    uint seen = 0u;
    for (int piece = 0; piece < count.x * count.y; ++piece) seen += is_seen_piece(of, piece, count.x, side) ? 1u : 0u;
    if (seen == 0u) return true;
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    uint at = atomicAdd(lists.at.piece_count, seen), asked_end = at + seen, end = min(asked_end, crown_piece_max);
    if (asked_end > end) atomicAdd(lists.at.piece_count, max(at, end) - asked_end);
    if (at >= end) return false;
    for (int piece = 0; at < end; ++piece)
        if (is_seen_piece(of, piece, count.x, side)) lists.at.pieces[at++] = uvec2(site, uint(piece));
    atomicMax(lists.at.piece_groups[0], min(end, groups_per_row));
    atomicMax(lists.at.piece_groups[1], (end + groups_per_row - 1u) / groups_per_row);
    return asked_end == end;
}

// Whether a crown may shade a place that the picture shows: one within the map's reach, and so not farther from it than both reach.
bool may_shade(Crown crown) {
    if (length(crown.foot) >= shade_map_reach_m + 40.0) return false;
    vec3 middle = crown.foot + 0.5 * crown.high_m * crown.axes[2];
    const float beside_m = 3.0;  // blades of a clump, and cells
    return !is_beside_picture(middle, middle - (2.0 * shade_map_reach_m + 80.0) * sun_in_view(), 0.5 * crown.high_m + crown.radius_m + beside_m);
}

// There are fewer sites within reach of the map than the list has room for.
void list_shade(uint site) {
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    uint at = atomicAdd(lists.at.shade_groups[0], 1u);
    if (at < crown_list_max) lists.at.shades[at] = site;
}

// Crowns of a workgroup that are not left to others: its invocations share their pixels, however many each has.
shared uint crown_count;
shared Crown crowns[site_group];
shared uvec2 boxes[site_group];  // x | y << 16 of their first pixel, pixels across | down << 16
shared uint ids[site_group];
shared uint ends[site_group];  // of its pixels, among those of all crowns

void add_crown(uint tile, uint site) {
    Crown crown;
    if (!crown_of_site(tile, site, crown)) return;
    if (GROWTH.shade_map != uvec2(0u) && may_shade(crown)) list_shade(tile * sites_per_tile + site);
    CrownPixels of = crown_pixels(crown, tile, site);
    if (is_empty(of.box) || is_behind_ground(of.box, of.nearest)) return;
    ivec2 size = of.box.zw - of.box.xy + 1;
    if (size.x * size.y > alone_px && list_pieces(of, tile * sites_per_tile + site)) return;
    uint at = atomicAdd(crown_count, 1u);
    crowns[at] = crown;
    boxes[at] = uvec2(of.box.x | of.box.y << 16, size.x | size.y << 16);
    ids[at] = of.id;
    ends[at] = uint(size.x * size.y);
}

// From numbers of pixels to ends.
void sum_pixels() {
    uint own = gl_LocalInvocationIndex;
    for (uint step = 1u; step < crown_count; step *= 2u) {
        uint before = own >= step && own < crown_count ? ends[own - step] : 0u;
        barrier();
        if (own < crown_count) ends[own] += before;
        barrier();
    }
}

// The first crown that ends beyond a pixel.
uint crown_of_pixel(uint pixel) {
    uint first = 0u, last = crown_count - 1u;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (ends[middle] > pixel) last = middle;
        else first = middle + 1u;
    }
    return first;
}

void draw_crowns() {
    uint count = crown_count == 0u ? 0u : ends[crown_count - 1u];
    for (uint pixel = gl_LocalInvocationIndex; pixel < count; pixel += site_group) {
        uint at = crown_of_pixel(pixel);
        Crown crown = crowns[at];
        vec3 top = crown.foot + crown.high_m * crown.axes[2];
        ivec2 first = ivec2(boxes[at].x & 0xffffu, boxes[at].x >> 16), size = ivec2(boxes[at].y & 0xffffu, boxes[at].y >> 16);
        CrownPixels of = CrownPixels(ivec4(first, first + size - 1), pixel_m_at(crown.foot), nearest_depth(crown.foot, top, crown.radius_m), ids[at]);
        int number = int(pixel - (at == 0u ? 0u : ends[at - 1u]));
        draw_pixel(crown, of, first + ivec2(number % size.x, number / size.x));
    }
}

void main() {
    if (gl_LocalInvocationIndex == 0u) crown_count = 0u;
    barrier();
    uint tile, site;
    if (asked_site(tile, site)) add_crown(tile, site);
    barrier();
    sum_pixels();
    draw_crowns();
}
