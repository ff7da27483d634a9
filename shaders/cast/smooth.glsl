// Near the eye a cell is many pixels wide, and the ground is shaded smoothly. There a triangle that is turned away from the sun, or that a
// neighbour hides, would be a dark facet with straight sides. So what lies within a few cells of where a line begins may not hide more
// of the sun as triangles than it does as a smooth surface. Needs start.glsl.
// Source: J. Hanika, Hacking the shadow terminator, Ray Tracing Gems II, 2021, tells of such facets, and of starts above the triangle;
// here the ground that is met is smooth, too.

const float all_smooth_px = 10.0;
// From where triangles begin to count as they are, up to where they all do; cells.
const float smooth_cells = 1.5, smooth_end_cells = 3.0;
const int smooth_cells_max = 32;

// 0 where the ground is triangles, 1 where it is shaded smoothly. Nothing is smooth where slopes are not shaded at all.
float smoothness(CastStart start) {
    if (FRAME.style.relief < 0.5) return 0.0;
    return smoothstep(smooth_from_px, all_smooth_px, side_px(start.cell, start.point.distance_m));
}

// How far a line goes in a cell of a level, along the axis that it follows more; and how far the ground on it may be smooth. Metres.
float cell_m_of(vec2 per_m, uint level) { return float(1 << level) / max(max(abs(per_m.x), abs(per_m.y)), 1.0e-9); }
float smooth_way_m(CastStart start, vec2 per_m) { return smooth_end_cells * cell_m_of(per_m, start.level); }

// Source: C. de Boor, A Practical Guide to Splines, 1978, chapter IX: the uniform cubic B-spline. Its slopes at the posts are
// central differences, nearly those that are shaded.
vec4 spline_weights(float at) {
    float rest = 1.0 - at;
    return vec4(rest * rest * rest, 4.0 - 3.0 * at * at * (1.0 + rest), 4.0 - 3.0 * rest * rest * (1.0 + at), at * at * at) / 6.0;
}

// A cell, and the sixteen posts in and around it: metres above a height (in steps), a column for each row of posts.
struct SmoothCell {
    CasterCell cell;
    mat4 posts_m;
};
// A void corner is as high as those beside it, or the base.
int filled(int corner, int neighbour, int other, int base) {
    if (corner != void_height) return corner;
    if (neighbour == void_height) return other == void_height ? base : other;
    return other == void_height ? neighbour : (neighbour + other) / 2;
}
// Of the level that lines meet there; false where there is none. A void post around it is as high as the corner next to it.
bool smooth_cell(CastStart start, ivec2 at, int base, inout uint level, out SmoothCell found) {
    CasterNode node;
    if (!caster_at(at, start.error_m, level, node)) return false;
    PageBlocks block = PageBlocks(node.block);
    found.cell = caster_cell(block, level, at);
    ivec4 h = found.cell.heights;
    ivec4 corners = ivec4(filled(h.x, h.y, h.z, base), filled(h.y, h.x, h.w, base), filled(h.z, h.x, h.w, base), filled(h.w, h.y, h.z, base));
    uvec2 first = uvec2(at) >> level & 127u;
    for (int i = 0; i < 16; ++i) {
        int row = i >> 2, column = i & 3, height = stored_height(block, first + uvec2(row, column));
        if (height == void_height) height = corners[(row > 1 ? 2 : 0) + (column > 1 ? 1 : 0)];
        found.posts_m[row][column] = float(height - base) * height_step_m;
    }
    return true;
}
float smooth_at_m(SmoothCell found, vec2 share) { return dot(spline_weights(share.x), spline_weights(share.y) * found.posts_m); }

// What has been seen of the smooth ground, and how high it is where the line begins.
struct SmoothSearch {
    float least;
    float here_m;
};

// Looks where a line crosses a side of a triangle, as look_at_cell() does: so ground that counts as it is hides what it hides there. either:
// on the diagonal, where the triangle of the other side is as good. False where there is no ground.
bool look_at_smooth(SunLine line, CastPiece piece, SmoothCell found, uint level, float t_m, bool west, bool either, CastSearch search, inout SmoothSearch seen) {
    vec2 share = share_of_cell(piece, found.cell, search.post, t_m);
    float flat_m = no_ground_m;
    [[unroll]] for (int i = 0; i < 2; ++i)
        if (i == 0 || (flat_m == no_ground_m && either)) flat_m = above_base(found.cell, share, west != (i == 1), search.base);
    if (flat_m == no_ground_m) return false;
    float as_is = max(smoothstep(smooth_cells, smooth_end_cells, t_m / cell_m_of(piece.per_m, level)),
                      smoothstep(smooth_cells / smooth_end_cells, 1.0, t_m / piece.to_m));
    float clear_m = mix(seen.here_m - smooth_at_m(found, share), -flat_m, as_is);
    seen.least = min(seen.least, (along(line, t_m).z + search.lift_m + clear_m) * line.level / t_m);
    return true;
}

// The least angle of smooth ground from the sun's middle along the first piece of a line (search.least), as far as that is above the disc's
// lower edge. Nothing is seen where it takes too many cells.
float smooth_least(SunLine line, CastStart start, CastPiece piece, CastSearch search) {
    uint level = start.level;
    float t_m = 0.0, step_m = cast_step_m(piece);
    bool has_ground = true;
    SmoothSearch seen = SmoothSearch(nothing_hidden_rad, 0.0);
    for (int i = 0; i < smooth_cells_max; ++i) {
        ivec2 post = search.post + whole_signed(floor(piece.at + (t_m + step_m) * piece.per_m));
        SmoothCell found;
        if (any(lessThan(post, ivec2(0))) || any(greaterThanEqual(post, ivec2(FRAME.last_row, FRAME.last_column)))) return seen.least;
        if (!smooth_cell(start, post, search.base, level, found)) return seen.least;
        if (i == 0) seen.here_m = smooth_at_m(found, share_of_cell(piece, found.cell, search.post, t_m));
        float out_m = way_out_of(piece, as_floats(found.cell.from - search.post), as_floats(found.cell.to - search.post));
        out_m = clamp(out_m, t_m + step_m, max(piece.to_m, t_m + step_m));
        CellCrossing crossing = crossing_of(piece, found.cell, search.post, t_m, out_m);
        // Ground is looked at where the line leaves it; behind a void, where the line comes to it, too.
        [[unroll]] for (int k = 0; k < 3; ++k) {
            if (k == 0 ? has_ground : k == 1 && !crossing.crosses) continue;
            float at_m = k == 0 ? t_m : k == 1 ? crossing.diagonal_m : out_m;
            bool there = look_at_smooth(line, piece, found, level, at_m, k < 2 ? crossing.west_before : crossing.west_after, k == 1, search, seen);
            if (k == 2) has_ground = there;
        }
        t_m = out_m;
        if (t_m >= piece.to_m || seen.least <= -sun_radius_rad) return seen.least;
    }
    return -nothing_hidden_rad;
}

// Takes back what triangles hide in the first piece of a line, as far as the smooth ground hides less. True where they had stopped it, and
// it goes on.
bool sees_smooth_ground(SunLine line, CastStart start, CastPiece piece, float smoothly, inout CastSearch search) {
    if (search.least >= nothing_hidden_rad) return false;
    bool was_stopped = search.least <= -sun_radius_rad;
    float hidden = max(search.least, -nothing_hidden_rad), seen = max(hidden, smooth_least(line, start, piece, search));
    search.least = mix(hidden, seen, smoothly);
    search.is_above = false;
    return was_stopped && search.least > -sun_radius_rad;
}
