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
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/shade/surface.glsl"
#include "shaders/shade/rims.glsl"
#include "shaders/shade/srgb.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(binding = 1, rgba32f) uniform readonly image2D shaded;  // linear light; alpha: 1 where there is ground
layout(binding = 2, rgba8) uniform writeonly image2D picture;

float depth_at(ivec2 pixel) { return Floats(FRAME.depths).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]; }
bool within(ivec2 pixel) { return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, ivec2(FRAME.width_px, FRAME.height_px))); }
uint id_at(ivec2 pixel) {
    return from_compute ? VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)].x : imageLoad(ids, pixel).x;
}

// The share of a neighbour in a pixel.
float share_of(ivec2 pixel, ivec2 to_neighbour) {
    // Depths that are closer to each other are no edge that is seen: the same ground, or ground just behind it.
    const float smallest_jump = 0.008;
    ivec2 neighbour = pixel + to_neighbour;
    if (!within(neighbour)) return 0.0;
    float here = depth_at(pixel), there = depth_at(neighbour);
    if (abs(there - here) <= smallest_jump * min(here, there)) return 0.0;
    bool is_near = here > there;
    ivec2 near = is_near ? pixel : neighbour;
    vec2 towards = is_near ? vec2(to_neighbour) : -vec2(to_neighbour);
    Rim rim;
    if (!finds_rim(id_at(near) - 1u, vec2(near) + 0.5, towards, rim)) return 0.0;
    float inside = inside_rim(rim, is_near ? vec2(0.0) : towards);
    return is_near ? 1.0 - inside : inside;
}

void keep(ivec2 pixel, vec4 colour) { imageStore(picture, pixel, vec4(dithered(srgb_from_linear(colour.rgb), pixel), colour.a)); }

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!within(pixel)) return;
    vec4 own = imageLoad(shaded, pixel), colour = own, shares;
    const ivec2 steps[4] = {ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1)};
    for (int i = 0; i < 4; ++i) shares[i] = share_of(pixel, steps[i]);
    // A slanting edge is seen beside and above: it counts once.
    float beside = shares.x + shares.y, above_below = shares.z + shares.w, all = max(max(beside, above_below), 1.0);
    int first = beside >= above_below ? 0 : 2;
    for (int i = first; i < first + 2; ++i) {
        if (shares[i] > 0.0) colour += shares[i] / all * (imageLoad(shaded, pixel + steps[i]) - own);
    }
    keep(pixel, colour);
}
