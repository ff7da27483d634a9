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
#include "shaders/growth/large_crown.glsl"

layout(local_size_x = 8, local_size_y = 16) in;

void main() {
    uint number = folded(gl_WorkGroupID);
    ListsOfCrowns lists = ListsOfCrowns(GROWTH.lists);
    if (number >= min(lists.at.piece_count, crown_piece_max)) return;
    uint piece = lists.at.pieces[number];
    LargeCrown large = lists.at.crowns[piece >> crown_piece_bits];
    Crown crown = crown_of(large);
    CrownPixels of = pixels_of(large);
    ivec4 box = piece_of(of.box, piece & ((1u << crown_piece_bits) - 1u));
    for (int y = box.y + int(gl_LocalInvocationID.y); y <= box.w; y += int(gl_WorkGroupSize.y))
        for (int x = box.x + int(gl_LocalInvocationID.x); x <= box.z; x += int(gl_WorkGroupSize.x)) draw_pixel(crown, of, ivec2(x, y));
}
