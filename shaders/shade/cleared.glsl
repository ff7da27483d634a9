// How near to meshes a place is, by the map of FrameConstants.cleared. Needs frame.glsl.

// Metres from a place to the nearest mesh, and to the nearest built one, from above: bilinear between cells; cleared_reach_m and more are
// that.
vec2 mesh_distance_m(vec3 view) {
    if (FRAME.cleared.cells == uvec2(0u)) return vec2(cleared_reach_m);
    vec2 at = FRAME.cleared.eye + vec2(dot(view, FRAME.cleared.along_x), dot(view, FRAME.cleared.along_y)) - 0.5;
    ivec2 side = ivec2(FRAME.cleared.side);
    if (any(lessThan(at, vec2(-1.0))) || any(greaterThan(at, vec2(side)))) return vec2(cleared_reach_m);
    vec2 low = floor(at), on = at - low, near = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1), cell = clamp(ivec2(low) + step, ivec2(0), side - 1);
        uint word = Words(FRAME.cleared.cells).at[cell.y * side.x + cell.x];
        float share = (step.x == 1 ? on.x : 1.0 - on.x) * (step.y == 1 ? on.y : 1.0 - on.y);
        near += share * vec2(float(word & 255u), float(word >> 8u & 255u));
    }
    return cleared_reach_m * (1.0 - near / 255.0);
}
