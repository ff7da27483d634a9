#version 460
// Colours pixels by what draws them, in the place of the ground's own colours (FrameConstants.show): which round, level, meshlet or
// triangle, or how many triangles. The table of level colours and those of the rounds are also core's, for legends (core/frame/frame_colours.h).
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/shade/show_colours.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(binding = 2, rgba8) uniform writeonly image2D picture;

bool was_drawn_before(uint node) {
    return (Words(FRAME.drawn).at[node / 32u] >> (node % 32u) & 1u) != 0u;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    uint id = from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])
                           : imageLoad(ids, pixel).x;
    if (FRAME.grids_beside != 0u && is_left_to_others(id)) return;
    if (id == 0u) {
        imageStore(picture, pixel, vec4(0.0));
        return;
    }
    uint triangle = triangle_of_id(id), node = triangle / meshlet_triangles, page = node / meshlets_per_page;
    vec3 colour = shown_by_hash(FRAME.show == show_triangles ? triangle : node);
    if (FRAME.show == show_levels) colour = shown_level(frame_pages().at[page].level);
    if (FRAME.show == show_visible) colour = shown_round(FRAME.occlusion == 0u || was_drawn_before(node));
    if (FRAME.show == show_overdraw) colour = shown_overdraw(Words(FRAME.overdraw).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]);
    // Meshlets are told apart by a little light.
    if (FRAME.show == show_levels || FRAME.show == show_visible) colour *= 0.85 + 0.15 * shown_by_hash(node).x;
    imageStore(picture, pixel, vec4(colour, 1.0));
}
