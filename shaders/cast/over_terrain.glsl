// What a place on a grid's own ground sees of the sun, where no other grid takes it. Needs shadow.glsl.

float sun_over_terrain(CastStart start) {
    CastSearch search = search_from(start);
    float light = light_on_start(start);
    SunLine line = sun_line(start.at);
    CastPiece piece = CastPiece(0.0, 0.0, start.point.beyond, line.a1.xy * line.per_m);
    search.lift_m += smooth_lift_m(line, piece, start.cell, start.level, start.point, start.west);
    for (int i = 0; i < 500 && piece.from_m < line.length_m; ++i) {
        piece.to_m = min(piece.from_m + cast_piece_m, line.length_m);
        vec2 end = start.point.beyond + along(line, piece.to_m).xy;
        piece.per_m = (end - piece.at) / (piece.to_m - piece.from_m);
        if (!look_along(line, piece, start.error_m, start.level, search)) break;
        piece.from_m = piece.to_m;
        piece.at = end;
    }
    return kept_share(search, light);
}
