#version 460
// Draws trees: an invocation takes a site. Those that cover many pixels are left to draw_large_crowns.comp, piece by piece, the nearest
// first (sort_pieces.comp); those whose shadows may be seen to draw_shade_map.comp. Pixels by rays, so that silhouettes are exact.
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
#include "shaders/growth/crown_bounds.glsl"
#include "shaders/growth/large_crown.glsl"
#include "shaders/growth/crown_steps.glsl"
#include "shaders/growth/shade_map.glsl"

layout(local_size_x = 128) in;  // site_group

const int alone_px = 256;

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

// The crowns of a workgroup that are in the picture. Its invocations share their pieces, or their pixels, however many each has.
shared uint crown_count;
shared Crown crowns[site_group];
shared uvec2 boxes[site_group];  // x | y << 16 of their first pixel, pixels across | down << 16
shared float begins_m[site_group];
shared uint ids[site_group];
shared uint numbers[site_group];  // of those that cover many pixels, in the list of these
shared uint stays[site_group];    // 1: drawn by this workgroup
shared uint ends[site_group];     // of its pieces, or pixels, among those of all crowns
shared uint large_count;
shared uint first_large;
shared uint found_count;
shared uint first_found;
shared uint steps[crown_step_count];

CrownPixels pixels_at(uint at) {
    ivec2 first = ivec2(boxes[at].x & 0xffffu, boxes[at].x >> 16), size = ivec2(boxes[at].y & 0xffffu, boxes[at].y >> 16);
    return CrownPixels(ivec4(first, first + size - 1), pixel_m_at(crowns[at].foot), begins_m[at], ids[at]);
}

void add_crown(uint tile, uint site) {
    Crown crown;
    if (!crown_of_site(tile, site, crown)) return;
    if (GROWTH.shade_map != uvec2(0u) && may_shade(crown)) list_shade(tile * sites_per_tile + site);
    ivec4 box = pixels_of_crown(crown);
    if (is_empty(box)) return;
    float begins = begins_before_eye(crown);
    if (is_behind_ground(box, largest_depth(CrownPixels(box, 0.0, begins, 0u)))) return;
    ivec2 size = box.zw - box.xy + 1;
    uint at = atomicAdd(crown_count, 1u);
    crowns[at] = crown;
    boxes[at] = uvec2(box.x | box.y << 16, size.x | size.y << 16);
    begins_m[at] = begins;
    ids[at] = id_of_site(tile, site);
    // Of a picture so large that a number has no room for a piece's none is made.
    stays[at] = size.x * size.y > alone_px && piece_count_of(box) <= 1u << crown_piece_bits ? 0u : 1u;
    if (stays[at] == 0u) numbers[at] = atomicAdd(large_count, 1u);
}

// From numbers of pieces, or pixels, to ends.
uint sum_ends() {
    uint own = gl_LocalInvocationIndex;
    for (uint step = 1u; step < crown_count; step *= 2u) {
        barrier();
        uint before = own >= step && own < crown_count ? ends[own - step] : 0u;
        barrier();
        if (own < crown_count) ends[own] += before;
    }
    barrier();
    return crown_count == 0u ? 0u : ends[crown_count - 1u];
}

// The first crown that ends beyond a piece, or a pixel.
uint crown_at_end(uint number) {
    uint first = 0u, last = crown_count - 1u;
    while (first < last) {
        uint middle = (first + last) / 2u;
        if (ends[middle] > number) last = middle;
        else first = middle + 1u;
    }
    return first;
}

// Crowns that cover many pixels into their list. Those that have no room there stay with this workgroup.
void list_large_crowns() {
    uint own = gl_LocalInvocationIndex;
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    if (own == 0u && large_count > 0u) first_large = atomicAdd(lists.at.crown_count, large_count);
    barrier();
    if (own >= crown_count) return;
    ends[own] = 0u;
    if (stays[own] == 1u) return;
    numbers[own] += first_large;
    if (numbers[own] >= large_crown_max) {
        stays[own] = 1u;
        return;
    }
    CrownPixels of = pixels_at(own);
    lists.at.crowns[numbers[own]] = as_large(crowns[own], of);
    ends[own] = piece_count_of(of.box);
}

// A piece of this workgroup's crowns.
struct FoundPiece {
    uint at;  // of its crown
    uint number;
};
FoundPiece piece_at(uint number) {
    uint at = crown_at_end(number);
    return FoundPiece(at, number - (at == 0u ? 0u : ends[at - 1u]));
}
bool is_seen(FoundPiece piece) {
    CrownPixels of = pixels_at(piece.at);
    ivec4 box = piece_of(of.box, piece.number);
    return !is_behind_ground(box, largest_depth(of)) && may_show_crown(crowns[piece.at], box);
}

void lengthen_list() {
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    first_found = atomicAdd(lists.at.piece_count, found_count);
    uint end = min(first_found + found_count, crown_piece_max);
    atomicMax(lists.at.piece_groups[0], min(end, groups_per_row));
    atomicMax(lists.at.piece_groups[1], (end + groups_per_row - 1u) / groups_per_row);
    atomicMax(lists.at.sort_groups[0], (end + sorted_by_group - 1u) / sorted_by_group);
}

// A crown some of whose pieces have no room in the list stays with this workgroup: who draws a pixel twice draws the same.
void list_piece(FoundPiece piece, uint place) {
    if (place >= crown_piece_max) {
        stays[piece.at] = 1u;
        return;
    }
    ListsOfCrowns(GROWTH.lists).at.found[place] = numbers[piece.at] << crown_piece_bits | piece.number;
    atomicAdd(steps[step_at(begins_m[piece.at])], 1u);
}

// An invocation takes 32 pieces at a time, as many as a word has bits.
void list_pieces() {
    uint own = gl_LocalInvocationIndex, count = sum_ends();
    for (uint first = own; first - own < count; first += 32u * site_group) {
        if (own == 0u) found_count = 0u;
        barrier();
        uint seen = 0u, place = 0u;
        for (uint i = 0u; i < 32u && first + i * site_group < count; ++i) seen |= is_seen(piece_at(first + i * site_group)) ? 1u << i : 0u;
        if (seen != 0u) place = atomicAdd(found_count, uint(bitCount(seen)));
        barrier();
        if (own == 0u && found_count > 0u) lengthen_list();
        barrier();
        for (; seen != 0u; seen &= seen - 1u) list_piece(piece_at(first + uint(findLSB(seen)) * site_group), first_found + place++);
    }
    barrier();
    if (own < crown_step_count && steps[own] > 0u) atomicAdd(ListsOfCrowns(GROWTH.lists).at.pieces_at[own], steps[own]);
}

void draw_crowns() {
    uint own = gl_LocalInvocationIndex;
    if (own < crown_count) ends[own] = stays[own] == 1u ? (boxes[own].y & 0xffffu) * (boxes[own].y >> 16) : 0u;
    uint count = sum_ends();
    for (uint pixel = own; pixel < count; pixel += site_group) {
        uint at = crown_at_end(pixel);
        CrownPixels of = pixels_at(at);
        int number = int(pixel - (at == 0u ? 0u : ends[at - 1u])), across = of.box.z - of.box.x + 1;
        draw_pixel(crowns[at], of, of.box.xy + ivec2(number % across, number / across));
    }
}

void main() {
    if (gl_LocalInvocationIndex == 0u) crown_count = large_count = 0u;
    if (gl_LocalInvocationIndex < crown_step_count) steps[gl_LocalInvocationIndex] = 0u;
    barrier();
    uint tile, site;
    if (asked_site(tile, site)) add_crown(tile, site);
    barrier();
    list_large_crowns();
    barrier();
    list_pieces();
    barrier();
    draw_crowns();
}
