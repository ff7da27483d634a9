// Lines towards the sun in a frame of several grids: over the terrain of one of them, from the ground of any. Needs smooth.glsl,
// compiled with OTHER_GRIDS, and net.glsl.

// The place of a pixel that another grid shows, among the posts of this one or beyond its rims.
CastPoint point_on_other_grid(CastPlace place) {
    EyePost eye = FRAME.eye_post;
    CastPoint point;
    point.distance_m = place.distance_m;
    point.latitude = turned_by(eye.latitude, place.from_eye_rad.x);
    point.longitude = turned_by(vec2(1.0, 0.0), place.from_eye_rad.y);
    point.level = CASTERS.level_count - 1u;
    vec2 whole = vec2(0.0), part;
    if (HAS_NET) {
        part = clamp(post_on_net(net_uv_at(normalize(point.latitude), normalize(point.longitude))), vec2(-1.0e6), vec2(1.0e6));
    } else {
        // The eye's post may be a large number: what is added to it would be rounded as it is.
        whole = floor(eye.post);
        part = eye.post - whole + vec2(-place.from_eye_rad.x, place.from_eye_rad.y) * eye.per_rad;
        float turned = eye.turn * round((whole.y + part.y - 0.5 * float(FRAME.last_column)) / eye.turn);
        whole.y -= floor(turned);
        part.y -= turned - floor(turned);
    }
    vec2 posts = floor(part);
    point.post = ivec2(whole) + ivec2(posts);
    point.beyond = part - posts;
    return point;
}

// Leaves the part of a piece over the grid and so many posts around it; false where there is none.
bool cut_to_grid(inout CastPiece piece, ivec2 post, float by_posts) {
    vec2 low = vec2(-post) - by_posts, high = vec2(ivec2(FRAME.last_row, FRAME.last_column) - post) + by_posts;
    vec2 per_m = mix(piece.per_m, vec2(1.0e-12), lessThan(abs(piece.per_m), vec2(1.0e-12)));
    vec2 one = (low - piece.at) / per_m, other = (high - piece.at) / per_m, near = min(one, other), far = max(one, other);
    float in_m = max(max(near.x, near.y), 0.0), out_m = min(min(far.x, far.y), piece.to_m - piece.from_m);
    if (in_m >= out_m) return false;
    piece.at += in_m * piece.per_m;
    piece.to_m = piece.from_m + out_m;
    piece.from_m += in_m;
    return true;
}
const float within_rims = -1.0e-3;  // posts: no post beyond the last is asked for

// A straight piece of the line, so long or up to its end; false where it has no length.
bool next_piece(SunLine line, vec2 beyond, float from_m, float long_m, float end_m, out CastPiece piece) {
    piece.from_m = from_m;
    piece.to_m = min(from_m + long_m, end_m);
    piece.at = beyond + along(line, from_m).xy;
    piece.per_m = (beyond + along(line, piece.to_m).xy - piece.at) / (piece.to_m - piece.from_m);
    return piece.to_m > from_m;
}

// Fits a line where it passes over a grid on a net. False where it does not.
bool fit_over_net(CastStart start, inout SunLine line, inout float from_m, inout float end_m) {
    float first_m = -1.0, last_m = 0.0, around = 2.0 + 0.02 * float(max(FRAME.last_row, FRAME.last_column));
    CastPiece piece;
    float at_m = from_m;
    for (int i = 0; i < 500 && at_m < end_m && next_piece(line, start.point.beyond, at_m, cast_piece_m, end_m, piece); ++i) {
        at_m = piece.to_m;
        if (!cut_to_grid(piece, start.point.post, around)) continue;
        if (first_m < 0.0) first_m = piece.from_m;
        last_m = piece.to_m;
    }
    if (first_m < 0.0 || last_m <= first_m) return false;
    from_m = first_m;
    end_m = last_m;
    line_begins_m = from_m;
    line_begins_at = towards_sun_m(start.at, from_m);
    float third_m = (end_m - from_m) / 3.0;
    line.per_m = 1.0 / (end_m - from_m);
    fit(line, towards_sun_m(start.at, from_m + third_m) - line_begins_at, towards_sun_m(start.at, from_m + 2.0 * third_m) - line_begins_at,
        towards_sun_m(start.at, end_m) - line_begins_at);
    return true;
}

// The share of the sun's disc that a place sees over this grid's terrain.
float sun_from(CastStart start, bool is_own) {
    CastSearch search = search_from(start);
    uint level = start.level;
    SunLine line = sun_line(start.at);
    float from_m = 0.0, end_m = line.length_m, light = 0.0;
    // Ground of another grid is as high as that grid's casters have it; this grid's may be off from it by a tenth of a pixel's way of the
    // line, and would hide the sun from what lies along its rim. And the first look at this grid's terrain is no step from what was before.
    if (!is_own) {
        from_m = 3.0 * CASTERS.error_per_m * start.point.distance_m;
        search.last_m = -1.0e9;
        search.is_above = false;
    }
    if (!is_own && HAS_NET && !fit_over_net(start, line, from_m, end_m)) return 1.0;
    float smoothly = is_own ? smoothness(start) : 0.0;
    if (is_own) light = min(light_on_start(start), 0.0);
    CastPiece piece;
    for (int i = 0; i < 500; ++i) {
        bool is_smooth = i == 0 && smoothly > 0.0;
        float way_m = is_smooth ? smooth_way_m(start, line.a1.xy * line.per_m) : cast_piece_m;
        if (!next_piece(line, start.point.beyond, from_m, way_m, end_m, piece)) break;
        from_m = piece.to_m;
        float rounded = 2.5e-7 * max(abs(piece.at.x), abs(piece.at.y));
        if (!is_own && !cut_to_grid(piece, start.point.post, within_rims - rounded)) continue;
        bool goes_on = look_along(line, piece, start.error_m, level, search);
        if (is_smooth && sees_smooth_ground(line, start, piece, smoothly, search)) goes_on = true;
        if (search.least <= -sun_radius_rad || (is_own && !goes_on)) break;
    }
    return kept_share(search, light);
}

// On the ground of another grid.
CastStart start_on_other_grid(CastPlace place) {
    CastStart start;
    start.point = point_on_other_grid(place);
    start.at = cast_frame(start.point, place.h_m);
    start.error_m = caster_error_m(start.at, place.distance_m);
    start.level = start.point.level;
    start.cell = CasterCell(ivec2(0), ivec2(1), ivec4(0), false);
    start.west = false;
    return start;
}
