// Pixels of crowns into the visibility buffer, as triangles are: the nearest stays. Needs crown.glsl and 64-bit atomics.

layout(buffer_reference, scalar, buffer_reference_align = 16) buffer Visibility { uint64_t at[]; };

uint id_of_site(uint tile, uint site) {
    return (GROWTH.first_page + tile) * (meshlets_per_page * meshlet_triangles) + site * ids_per_site + 1u;
}

// What all pixels of a crown share.
struct CrownPixels {
    ivec4 box;
    float pixel_m;
    float nearest;  // depth
    uint id;
};
CrownPixels crown_pixels(Crown crown, uint tile, uint site) {
    vec3 top = crown.foot + crown.high_m * crown.axes[2];
    return CrownPixels(pixels_of_crown(crown), pixel_m_at(crown.foot), nearest_depth(crown.foot, top, crown.radius_m), id_of_site(tile, site));
}

// A crown's pieces, so many pixels wide and high: larger ones where it would have too many, so that a list has room for those of all crowns.
const int crown_pieces_max = 128;
int piece_px(CrownPixels of) {
    int side = int(crown_piece_px);
    ivec2 last = of.box.zw - of.box.xy;
    while ((last.x / side + 1) * (last.y / side + 1) > crown_pieces_max) side *= 2;
    return side;
}

uint64_t seen_at(uint at) {
    return atomicLoad(Visibility(FRAME.visibility).at[at], gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
}
void draw_pixel(Crown crown, CrownPixels of, ivec2 pixel) {
    uint at = uint(pixel.y) * FRAME.width_px + uint(pixel.x);
    uint64_t seen = seen_at(at);
    // Something nearer than any of its leaves is there.
    if (uint(seen >> 32) > floatBitsToUint(of.nearest)) return;
    CrownHit hit;
    if (!hits_crown(crown, ray_of_pixel(pixel), of.pixel_m, hit)) return;
    uint64_t candidate = (uint64_t(floatBitsToUint(FRAME.near_m / hit.depth_m)) << 32) | uint64_t(~of.id);
    if (candidate > seen)
        atomicMax(Visibility(FRAME.visibility).at[at], candidate, gl_ScopeDevice, gl_StorageSemanticsBuffer, gl_SemanticsRelaxed);
}
