#version 460
// Draws a piece of a crown that covers many pixels: a workgroup takes one (draw_crowns.comp).
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

layout(local_size_x = 8, local_size_y = 16) in;

void main() {
    uint number = folded(gl_WorkGroupID);
    if (number >= ListsOfCrowns(GROWTH.lists).at.piece_count) return;
    uvec2 piece = ListsOfCrowns(GROWTH.lists).at.pieces[number];
    uint tile = piece.x / sites_per_tile, site = piece.x % sites_per_tile;
    Crown crown;
    if (!crown_of_site(tile, site, crown)) return;
    CrownPixels of = crown_pixels(crown, tile, site);
    int side = piece_px(of), count = (of.box.z - of.box.x) / side + 1;
    ivec2 first = of.box.xy + ivec2(int(piece.y) % count, int(piece.y) / count) * side;
    ivec2 end = min(first + side, of.box.zw + 1);
    for (int y = first.y + int(gl_LocalInvocationID.y); y < end.y; y += int(gl_WorkGroupSize.y))
        for (int x = first.x + int(gl_LocalInvocationID.x); x < end.x; x += int(gl_WorkGroupSize.x)) draw_pixel(crown, of, ivec2(x, y));
}
