#version 460
// Colours pixels by what draws them, in the place of the ground's own colours (FrameConstants.show): which round, level, meshlet,
// triangle, cluster or group, or how many triangles. The tables of colours are also core's, for legends (core/frame/frame_colours.h).
#extension GL_GOOGLE_include_directive : require
#include "shaders/place/frame.glsl"
#include "shaders/clusters/drawn.glsl"
#include "shaders/shade/show_colours.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(binding = 0, r32ui) uniform readonly uimage2D ids;
layout(binding = 2, rgba8) uniform writeonly image2D picture;

bool was_drawn_before(uint node) {
    return (Words(FRAME.drawn).at[node / 32u] >> (node % 32u) & 1u) != 0u;
}

vec3 colour_on_pages(uint triangle, uint node) {
    // Meshlets are told apart by a little light.
    float light = 0.85 + 0.15 * shown_by_hash(node).x;
    if (FRAME.show == show_levels) return light * shown_level(frame_pages().at[node / meshlets_per_page].level);
    if (FRAME.show == show_visible) return light * shown_round(FRAME.occlusion == 0u || was_drawn_before(node));
    return shown_by_hash(FRAME.show == show_triangles ? triangle : node);
}

// Numbers are the graph's, so that colours stay while the eye moves.
vec3 colour_on_clusters(uint triangle, uint node) {
    DrawnCluster drawn = drawn_cluster(node);
    float light = 0.85 + 0.15 * shown_by_hash(drawn.number).x;
    if (FRAME.show == show_levels) return light * shown_level(level_of_cluster(drawn));
    if (FRAME.show == show_visible) return light * shown_round(FRAME.occlusion == 0u || (state_of_cluster(node) & cluster_drawn) != 0u);
    if (FRAME.show == show_groups) return light * shown_by_hash(drawn.group);
    uint number = drawn.number;
    return shown_by_hash(FRAME.show == show_triangles ? number * cluster_triangles + triangle % cluster_triangles : number);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    uint id = from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])
                           : imageLoad(ids, pixel).x;
    if (FRAME.other_grids != 0u && is_left_to_others(id)) return;
    if (id == 0u) {
        imageStore(picture, pixel, vec4(0.0));
        return;
    }
    uint triangle = triangle_of_id(id), node = triangle / meshlet_triangles;
    vec3 colour = FRAME.clusters.on != 0u ? colour_on_clusters(triangle, node) : colour_on_pages(triangle, node);
    if (FRAME.show == show_overdraw) colour = shown_overdraw(Words(FRAME.overdraw).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)]);
    imageStore(picture, pixel, vec4(colour, 1.0));
}
