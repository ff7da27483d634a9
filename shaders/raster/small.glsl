// Which triangles cover no pixel's centre. Conservative: what is left out can show nowhere. Needs frame.glsl.

// Where a graphics pipeline puts a triangle's corners: on 1/16 px at worst.
const float snap_slack_px = 0.0725;

// Whether a triangle in clip coordinates may cover the centre of a pixel of the picture, by the box around it.
bool may_cover_a_pixel(vec4 a, vec4 b, vec4 c) {
    if (min(a.w, min(b.w, c.w)) < 1.001 * FRAME.near_m) return true;
    vec2 size = vec2(FRAME.width_px, FRAME.height_px), half_size = 0.5 * size;
    vec2 pa = a.xy / a.w * half_size + half_size, pb = b.xy / b.w * half_size + half_size, pc = c.xy / c.w * half_size + half_size;
    vec2 low = min(pa, min(pb, pc)), high = max(pa, max(pb, pc));
    // Floats: far beyond the picture they are coarser than the grid.
    vec2 slack = snap_slack_px + 1.0e-6 * max(abs(low), abs(high));
    vec2 first = max(ceil(low - slack - 0.5), vec2(0.0)), last = min(floor(high + slack - 0.5), size - 1.0);
    return first.x <= last.x && first.y <= last.y;
}
