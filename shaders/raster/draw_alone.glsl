// What one invocation does with a triangle that is to be drawn: draws it, or hands it on. Needs raster.glsl.

// Pixels of the largest box that one invocation draws by itself. What is larger goes to other workgroups: near the eye a few
// meshlets cover most of the picture, and whoever drew them alone would keep all others waiting.
const int alone_max_px = 64;

void list_clip(uint id) {
    uint at = atomicAdd(lists().at.clips, 1u);
    if (at >= clips_max) {
        atomicAdd(Counts(FRAME.counts).at.triangles_not_clipped, 1u);
        return;
    }
    Words(FRAME.clip_list).at[at] = id;
    uint groups = at / 64u + 1u;
    atomicMax(lists().at.clip_groups[0], min(groups, groups_per_row));
    atomicMax(lists().at.clip_groups[1], (groups + groups_per_row - 1u) / groups_per_row);
}

// Corners in clip coordinates.
void draw_corners(vec4 a, vec4 b, vec4 c, uint id) {
    if (max(a.w, max(b.w, c.w)) < FRAME.near_m) return;
    if (!fits_grid(a, b, c)) {
        list_clip(id);
        return;
    }
    ScreenTriangle t;
    if (!screen_triangle(a, b, c, id, t)) return;
    ivec4 box = pixel_box(t);
    ivec2 size = box.zw - box.xy + 1;
    if (min(size.x, size.y) <= 0) return;
    if (fits_near(t) && size.x * size.y <= alone_max_px) {
        draw_near(t, box, 0u, 1u);
    } else if (!list_large(t, box)) {
        draw_far(t, box, 0u, 1u);
    }
}
