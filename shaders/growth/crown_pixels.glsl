// Pixels of crowns into the visibility buffer, as triangles are: the nearest stays. Needs crown.glsl and 64-bit atomics.

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Visibility { uint64_t at[]; };

uint id_of_site(uint tile, uint site) {
    return (GROWTH.first_page + tile) * (meshlets_per_page * meshlet_triangles) + site * ids_per_site + 1u;
}

// What all pixels of a crown share.
struct CrownPixels {
    ivec4 box;
    float pixel_m;
    float begins_m;  // before the eye, its nearest leaves
    uint id;
};
// No part of a crown that begins so far away has a larger depth, of the frame's: near_m over metres.
float largest_depth(CrownPixels of) { return FRAME.near_m / of.begins_m * 1.0001; }

uint64_t seen_at(uint at) {
    return atomicLoad(Visibility(FRAME.visibility).at[at], gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
}
void draw_pixel(Crown crown, CrownPixels of, ivec2 pixel) {
    uint at = uint(pixel.y) * FRAME.width_px + uint(pixel.x);
    uint64_t seen = seen_at(at);
    // Something nearer than any of its leaves is there.
    float seen_depth = uintBitsToFloat(uint(seen >> 32));
    if (seen_depth > largest_depth(of)) return;
    float most_m = seen_depth > 0.0 ? FRAME.near_m / seen_depth * 1.0001 : no_hit;
    CrownHit hit;
    if (!hits_crown(crown, ray_of_pixel(pixel), of.pixel_m, most_m, hit)) return;
    uint64_t candidate = (uint64_t(floatBitsToUint(FRAME.near_m / hit.depth_m)) << 32) | uint64_t(~of.id);
    if (candidate > seen)
        atomicMax(Visibility(FRAME.visibility).at[at], candidate, gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
}
