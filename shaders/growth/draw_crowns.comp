#version 460
// Draws trees: an invocation takes a site, and all of a workgroup those that cover many pixels. Pixels by rays, so that silhouettes are
// exact, into the visibility buffer as triangles are: the nearest stays.
#extension GL_GOOGLE_include_directive : require
#extension GL_KHR_memory_scope_semantics : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#include "shaders/place/frame.glsl"
#include "shaders/choose/levels.glsl"
#include "shaders/place/place.glsl"
#include "shaders/growth/growth.glsl"
#include "shaders/growth/crown.glsl"

layout(local_size_x = 128) in;  // site_group

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Visibility { uint64_t at[]; };

const int alone_px = 2048;
shared uint large[128];
shared uint large_count;

uint id_of_site(uint tile, uint site) {
    return (GROWTH.first_page + tile) * (meshlets_per_page * meshlet_triangles) + site * ids_per_site + 1u;
}

// As raster.glsl.
void keep_nearest(ivec2 pixel, float depth, uint id) {
    Visibility visibility = Visibility(FRAME.visibility);
    uint at = uint(pixel.y) * FRAME.width_px + uint(pixel.x);
    uint64_t candidate = (uint64_t(floatBitsToUint(depth)) << 32) | uint64_t(~id);
    if (candidate > atomicLoad(visibility.at[at], gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed))
        atomicMax(visibility.at[at], candidate, gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
}

void draw_pixel(Crown crown, ivec2 pixel, float pixel_m, uint id) {
    CrownHit hit;
    if (hits_crown(crown, ray_of_pixel(pixel), pixel_m, hit)) keep_nearest(pixel, FRAME.near_m / hit.depth_m, id);
}

void main() {
    uint group = folded(gl_WorkGroupID), tile = group / site_groups_per_tile, lane = gl_LocalInvocationIndex;
    if (tile >= GROWTH.tile_count) return;
    if (lane == 0u) large_count = 0u;
    barrier();
    uint site = group % site_groups_per_tile * site_group + lane;
    Crown crown;
    if (crown_of_site(tile, site, crown)) {
        ivec4 box = pixels_of_crown(crown);
        if (!is_empty(box)) {
            int width = box.z - box.x + 1, count = width * (box.w - box.y + 1);
            if (count > alone_px) large[atomicAdd(large_count, 1u)] = site;
            else {
                float pixel_m = pixel_m_at(crown.foot);
                for (int i = 0; i < count; ++i) draw_pixel(crown, box.xy + ivec2(i % width, i / width), pixel_m, id_of_site(tile, site));
            }
        }
    }
    barrier();
    for (uint number = 0u; number < large_count; ++number) {
        if (!crown_of_site(tile, large[number], crown)) continue;
        ivec4 box = pixels_of_crown(crown);
        int width = box.z - box.x + 1, count = width * (box.w - box.y + 1);
        float pixel_m = pixel_m_at(crown.foot);
        for (int i = int(lane); i < count; i += 128) draw_pixel(crown, box.xy + ivec2(i % width, i / width), pixel_m, id_of_site(tile, large[number]));
    }
}
