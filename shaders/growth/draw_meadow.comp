#version 460
// Draws blades of grass into the visibility buffer: an invocation takes a blade, a strip along its curve that is nowhere narrower than a pixel.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/meadow.glsl"

layout(local_size_x = 128) in;  // blades_per_piece * pieces_per_group
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Visibility { uint64_t at[]; };

const float nearest_m = 0.15;      // no part of a blade that is drawn is nearer
const float least_facing = 0.45;   // a blade is bent along its middle: seen from its edge it shows so much of its width
const float piece_px = 11.0;       // of a strip, along the blade
const int pieces_most = 9;

// Where a blade is cut across, in pixels.
struct Cut {
    vec2 middle;
    vec2 across;  // half its width there
    float depth;
};
vec2 per_pixel() { return 0.5 * vec2(FRAME.width_px, FRAME.height_px); }

// What a small step in space is on the picture, at a place that lies so deep; times depth_m.
vec2 moves(vec3 view, vec3 to) { return FRAME.projection_scale * per_pixel() * (to.xy + view.xy * (to.z / -view.z)); }

bool cut_at(MeadowBlade blade, vec3 foot, mat3 axes, float t, out Cut cut) {
    vec3 view = foot + axes * place_on_blade(blade, t), along = axes * mix(blade.middle - blade.foot, blade.tip - blade.middle, t);
    float depth_m = -view.z;
    if (depth_m < nearest_m) return false;
    cut.depth = FRAME.near_m / depth_m;
    cut.middle = (FRAME.projection_scale * view.xy / depth_m + FRAME.projection_shift + 1.0) * per_pixel();
    vec2 way = moves(view, along), side = moves(view, axes * vec3(blade.side, 0.0));
    float length_px = length(way);
    vec2 normal = length_px > 1.0e-6 ? vec2(-way.y, way.x) / length_px : vec2(1.0, 0.0);
    float half_width_m = 0.5 * blade_width_m * blade_taper(t), whole = FRAME.pixels_per_tangent;
    float half_px = half_width_m * max(abs(dot(side, normal)), least_facing * whole) / depth_m;
    cut.across = max(half_px, 0.5) * normal;
    return true;
}

void draw_pixel(uint at, float depth, uint id) {
    uint64_t candidate = (uint64_t(floatBitsToUint(depth)) << 32) | uint64_t(~id);
    uint64_t seen = atomicLoad(Visibility(FRAME.visibility).at[at], gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
    if (candidate > seen) atomicMax(Visibility(FRAME.visibility).at[at], candidate, gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
}

// Widens a row's span by where an edge crosses it.
void cross_row(vec2 from, vec2 to, float y, inout vec2 span) {
    if ((from.y > y) == (to.y > y)) return;
    float x = from.x + (y - from.y) * (to.x - from.x) / (to.y - from.y);
    span = vec2(min(span.x, x), max(span.y, x));
}

// The pixels whose middles lie between two cuts.
void draw_between(Cut low, Cut high, uint id) {
    vec2 corners[4] = {low.middle - low.across, low.middle + low.across, high.middle + high.across, high.middle - high.across};
    float least = min(min(corners[0].y, corners[1].y), min(corners[2].y, corners[3].y)), most = max(max(corners[0].y, corners[1].y), max(corners[2].y, corners[3].y));
    int first = int(clamp(ceil(least - 0.5), 0.0, float(FRAME.height_px))), last = int(clamp(floor(most - 0.5), -1.0, float(FRAME.height_px) - 1.0));
    vec2 way = high.middle - low.middle;
    way /= max(dot(way, way), 1.0e-6);
    for (int y = first; y <= last; ++y) {
        vec2 span = vec2(1.0e9, -1.0e9);
        for (int i = 0; i < 4; ++i) cross_row(corners[i], corners[(i + 1) & 3], float(y) + 0.5, span);
        int begin = int(clamp(ceil(span.x - 0.5), 0.0, float(FRAME.width_px))), end = int(clamp(ceil(span.y - 0.5), 0.0, float(FRAME.width_px)));
        for (int x = begin; x < end; ++x) {
            float share = clamp(dot(vec2(x, y) + 0.5 - low.middle, way), 0.0, 1.0);
            draw_pixel(uint(y) * FRAME.width_px + uint(x), mix(low.depth, high.depth, share), id);
        }
    }
}

void draw_blade(MeadowBlade blade, vec3 foot, mat3 axes, uint id) {
    Cut low, high;
    if (!cut_at(blade, foot, axes, 0.0, low) || !cut_at(blade, foot, axes, 1.0, high)) return;
    int pieces = clamp(int(length(high.middle - low.middle) / piece_px) + 1, 1, pieces_most);
    for (int i = 1; i <= pieces; ++i) {
        if (!cut_at(blade, foot, axes, float(i) / float(pieces), high)) return;
        draw_between(low, high, id);
        low = high;
    }
}

void main() {
    Pieces pieces = Pieces(MEADOW.pieces);
    uint at = gl_WorkGroupID.x * pieces_per_group + gl_LocalInvocationIndex / blades_per_piece;
    if (at >= min(pieces.head.count, MEADOW.piece_max)) return;
    const uint quarters = blades_per_clump / blades_per_piece;
    uint piece = pieces.at[at], number = piece % quarters * blades_per_piece + gl_LocalInvocationIndex % blades_per_piece;
    uint standing = piece / quarters, tile_number = standing / clumps_per_tile, clump_number = standing % clumps_per_tile;
    MeadowClump clump = Clumps(GROWTH.sites).at[standing];
    if (float(number) >= kept_of(clump)) return;
    GrowthTile tile = GrowthTiles(GROWTH.tiles).at[tile_number];
    uint hash = hash_of_clump(tile, clump_number);
    mat3 axes = axes_of_foot(clump.foot);
    axes[2] *= FRAME.exaggeration;
    draw_blade(blade_numbered(clump, hash, number, wind_on(tile, clump_number, hash)), clump.foot, axes, id_of_blade(tile_number, clump_number, number));
}
