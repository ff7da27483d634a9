// What the pixel's place on the ground gets of the sun's light and the sky's, for what shades it. Needs surface.glsl and shadow.glsl.

float shown_share = 1.0;
float sun_share() { return casts ? shown_share : 1.0; }

// The place in the region of a point on a triangle (triangle_id() - 1).
CastPoint cast_point(uint id, SurfacePoint surface) {
    FramePage page = frame_pages().at[id / (meshlet_triangles * meshlets_per_page)];
    ivec2 last = ivec2(FRAME.last_row, FRAME.last_column);
    ivec2 whole = clamp(whole_signed(floor(surface.post)), ivec2(0), ivec2(int(page_quads) - 1));
    vec2 share = surface.post - as_floats(whole);
    CastPoint point;
    ivec2 from = ivec2(page.first_row, page.first_column) + (whole << page.level);
    vec2 beyond = share * vec2(min(from + (1 << page.level), last) - from);
    point.post = min(from + whole_signed(floor(beyond)), last - 1);
    point.beyond = beyond - as_floats(point.post - from);
    point.distance_m = length(surface.view);
    point.level = page.level;
    if (HAS_NET) {
        vec2 from_eye_rad = angles_from_eye(surface.view);
        point.latitude = turned_by(FRAME.eye_post.latitude, from_eye_rad.x);
        point.longitude = turned_by(vec2(1.0, 0.0), from_eye_rad.y);
        return point;
    }
    RowTable rows = RowTable(FRAME.row_terms);
    ColumnTable columns = ColumnTable(FRAME.column_terms);
    uint row = page.row_terms + uint(whole.x), column = page.column_terms + uint(whole.y);
    point.latitude = mix(vec2(rows.at[row].C, rows.at[row].S), vec2(rows.at[row + 1u].C, rows.at[row + 1u].S), share.x);
    vec2 turn = mix(vec2(columns.at[column].V, columns.at[column].W), vec2(columns.at[column + 1u].V, columns.at[column + 1u].W), share.y);
    point.longitude = vec2(1.0 - turn.x, turn.y);
    return point;
}

float open_share = 1.0;
float sky_share() { return opens ? open_share : 1.0; }

// Between the corners of the nodes of the page that the place is shaded from (surface.glsl, descend).
float sky_openness(SurfacePoint surface) {
    uint number = surface.shaded_page;
    vec2 post = surface.shaded_post;
    if (by_means && !in_air && !draped) number = descend(number, frame_pages().at[number], post, length(surface.view));
    vec2 place = post / float(meshlet_quads);
    uvec2 low = min(whole_numbers(floor(place)), uvec2(open_corners - 2u));
    vec2 share = place - as_floats(low);
    CasterShares shares = CasterShares(CASTERS.openness);
    uint i = (number * open_corners + low.x) * open_corners + low.y;
    return mix(mix(shares.at[i], shares.at[i + 1u], share.y), mix(shares.at[i + open_corners], shares.at[i + open_corners + 1u], share.y), share.x);
}
