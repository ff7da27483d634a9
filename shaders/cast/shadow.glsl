// How much of the sun's disc a place on the ground sees over the terrain: a line towards its middle is followed over the pages that cast
// shadows, on the finest of levels that matters. Light is parallel and straight, and comes from where the sun is seen from the eye.
// Needs casters.glsl.

// A place on the ground: the post of the region north-west of it, how far it is beyond that (in posts of level 0), where in view
// coordinates, and the terms of its row and column.
struct CastPoint {
    ivec2 post;
    vec2 beyond;
    float distance_m;
    vec2 latitude;   // cosine, sine
    vec2 longitude;  // ... from the eye's
    uint level;      // that it is drawn on
};

// Source: M. Abramowitz, I. Stegun, Handbook of Mathematical Functions, 1964, 4.4.42: Vulkan's own may be off by 4096 ulp.
float small_atan(float y, float x) {
    float v = y / x, s = v * v;
    if (x <= 0.0 || abs(v) > 0.15) return atan(y, x);
    return v * (1.0 - s * (1.0 / 3.0 - s * (1.0 / 5.0 - s * (1.0 / 7.0 - s / 9.0))));
}

// Of the ellipsoid at a place.
struct CastFrame {
    vec3 sun;  // east, north, up
    vec2 latitude;
    vec2 longitude;        // from the eye's
    vec2 uv;               // on a net, and the post there
    vec2 net_post;
    float normal_m;        // radii of curvature: across the meridian,
    float meridian_m;      // ... along it,
    float meridian_change; // ... and how fast that changes, metres a radian
    float h_m;
};

CastFrame cast_frame(CastPoint point, float h_m) {
    const float a_m = 6378137.0, e2 = 0.00669437999;
    vec3 east = FRAME.view_from_eye * vec3(0.0, 1.0, 0.0), up = FRAME.up_view;
    vec3 sun_view = FRAME.style.sun_enu.x * east + FRAME.style.sun_enu.y * cross(up, east) + FRAME.style.sun_enu.z * up;
    vec3 sun = sun_view * FRAME.view_from_eye;  // in the eye's meridian frame
    bool on_net = HAS_NET;
    CastFrame frame;
    frame.latitude = normalize(point.latitude);
    vec2 turn = normalize(point.longitude);
    frame.longitude = turn;
    frame.uv = frame.net_post = vec2(0.0);
    if (on_net) {
        frame.uv = net_uv_at(frame.latitude, turn);
        frame.net_post = post_on_net(frame.uv);
    }
    vec2 level = vec2(turn.x * sun.x + turn.y * sun.y, -turn.y * sun.x + turn.x * sun.y);
    float c = frame.latitude.x, s = frame.latitude.y;
    frame.sun = normalize(vec3(level.y, -s * level.x + c * sun.z, c * level.x + s * sun.z));
    float w2 = 1.0 - e2 * s * s;
    frame.normal_m = a_m / sqrt(w2);
    frame.meridian_m = frame.normal_m * (1.0 - e2) / w2;
    frame.meridian_change = 3.0 * frame.meridian_m * e2 * s * c / w2;
    frame.h_m = h_m;
    return frame;
}

// A place so far towards the sun, from where the line begins: row, column (posts of level 0), height above there. Right to a metre in
// 300 km: the meridian's curve to the third order.
vec3 towards_sun_m(CastFrame at, float t_m) {
    float c = at.latitude.x, s = at.latitude.y;
    vec3 to = t_m * at.sun;
    vec2 meridian = vec2(-s * to.y + c * to.z, c * to.y + s * to.z);
    float rho = (at.normal_m + at.h_m) * c;
    float turned = small_atan(to.x, rho + meridian.x);
    float out_m = (meridian.x * (2.0 * rho + meridian.x) + to.x * to.x) / (length(vec2(rho + meridian.x, to.x)) + rho);
    float north = -s * out_m + c * meridian.y, up = c * out_m + s * meridian.y, radius = at.meridian_m + at.h_m;
    float turn = small_atan(north, radius + up);
    float rise = (up * (2.0 * radius + up) + north * north) / (length(vec2(radius + up, north)) + radius);
    rise -= at.meridian_change * turn * turn * turn / 6.0;
    turn -= at.meridian_change * turn * turn / (2.0 * radius);
    if (HAS_NET) {
        vec2 uv = at.uv + net_uv_change(at.latitude, at.longitude, turn, turned);
        return vec3(post_on_net(uv) - at.net_post, rise);
    }
    return vec3(-turn / CASTERS.row_rad, turned / CASTERS.column_rad, rise);
}

// The line: a cubic through four exact places.
struct SunLine {
    vec3 a1, a2, a3;  // row, column, metres; of the share of the way
    float length_m;
    float per_m;  // 1 / length_m
    float level;  // cosine of the sun's elevation
    bool rises;   // above the disc's lower edge, too, and so all the way
};
#ifdef OTHER_GRIDS
// Of a grid on a net, a line from another grid's ground: fitted where it passes over this one, for beyond its rims the net goes on
// straight, and is only about right.
float line_begins_m = 0.0;
vec3 line_begins_at = vec3(0.0);
vec3 along(SunLine line, float t_m) {
    float share = (t_m - line_begins_m) * line.per_m;
    return line_begins_at + share * (line.a1 + share * (line.a2 + share * line.a3));
}
#else
vec3 along(SunLine line, float t_m) {
    float share = t_m * line.per_m;
    return share * (line.a1 + share * (line.a2 + share * line.a3));
}
#endif

// The cubic through four places of the line, evenly apart.
void fit(inout SunLine line, vec3 f1, vec3 f2, vec3 f3) {
    line.a1 = 9.0 * f1 - 4.5 * f2 + f3;
    line.a2 = -22.5 * f1 + 18.0 * f2 - 4.5 * f3;
    line.a3 = 13.5 * f1 - 13.5 * f2 + 4.5 * f3;
}

// By how much latitude and longitude turn in its first metre, radians.
vec2 turn_per_m(CastFrame at) { return vec2(at.sun.y / (at.meridian_m + at.h_m), at.sun.x / ((at.normal_m + at.h_m) * at.latitude.x)); }
vec2 posts_of_turn(vec2 turn) { return turn * vec2(-1.0 / CASTERS.row_rad, 1.0 / CASTERS.column_rad); }
// What a metre of it is where it begins; on a net nearly.
vec3 begins_per_m(CastFrame at) {
    if (HAS_NET) return towards_sun_m(at, 10.0) / 10.0;
    return vec3(posts_of_turn(turn_per_m(at)), at.sun.z);
}
// That and how it changes will do where the line is short, and not near a pole: within 0.3 m, and 1 cm in height (against exact places,
// 20,000 lines). East, north and up turn with the place, and light keeps its direction.
bool is_short(CastFrame at, float length_m) { return !HAS_NET && length_m < 12000.0 && at.latitude.x > 0.17; }
void begin_short(CastFrame at, inout SunLine line) {
    float c = at.latitude.x, s = at.latitude.y, meridian_m = at.meridian_m + at.h_m, normal_m = at.normal_m + at.h_m;
    vec2 turn = turn_per_m(at);
    float inwards = s * at.sun.y - c * at.sun.z;
    vec2 second = vec2(-(2.0 * at.sun.z * turn.x + s * at.sun.x * turn.y) / meridian_m, 2.0 * turn.y * inwards / (normal_m * c));
    float rise = at.sun.y * turn.x + at.sun.x * at.sun.x / normal_m, half_squared = 0.5 * line.length_m * line.length_m;
    line.a1 = line.length_m * begins_per_m(at);
    line.a2 = half_squared * vec3(posts_of_turn(second), rise);
    line.a3 = vec3(0.0);
}

SunLine sun_line(CastFrame at) {
    // To where even the disc's lower edge is above all terrain.
    float up = at.sun.z - 1.1 * sun_radius_rad, room = max(CASTERS.top_m - at.h_m, 1.0), radius = at.normal_m;
    float root = sqrt(up * up + 2.0 * room / radius);
    SunLine line;
    line.length_m = 1.02 * (up > 0.0 ? 2.0 * room / (up + root) : radius * (root - up));
    line.per_m = 1.0 / line.length_m;
    line.level = max(length(at.sun.xy), 0.02);
    line.rises = up > 0.01;
    if (is_short(at, line.length_m)) {
        begin_short(at, line);
        return line;
    }
    vec3 places[3];
    [[unroll]] for (int i = 0; i < 3; ++i)
        places[i] = towards_sun_m(at, i == 0 ? line.length_m / 3.0 : i == 1 ? line.length_m * 2.0 / 3.0 : line.length_m);
    fit(line, places[0], places[1], places[2]);
    return line;
}

// The node of the coarsest level that is good enough for a place, or of the finest that is there; false where there is none. level: where
// to begin to look, and what was found.
bool caster_at(ivec2 post, float error_m, inout uint level, out CasterNode node) {
    const uint top = CASTERS.level_count - 1u;
    level = min(level, top);
    uint page = caster_page(level, post);
    while (page == no_page && level < top) page = caster_page(++level, post);
    if (page == no_page) return false;
    node = CasterNodes(CASTERS.nodes).at[caster_node(page, level, post)];
    // Errors grow from level to level: one of the two, or none.
    while (node.error_m > error_m && (node.flags & node_has_finer) != 0u) {
        --level;
        node = CasterNodes(CASTERS.nodes).at[caster_node(caster_page(level, post), level, post)];
    }
    while (node.above_error_m <= error_m) {
        ++level;
        node = CasterNodes(CASTERS.nodes).at[caster_node(caster_page(level, post), level, post)];
    }
    return true;
}

// Which straight piece of the line is followed: within 0.3 m of the curve.
ORO_CONST float cast_piece_m = 4000.0;
struct CastPiece {
    float from_m, to_m;
    vec2 at;     // posts from `post` where it begins
    vec2 per_m;  // posts a metre
};

// Where a piece leaves a square of posts, metres.
float way_out_of(CastPiece piece, vec2 low, vec2 high) {
    vec2 rim = mix(low, high, greaterThan(piece.per_m, vec2(0.0)));
    vec2 way = mix((rim - piece.at) / piece.per_m, vec2(1.0e9), lessThan(abs(piece.per_m), vec2(1.0e-12)));
    return piece.from_m + min(way.x, way.y);
}

// So far below the sun's middle the terrain's edge hides nothing of its disc.
const float nothing_hidden_rad = 1.1 * sun_radius_rad;

// How far the terrain's edge is from the sun's middle, seen from the place (radians, negative: above it); at most nothing_hidden_rad.
struct CastSearch {
    ivec2 post;
    int base;      // height where the line begins, steps
    float lift_m;  // ... and so much above that
    float least;
    // Where the terrain was last looked at: how far away, how high, of which level.
    float last_m;
    float last_ground_m;
    uint last_level;
    // Two levels meet with a step, which must not shade what is beside it: the farther one is lowered (or raised) by so much where the line
    // comes to it, and by nothing where it leaves the node.
    float step_m;
    float step_from_m;
    float step_to_m;
    bool is_above;  // the line is over the ground where it comes to the next node, by what was looked at so far
};

// A place of a piece in a cell, of 1, from its north-west; bounded to the cell.
vec2 share_of_cell(CastPiece piece, CasterCell cell, ivec2 post, float t_m) {
    vec2 at = piece.at + (t_m - piece.from_m) * piece.per_m;
    return clamp((at - as_floats(cell.from - post)) / as_floats(cell.to - cell.from), 0.0, 1.0);
}

void look_at_cell(SunLine line, CastPiece piece, CasterCell cell, float t_m, bool west, inout CastSearch search) {
    if (t_m <= 0.0) return;
    float ground_m = above_base(cell, share_of_cell(piece, cell, search.post, t_m), west, search.base);
    if (ground_m == no_ground_m) return;
    search.last_m = t_m;
    search.last_ground_m = ground_m;
    ground_m -= search.step_m * clamp((search.step_to_m - t_m) / (search.step_to_m - search.step_from_m), 0.0, 1.0);
    search.least = min(search.least, (along(line, t_m).z + search.lift_m - ground_m) * line.level / t_m);
}

// A step along a piece that changes the post, and is more than what far places are rounded to.
float cast_step_m(CastPiece piece) {
    float posts_per_m = max(max(abs(piece.per_m.x), abs(piece.per_m.y)), 1.0e-9), step_m = 1.0e-3 / posts_per_m;
#ifdef OTHER_GRIDS
    step_m = max(step_m, 2.5e-7 * max(piece.to_m, max(abs(piece.at.x), abs(piece.at.y)) / posts_per_m));
#endif
    return step_m;
}

// Begins a node of another level than the one before it.
void meet_level(CastPiece piece, CasterCell cell, float t_m, float to_m, bool west, inout CastSearch search) {
    float ground_m = above_base(cell, share_of_cell(piece, cell, search.post, t_m), west, search.base);
    if (ground_m == no_ground_m) return;
    search.step_m = ground_m - search.last_ground_m;
    search.step_from_m = t_m;
    search.step_to_m = to_m;
}

// Where a piece crosses a cell's diagonal between two places on it, if it does, and which triangle it is in before and after.
struct CellCrossing {
    float diagonal_m;
    bool crosses;
    bool west_before;
    bool west_after;
};
CellCrossing crossing_of(CastPiece piece, CasterCell cell, ivec2 post, float t_m, float out_m) {
    vec2 low = as_floats(cell.from - post), size = as_floats(cell.to - post) - low;
    vec2 here = (piece.at + (t_m - piece.from_m) * piece.per_m - low) / size, step = piece.per_m / size;
    float apart = west_of_diagonal(cell, here), change = cell.sw_ne ? -step.x - step.y : step.x - step.y;
    CellCrossing crossing;
    crossing.diagonal_m = change == 0.0 ? -1.0 : t_m - apart / change;
    crossing.crosses = crossing.diagonal_m > t_m && crossing.diagonal_m < out_m;
    crossing.west_before = crossing.crosses ? apart > 0.0 : apart + 0.5 * (out_m - t_m) * change > 0.0;
    crossing.west_after = crossing.crosses != crossing.west_before;
    return crossing;
}

// The terrain's edge as seen along the part of a piece in one node, cell by cell: its triangles are highest against the line where the
// line crosses their sides.
void look_at_node(SunLine line, CastPiece piece, CasterNode node, uint level, float from_m, float to_m, inout CastSearch search) {
    float step_m = cast_step_m(piece);
    float base_m = float(search.base) * height_step_m, per_slope = 1.0 / line.level;
    float t_m = from_m, z_m = along(line, t_m).z + search.lift_m;
    bool meets = level != search.last_level && from_m - search.last_m <= 2.0 * step_m;
    search.last_level = level;
    search.step_m = 0.0;
    search.step_from_m = 0.0;
    search.step_to_m = 1.0;
    // What is left of a node may be less than a step: the next cell is another page's.
    for (int i = 0; i < 40 && t_m + step_m < to_m && search.least > -sun_radius_rad; ++i) {
        vec2 at = piece.at + (t_m + step_m - piece.from_m) * piece.per_m;
        ivec2 post = search.post + whole_signed(floor(at));
        CasterCell cell = unsplit_caster_cell(PageBlocks(node.block), level, post);
        vec2 low = as_floats(cell.from - search.post), high = as_floats(cell.to - search.post);
        float out_m = clamp(way_out_of(piece, low, high), t_m + step_m, to_m), out_z_m = along(line, out_m).z + search.lift_m;
        // Most cells are too low to matter; the last of a node is where the next one goes on.
        int highest = max(max(cell.heights.x, cell.heights.y), max(cell.heights.z, cell.heights.w));
        float matters_m = min(z_m, out_z_m) - (out_m - t_m) * (out_m - t_m) / 5.0e7 - max(search.least, 0.0) * out_m * per_slope;
        bool low_enough = float(highest) * height_step_m - base_m < matters_m && search.step_m == 0.0 && !meets && out_m + step_m < to_m;
        if (!low_enough) {
            cell.sw_ne = caster_sw_ne(PageBlocks(node.block), level, post);
            CellCrossing crossing = crossing_of(piece, cell, search.post, t_m, out_m);
            if (meets) meet_level(piece, cell, t_m, to_m, crossing.west_before, search);
            meets = false;
            // Where the line comes in, crosses the diagonal, out of one triangle and into the other, and leaves.
            [[unroll]] for (int k = 0; k < 4; ++k) {
                if ((k == 1 || k == 2) && !crossing.crosses) continue;
                float at_m = k == 0 ? t_m : k == 3 ? out_m : crossing.diagonal_m;
                look_at_cell(line, piece, cell, at_m, k < 2 ? crossing.west_before : crossing.west_after, search);
            }
        }
        t_m = out_m;
        z_m = out_z_m;
        if (line.rises && z_m - t_m * sun_radius_rad * per_slope > node.top_m - base_m) return;
    }
}

// Follows one piece; false when the rest of the line does not matter.
bool look_along(SunLine line, CastPiece piece, float error_m, inout uint level, inout CastSearch search) {
    const uint top = CASTERS.level_count - 1u;
    float step_m = cast_step_m(piece);
    float t_m = piece.from_m, base_m = float(search.base) * height_step_m, slope = sun_radius_rad / line.level;
    uint page = no_page, page_level = no_page;
    ivec2 page_at = ivec2(0);
    for (int i = 0; i < 4000 && t_m < piece.to_m; ++i) {
        vec2 at = piece.at + (t_m + step_m - piece.from_m) * piece.per_m;
        ivec2 post = search.post + whole_signed(floor(at));
        if (post.x < 0 || post.x >= int(FRAME.last_row)) return false;
        if (post.y < 0 || post.y >= int(FRAME.last_column)) return false;
        ivec2 there = post >> int(level + 7u);
        if (page_level != level || there != page_at) page = caster_page(level, post);
        page_level = level;
        page_at = there;
        if (page == no_page) {
            if (level >= top) return false;
            ++level;
            continue;
        }
        ivec2 node_from = (post >> (int(level) + 3)) << (int(level) + 3);
        float out_m = way_out_of(piece, as_floats(node_from - search.post), as_floats(node_from + (8 << level) - search.post));
        out_m = min(max(out_m, t_m + step_m), piece.to_m);
        CasterNode node = CasterNodes(CASTERS.nodes).at[caster_node(page, level, post)];
        float low_m = min(along(line, t_m).z - t_m * slope, along(line, out_m).z - out_m * slope) - (out_m - t_m) * (out_m - t_m) / 5.0e7;
        low_m += search.lift_m + base_m;
        if (node.top_m < low_m) {
            t_m = out_m;
            if (node.above_top_m < low_m) ++level;
            continue;
        }
        if (node.error_m > error_m && (node.flags & node_has_finer) != 0u) {
            --level;
            continue;
        }
        // The coarsest that is good enough, by whatever way the search came here: so pages that other pixels need change nothing.
        if (node.above_error_m <= error_m) {
            ++level;
            continue;
        }
        // A line that is above gentle ground leaves it behind.
        if (!search.is_above || (node.flags & node_is_gentle) == 0u) {
            look_at_node(line, piece, node, level, t_m, out_m, search);
            if (search.least <= -sun_radius_rad) return false;
            search.is_above = (node.flags & node_has_voids) == 0u;
        }
        t_m = out_m;
    }
    return true;
}

// How much faster a cell's triangle rises towards the sun than the line does, metres a metre. per_m: of the line, row, column, metres.
float rise_over(vec3 per_m, CasterCell cell, bool west) {
    ivec4 h = cell.heights;
    if (h.x == void_height || h.w == void_height || (west ? h.z : h.y) == void_height) return 0.0;
    // Along the triangle's own sides: southwards, eastwards.
    vec2 steps = vec2(west ? h.z - h.x : h.w - h.y, west != cell.sw_ne ? h.w - h.z : h.y - h.x);
    vec2 rise = height_step_m * steps / as_floats(cell.to - cell.from);  // a post
    return dot(rise, per_m.xy) - per_m.z;
}
