// What a place on a grid's own ground sees of the sun, where no other grid takes it. Needs smooth.glsl.

float sun_over_terrain(CastStart start) {
    CastSearch search = search_from(start);
    float light = light_on_start(start);
    uint level = start.level;
    SunLine line = sun_line(start.at);
    CastPiece piece = CastPiece(0.0, 0.0, start.point.beyond, line.a1.xy * line.per_m);
    float smoothly = smoothness(start);
    for (int i = 0; i < 500 && piece.from_m < line.length_m; ++i) {
        bool is_smooth = i == 0 && smoothly > 0.0;
        piece.to_m = min(piece.from_m + (is_smooth ? smooth_way_m(start, piece.per_m) : cast_piece_m), line.length_m);
        vec2 end = start.point.beyond + along(line, piece.to_m).xy;
        piece.per_m = (end - piece.at) / (piece.to_m - piece.from_m);
        bool goes_on = look_along(line, piece, start.error_m, level, search);
        if (is_smooth && sees_smooth_ground(line, start, piece, smoothly, search)) goes_on = true;
        if (!goes_on || search.least <= -sun_radius_rad) break;
        piece.from_m = piece.to_m;
        piece.at = end;
    }
    return kept_share(search, light);
}
