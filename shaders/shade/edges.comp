#version 460
// Smooths the edges of a shaded picture of one sample: where ground meets sky, or nearer ground meets farther ground, a pixel gets the
// share of what is beyond the edge that the nearer ground's own triangles leave to it (rims.glsl). A pixel depends on those beside it
// alone, and on nothing that the ways of drawing do differently.
#extension GL_GOOGLE_include_directive : require
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(constant_id = 2) const bool in_air = false;        // FrameStyle.air
const bool as_map = false;
const bool draped = false;
const bool by_means = false;
const bool parts_follow = false;
const bool parts_alone = false;
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/surface.glsl"
#include "shaders/shade/rims.glsl"
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(binding = 1, rgba32f) uniform readonly image2D shaded;  // linear light; alpha: 1 where there is ground
layout(binding = 2, rgba8) uniform writeonly image2D picture;

float depth_at(ivec2 pixel) { return abs(Floats(FRAME.depths).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]); }
bool within(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(FRAME.width_px, FRAME.height_px))); }
uint id_at(ivec2 pixel) {
    return from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]) : imageLoad(ids, pixel).x;
}

// Two pixels beside each other, by a number: those of each row of the workgroup's square and the ones before and behind it, then those of
// each column.
const int side_px = int(gl_WorkGroupSize.x), pairs_across = side_px * (side_px + 1), pair_count = 2 * pairs_across;
struct Pair {
    ivec2 first;
    ivec2 to_second;
};
Pair pair_of(int number) {
    bool across = number < pairs_across;
    int within = across ? number : number - pairs_across, line = within / (side_px + 1), on = within % (side_px + 1) - 1;
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * side_px;
    return across ? Pair(corner + ivec2(on, line), ivec2(1, 0)) : Pair(corner + ivec2(line, on), ivec2(0, 1));
}

// Pairs with an edge between them are listed first, so that whole subgroups look for rims together, and once for both pixels.
shared uint listed_count, edge_count;
shared uint listed[pair_count];
shared vec2 shares_of_pairs[pair_count];  // of the second pixel in the first, and of the first in the second

// Depths that are closer to each other are no edge that is seen: the same ground, or ground just behind it.
bool is_jump(float here, float there) { return abs(there - here) > 0.008 * min(here, there); }

// Whether a pixel differs from one beside it: most squares have none that does, and are done with.
bool has_edge(ivec2 pixel) {
    ivec2 last = ivec2(FRAME.width_px, FRAME.height_px) - 1;
    if (any(greaterThan(pixel, last))) return false;
    float here = depth_at(pixel);
    return is_jump(here, depth_at(ivec2(max(pixel.x - 1, 0), pixel.y))) || is_jump(here, depth_at(ivec2(min(pixel.x + 1, last.x), pixel.y))) ||
           is_jump(here, depth_at(ivec2(pixel.x, max(pixel.y - 1, 0)))) || is_jump(here, depth_at(ivec2(pixel.x, min(pixel.y + 1, last.y))));
}

void list_pair(int number) {
    shares_of_pairs[number] = vec2(0.0);
    Pair pair = pair_of(number);
    ivec2 second = pair.first + pair.to_second;
    if (!within(pair.first) || !within(second)) return;
    if (is_jump(depth_at(pair.first), depth_at(second))) listed[atomicAdd(listed_count, 1u)] = uint(number);
}

vec2 shares_of(Pair pair) {
    ivec2 second = pair.first + pair.to_second;
    bool first_is_near = depth_at(pair.first) > depth_at(second);
    ivec2 near = first_is_near ? pair.first : second;
    vec2 towards = first_is_near ? vec2(pair.to_second) : -vec2(pair.to_second);
    uint id = id_at(near);
    Rim rim;
    if (!is_of_grid(id) || !finds_rim(triangle_of_id(id), vec2(near) + 0.5, towards, rim)) return vec2(0.0);
    vec2 shares = vec2(1.0 - inside_rim(rim, vec2(0.0)), inside_rim(rim, towards));
    return first_is_near ? shares : shares.yx;
}

void keep(ivec2 pixel, vec4 colour) { imageStore(picture, pixel, vec4(dithered(srgb_from_linear(colour.rgb), pixel), colour.a)); }

void main() {
    if (gl_LocalInvocationIndex == 0u) listed_count = edge_count = 0u;
    barrier();
    if (has_edge(ivec2(gl_GlobalInvocationID.xy))) edge_count = 1u;
    barrier();
    if (edge_count == 0u) return;
    const int lanes = side_px * side_px;
    for (int i = int(gl_LocalInvocationIndex); i < pair_count; i += lanes) list_pair(i);
    barrier();
    if (listed_count == 0u) return;
    for (uint i = gl_LocalInvocationIndex; i < listed_count; i += uint(lanes)) shares_of_pairs[listed[i]] = shares_of(pair_of(int(listed[i])));
    barrier();
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), within_square = ivec2(gl_LocalInvocationID.xy);
    const ivec2 steps[4] = {ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1)};
    int before = within_square.y * (side_px + 1) + within_square.x;
    int above = pairs_across + within_square.x * (side_px + 1) + within_square.y;
    vec4 shares = vec4(shares_of_pairs[before + 1].x, shares_of_pairs[before].y, shares_of_pairs[above + 1].x, shares_of_pairs[above].y);
    // Without an edge it is as it was shaded.
    if (shares == vec4(0.0) || !within(pixel) || (FRAME.other_grids != 0u && is_left_to_others(id_at(pixel)))) return;
    vec4 own = imageLoad(shaded, pixel), colour = own;
    // A slanting edge is seen beside and above: it counts once.
    float left_right = shares.x + shares.y, above_below = shares.z + shares.w, all = max(max(left_right, above_below), 1.0);
    int first = left_right >= above_below ? 0 : 2;
    for (int i = first; i < first + 2; ++i) {
        if (shares[i] > 0.0) colour += shares[i] / all * (imageLoad(shaded, pixel + steps[i]) - own);
    }
    keep(pixel, colour);
}
