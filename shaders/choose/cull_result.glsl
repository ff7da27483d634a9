// Whether a meshlet is drawn, and if not, why. Both ways of drawing ask here. Needs frame.glsl and select.glsl.
const uint is_kept = 0u;
const uint is_not_chosen = 1u;  // another level is drawn there, or nothing is
const uint is_beyond_frustum = 2u;
const uint is_beyond_horizon = 3u;

uint cull_result_of(FramePage page, MeshletBounds bounds) {
    if ((page.cull & cull_by_frustum) != 0u) {
        for (int i = 0; i < 5; ++i) {
            if (sphere_beyond_plane(bounds.centre, bounds.radius, page.planes[i])) return is_beyond_frustum;
        }
    }
    if ((page.cull & cull_by_horizon) != 0u) {
        vec3 eye_offset = page.horizon_direction - bounds.horizon_offset;
        if (beyond_horizon(eye_offset, FRAME.horizon_angle_rad, FRAME.horizon_stretch * bounds.horizon_angle_rad)) return is_beyond_horizon;
    }
    return is_kept;
}

// Those that are kept are counted where they are drawn.
void count_cull_result(uint cull_result) {
    Counts counts = Counts(FRAME.counts);
    if (cull_result == is_beyond_frustum) atomicAdd(counts.at.meshlets_beyond_frustum, 1u);
    else if (cull_result == is_beyond_horizon) atomicAdd(counts.at.meshlets_beyond_horizon, 1u);
}
