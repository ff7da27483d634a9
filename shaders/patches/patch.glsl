// Patches of made terrain: where their vertices are, and which triangles they make.
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : require
#include "shaders/patches/shared_patches.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PatchHeights { int at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer PatchPlaces { ivec2 at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PatchLevels { uint at[]; };
layout(push_constant, scalar) uniform Pushed { PatchFrame frame; };

// 1 - e2 of WGS84.
const float patch_flattening = 0.99330562;

uint posts_a_side() { return frame.patches * patch_quads + 1u; }

int high_word(int a, int b) {
    int high, low;
    imulExtended(a, b, high, low);
    return high;
}

// A post at a height, from the eye, metres of ECEF. The place on the ellipsoid is of whole numbers, so that its difference from the eye's
// is exact before it becomes a float; posts of two patches are the same bits.
vec3 post_from_eye(uvec2 post, float height_m) {
    ivec2 row = PatchPlaces(frame.rows).at[post.y];
    ivec2 column = PatchPlaces(frame.columns).at[post.x];
    ivec3 place = ivec3(high_word(row.x << 2, column.x), high_word(row.x << 2, column.y), row.y);
    precise vec2 across = vec2(float(row.x) * patch_flattening, float(row.y));
    precise vec2 slant = across * inversesqrt(across.x * across.x + across.y * across.y);
    precise vec3 normal = vec3(slant.x * (float(column.x) * (1.0 / 1073741824.0)), slant.x * (float(column.y) * (1.0 / 1073741824.0)), slant.y);
    precise vec3 from_eye = vec3(place - frame.eye) * (1.0 / 64.0) + normal * height_m;
    return from_eye;
}
float post_height_m(uvec2 post) { return float(PatchHeights(frame.heights).at[post.y * posts_a_side() + post.x]) * (1.0 / 2048.0); }

// Clip coordinates: depth reversed, without an end.
vec4 patch_clip(vec3 p) {
    precise float x = (frame.right.x * p.x + frame.right.y * p.y + frame.right.z * p.z) * frame.scale.x;
    precise float y = (frame.up.x * p.x + frame.up.y * p.y + frame.up.z * p.z) * -frame.scale.y;
    precise float w = frame.forward.x * p.x + frame.forward.y * p.y + frame.forward.z * p.z;
    return vec4(x, y, patch_near_m, w);
}

// The level that a patch's distance gives it: of its middle, at half the greatest height.
uint level_by_distance(uvec2 patch_at) {
    float distance_m = length(post_from_eye(patch_at * patch_quads + patch_quads / 2u, frame.middle_m));
    float bands = (distance_m - frame.nearest_m) / frame.band_m;
    return patch_finest - uint(clamp(floor(bands), 0.0, float(patch_finest)));
}
uint level_of(ivec2 patch_at) { return PatchLevels(frame.levels).at[uint(patch_at.y) * frame.patches + uint(patch_at.x)]; }

// What a patch is drawn with: posts from vertex to vertex, its own and along its west, east, north and south border.
struct PatchSteps {
    uint own;
    uvec4 border;
};
uint step_beside(ivec2 patch_at, uint own) {
    bool there = min(patch_at.x, patch_at.y) >= 0 && max(patch_at.x, patch_at.y) < int(frame.patches);
    return there ? max(own, patch_quads >> level_of(patch_at)) : own;
}
PatchSteps steps_of(uvec2 patch_at) {
    PatchSteps steps;
    ivec2 at = ivec2(patch_at);
    steps.own = patch_quads >> level_of(at);
    steps.border = uvec4(steps.own);
    if (frame.borders != patch_borders_open)
        steps.border = uvec4(step_beside(at - ivec2(1, 0), steps.own), step_beside(at + ivec2(1, 0), steps.own),
                             step_beside(at - ivec2(0, 1), steps.own), step_beside(at + ivec2(0, 1), steps.own));
    return steps;
}
uint squares_of(PatchSteps steps) { return patch_quads / steps.own; }

// The step along the border that a vertex is on, and the way along it; a vertex inside has its own step.
uint border_step(PatchSteps steps, uvec2 within, out bool along_y) {
    along_y = true;
    if (within.x == 0u && steps.border.x > steps.own) return steps.border.x;
    if (within.x == patch_quads && steps.border.y > steps.own) return steps.border.y;
    along_y = false;
    if (within.y == 0u && steps.border.z > steps.own) return steps.border.z;
    if (within.y == patch_quads && steps.border.w > steps.own) return steps.border.w;
    return steps.own;
}

// A vertex of a patch, number v row by row, from the eye.
vec3 patch_vertex(uvec2 patch_at, PatchSteps steps, uint v) {
    uint side = squares_of(steps) + 1u;
    uvec2 within = uvec2(v % side, v / side) * steps.own;
    bool along_y;
    uint stride = border_step(steps, within, along_y);
    uint along = along_y ? within.y : within.x;
    uint before = along / stride * stride;
    uvec2 first = patch_at * patch_quads;
    if (before == along) return post_from_eye(first + within, post_height_m(first + within));
    uvec2 low = along_y ? uvec2(within.x, before) : uvec2(before, within.y);
    if (frame.borders == patch_borders_shared) return post_from_eye(first + low, post_height_m(first + low));
    uvec2 high = along_y ? uvec2(within.x, before + stride) : uvec2(before + stride, within.y);
    float share = float(along - before) / float(stride);
    return post_from_eye(first + within, mix(post_height_m(first + low), post_height_m(first + high), share));
}

// Corners of a triangle by its number: two a square, row by row.
uvec3 patch_triangle(uint squares, uint triangle) {
    uint square = triangle >> 1, side = squares + 1u;
    uint corner = square / squares * side + square % squares;
    return (triangle & 1u) == 0u ? uvec3(corner, corner + 1u, corner + side) : uvec3(corner + 1u, corner + side + 1u, corner + side);
}
uint patch_id(uvec2 patch_at, uint triangle) { return (patch_at.y * frame.patches + patch_at.x) * patch_triangles_most + triangle + 1u; }
