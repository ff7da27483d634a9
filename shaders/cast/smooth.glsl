// Near the eye a cell is many pixels wide, and the ground is shaded smoothly. There a triangle that is turned away from the sun, or that a
// neighbour hides, would be a dark facet with straight sides. So what lies within a few cells of where a line begins may not hide more
// of the sun as triangles than it does as a smooth surface. Needs start.glsl.

const float all_smooth_px = 24.0;
// From where triangles begin to count as they are, up to where they all do; cells.
const float smooth_cells = 2.0, smooth_end_cells = 4.0;
const float looks_per_cell = 4.0;
const int looks_max = 80;

// 0 where the ground is triangles, 1 where it is shaded smoothly. Nothing is smooth where slopes are not shaded at all.
float smoothness(CastStart start) {
    if (FRAME.style.relief < 0.5) return 0.0;
    return smoothstep(smooth_from_px, all_smooth_px, side_px(start.cell, start.point.distance_m));
}

// How far along the line ground may be smooth, metres, in one piece of it. per_m: posts a metre.
float smooth_way_m(CastStart start, vec2 per_m) {
    float cell_posts = float(1 << start.level) * smooth_end_cells;
    return min(cell_posts / max(max(abs(per_m.x), abs(per_m.y)), 1.0e-9), cast_piece_m);
}

// Source: C. de Boor, A Practical Guide to Splines, 1978, chapter IX: the uniform cubic B-spline. Its slopes at the posts are those that
// are shaded there.
vec4 spline_weights(float at) {
    float rest = 1.0 - at;
    return vec4(rest * rest * rest, 4.0 - 3.0 * at * at * (1.0 + rest), 4.0 - 3.0 * rest * rest * (1.0 + at), at * at * at) / 6.0;
}

// The ground so many posts from where a line begins, on the level that lines meet it on, metres above a height (in steps): of its triangle,
// and of the smooth surface. no_ground_m where there is none. level: where to begin to look.
vec2 ground_at(CastStart start, vec2 beyond, int base, inout uint level) {
    ivec2 moved = ivec2(floor(beyond));
    ivec2 at = start.point.post + moved;
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(FRAME.last_row, FRAME.last_column)))) return vec2(no_ground_m);
    CasterNode node;
    if (!caster_at(at, start.error_m, level, node)) return vec2(no_ground_m);
    PageBlocks block = PageBlocks(node.block);
    CasterCell cell = caster_cell(block, level, at);
    vec2 share = clamp((as_floats(at - cell.from) + beyond - as_floats(moved)) / as_floats(cell.to - cell.from), 0.0, 1.0);
    float flat_m = above_base(cell, share, west_of_diagonal(cell, share) >= 0.0, base);
    if (flat_m == no_ground_m) return vec2(no_ground_m);
    vec4 rows = spline_weights(share.x), columns = spline_weights(share.y);
    uvec2 first = uvec2(at) >> level & 127u;
    float smooth_m = 0.0;
    for (int i = 0; i < 16; ++i) {
        int height = stored_height(block, first + uvec2(i >> 2, i & 3));
        smooth_m += rows[i >> 2] * columns[i & 3] * (height == void_height ? flat_m : float(height - base) * height_step_m);
    }
    return vec2(flat_m, smooth_m);
}

// Where the next look is: a part of a cell farther on, or where another node begins, so that none is passed over.
float next_look_m(CastPiece piece, CastSearch search, float t_m, float step_m, uint level, float cell_m) {
    ivec2 post = search.post + whole_signed(floor(piece.at + (t_m - piece.from_m) * piece.per_m));
    ivec2 node_from = (post >> (int(level) + 3)) << (int(level) + 3);
    float out_m = way_out_of(piece, as_floats(node_from - search.post), as_floats(node_from + (8 << level) - search.post));
    return min(t_m + cell_m / looks_per_cell, max(out_m, t_m) + step_m);
}

// The least angle of smooth ground from the sun's middle along the first piece of a line (search.least); at most `most`, and its negative
// where that takes too many looks.
float smooth_least(SunLine line, CastStart start, CastPiece piece, CastSearch search, float most) {
    uint level = start.level;
    vec2 here = ground_at(start, start.point.beyond, search.base, level);
    float least = most, t_m = 0.0, step_m = cast_step_m(piece), post_m = 1.0 / max(max(abs(piece.per_m.x), abs(piece.per_m.y)), 1.0e-9);
    for (int i = 0; i < looks_max; ++i) {
        float cell_m = float(1 << level) * post_m;
        t_m = next_look_m(piece, search, t_m, step_m, level, cell_m);
        if (t_m >= piece.to_m) return least;
        vec3 at = along(line, t_m);
        vec2 there = ground_at(start, start.point.beyond + at.xy, search.base, level);
        if (there.x == no_ground_m || here.x == no_ground_m) continue;
        vec2 clear = here - there;
        float as_is = smoothstep(smooth_cells, smooth_end_cells, t_m / (float(1 << level) * post_m));
        as_is = max(as_is, smoothstep(smooth_cells / smooth_end_cells, 1.0, t_m / piece.to_m));
        least = min(least, (at.z + search.lift_m + mix(clear.y, clear.x, as_is)) * line.level / t_m);
    }
    return -most;
}

// Takes back what triangles hide in the first piece of a line, as far as the smooth ground hides less. True where they had stopped it and
// do no more.
bool sees_smooth_ground(SunLine line, CastStart start, CastPiece piece, float smoothly, inout CastSearch search) {
    const float most = 1.1 * sun_radius_rad;
    if (search.least >= most) return false;
    bool was_stopped = search.least <= -sun_radius_rad;
    float hidden = max(search.least, -most), seen = max(hidden, smooth_least(line, start, piece, search, most));
    search.least = mix(hidden, seen, smoothly);
    search.is_above = false;
    return was_stopped && search.least > -sun_radius_rad;
}
