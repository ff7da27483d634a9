// Nodes that stand for something finer, while that is not there. Needs select.glsl.

// Whether a node stands for something finer that is needed and not there.
bool stands_for_finer(FramePage page, uint node) {
    const uint half_side = meshlets_per_side / 2u;
    uint quarter = node / meshlets_per_side / half_side * 2u + node % meshlets_per_side / half_side;
    return (page.fallback_quarters >> (stands_for_missing + quarter) & 1u) != 0u;
}

// Whether any of what a node stands for may be in the picture.
bool may_be_in_picture(FramePage page, MeshletBounds bounds) {
    if ((page.cull & cull_by_frustum) == 0u) return true;
    for (int i = 0; i < 5; ++i) {
        if (sphere_beyond_plane(bounds.centre, bounds.lod_radius, page.planes[i])) return false;
    }
    return true;
}
