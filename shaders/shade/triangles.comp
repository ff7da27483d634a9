#version 460
// Tells of each pixel which triangle it shows: its posts, and where they were placed. Pictures are measured with it.
#extension GL_GOOGLE_include_directive : require
const bool as_map = false;
const bool in_air = false;
const bool draped = false;
const bool by_means = false;
const bool parts_follow = false;
const bool parts_alone = false;
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/place/net.glsl"
#include "shaders/shade/surface.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const bool from_compute = false;  // ids come from the compute rasteriser's buffer
layout(buffer_reference, scalar, buffer_reference_align = 16) writeonly buffer Triangles { DrawnTriangle at[]; };
layout(binding = 0, r32ui) uniform readonly uimage2D ids;

DrawnTriangle triangle_of(uint id) {
    DrawnTriangle triangle;
    if (!is_of_grid(id)) {
        for (int i = 0; i < 3; ++i) {
            triangle.at[i] = vec3(0.0);
            triangle.rows[i] = triangle.columns[i] = no_triangle;
            triangle.h_m[i] = 0.0;
        }
        return triangle;
    }
    uvec2 posts[3];
    float heights_m[3];
    vec3 at[3];
    FramePage page = corners_of(triangle_of_id(id), posts, heights_m, at);
    for (int i = 0; i < 3; ++i) {
        uvec2 number = min(uvec2(page.first_row, page.first_column) + (posts[i] << page.level), uvec2(FRAME.last_row, FRAME.last_column));
        triangle.at[i] = at[i];
        triangle.rows[i] = number.x;
        triangle.columns[i] = number.y;
        triangle.h_m[i] = heights_m[i];
    }
    return triangle;
}

// By a function: glslang 12.0 does not end on such an assignment in main().
void keep(ivec2 pixel, DrawnTriangle triangle) {
    Triangles(FRAME.triangles).at[(uint(pixel.y) % FRAME.triangle_rows) * FRAME.width_px + uint(pixel.x)] = triangle;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (pixel.x >= int(FRAME.width_px) || pixel.y >= int(FRAME.height_px)) return;
    uint id = from_compute ? id_of(VisibilityWords(FRAME.visibility).at[uint(pixel.y) * FRAME.width_px + uint(pixel.x)])
                           : imageLoad(ids, pixel).x;
    keep(pixel, triangle_of(id));
}
