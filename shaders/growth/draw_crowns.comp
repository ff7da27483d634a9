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
#include "shaders/growth/growth.glsl"
#include "shaders/growth/crown.glsl"
#include "shaders/growth/crown_pixels.glsl"

layout(local_size_x = 128) in;  // site_group

const int alone_px = 256;

// False where the list has no room; whoever finds none gives its place back, so that the list's number is right in the end.
bool list_piece(uint site, int piece) {
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    uint at = atomicAdd(lists.at.piece_groups[0], 1u);
    if (at < crown_list_max) lists.at.pieces[at] = uvec2(site, uint(piece));
    else atomicAdd(lists.at.piece_groups[0], 0xffffffffu);
    return at < crown_list_max;
}

void draw(Crown crown, CrownPixels of, ivec4 box) {
    for (int y = box.y; y <= box.w; ++y)
        for (int x = box.x; x <= box.z; ++x) draw_pixel(crown, of, ivec2(x, y));
}

void draw_pieces(Crown crown, CrownPixels of, uint site) {
    ivec2 count = (of.box.zw - of.box.xy) / int(crown_piece_px) + 1;
    for (int piece = 0; piece < count.x * count.y; ++piece) {
        ivec2 first = of.box.xy + ivec2(piece % count.x, piece / count.x) * int(crown_piece_px);
        ivec4 box = ivec4(first, min(first + int(crown_piece_px) - 1, of.box.zw));
        if (!is_behind_ground(box, of.nearest) && !list_piece(site, piece)) draw(crown, of, box);
    }
}

// There are fewer sites within reach of the map than the list has room for.
void list_shade(uint site) {
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    uint at = atomicAdd(lists.at.shade_groups[0], 1u);
    if (at < crown_list_max) lists.at.shades[at] = site;
}

void main() {
    uint group = folded(gl_WorkGroupID), tile = group / site_groups_per_tile;
    if (tile >= GROWTH.tile_count) return;
    uint site = group % site_groups_per_tile * site_group + gl_LocalInvocationIndex;
    Crown crown;
    if (!crown_of_site(tile, site, crown)) return;
    if (GROWTH.shade_map != uvec2(0u) && length(crown.foot) < shade_map_reach_m + 40.0) list_shade(tile * sites_per_tile + site);
    CrownPixels of = crown_pixels(crown, tile, site);
    if (is_empty(of.box) || is_behind_ground(of.box, of.nearest)) return;
    ivec2 size = of.box.zw - of.box.xy + 1;
    if (size.x * size.y > alone_px) draw_pieces(crown, of, tile * sites_per_tile + site);
    else draw(crown, of, of.box);
}
