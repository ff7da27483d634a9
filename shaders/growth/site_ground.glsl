// The ground under sites, for the rule of materials or a map of land cover, and what it sees of the sun. Needs growth.glsl, ground.glsl,
// cast/start.glsl and the constants `casts`, `draped` and `by_means`.

// The ground under a site, for the rule of materials.
SurfacePoint ground_of(SitePlace place) {
    FramePage page = frame_pages().at[place.page];
    PageBlocks block = PageBlocks(page.block);
    SurfacePoint point;
    point.view = place.view;
    point.post = place.post;
    point.page = place.page;
    point.region = vec2(place.whole) + place.part;
    point.h_m = place.h_m;
    point.H_m = point.mean_H_m = (place.h_m - undulation_at(point.region)) / FRAME.exaggeration;
    point.normal = normal_at(block, page, place.post);
    point.smooth_normal = point.normal;
    RowTerms row = RowTable(FRAME.row_terms).at[page.row_terms + uint(place.post.x)];
    point.lat_deg = degrees(atan(row.S, row.C));
    point.snow_line_m = snow_line_m(point.lat_deg);
    point.wide_level = 0.0;
    point.parts = 0;
    point.post_m = block.at[0].row_spacing_m;
    point.hollow_m = by_means ? hollow_m_at(point, length(place.view) / FRAME.pixels_per_tangent) : 0.0;
    return point;
}

// Of a map of land cover: the finest of its texels that is here.
MaterialShares shares_of_texel(uint texel, inout float known) {
    MaterialShares shares;
    for (uint i = 0u; i < material_count; ++i) shares.of[i] = 0.0;
    for (; texel != 0u; texel >>= 8u) {
        uint ground = texel & 15u;
        if (ground == cover_unknown) continue;
        float share = float((texel >> 4u) & 15u) / 15.0;
        uint materials = DrapeTiles(FRAME.drape.tiles).at[FRAME.drape.tile_mask + 2u + ground].texels.x;
        shares.of[materials & 255u] += share * (1.0 - pixel_second);
        shares.of[(materials >> 8u) & 255u] += share * pixel_second;
        known += share;
    }
    return shares;
}
// Of all that is here of it; point: where its noise is looked for.
uint texel_of_map(SitePlace place, SurfacePoint point) {
    point.drape_post = place.whole;
    point.drape_part = place.part;
    ivec2 levels = cover_levels(), whole;
    vec2 part;
    cover_tap(point, DrapeFootprint(1, vec2(0.0), levels.x, 0.0), 0, levels, whole, part);
    for (int level = levels.x; level <= levels.y; ++level) {
        DrapeSpot spot = cover_spot(whole, part, level);
        uvec2 texels;
        if (!drape_find(spot, texels)) continue;
        if (texels == uvec2(0u)) break;
        uvec2 at = uvec2(clamp(spot.texel + 1.0, vec2(0.0), vec2(float(drape_stride) - 1.0)));
        return DrapeTexels(texels).at[at.x * drape_stride + at.y];
    }
    return 0u;
}
MaterialShares shares_by_map(SitePlace place, SurfacePoint point, out float known) {
    known = 0.0;
    return shares_of_texel(texel_of_map(place, point), known);
}

// What a place so high over a site sees of the sun past the terrain.
float sun_on_site(SitePlace place, SurfacePoint point, float lift_m) {
    if (!casts) return 1.0;
    CastPoint at_tree;
    at_tree.post = place.whole;
    at_tree.beyond = place.part;
    at_tree.distance_m = length(place.view);
    at_tree.level = frame_pages().at[place.page].level;
    CastPoint shown_point = cast_point(place.page * (meshlets_per_page * meshlet_triangles), point);
    at_tree.latitude = shown_point.latitude;
    at_tree.longitude = shown_point.longitude;
    CastStart start;
    if (!starts_on_ground(at_tree, start)) return 1.0;
    CastSearch search = search_from(start);
    search.lift_m = lift_m;
    uint level = start.level;
    SunLine line = sun_line(start.at);
    CastPiece piece = CastPiece(0.0, 0.0, at_tree.beyond, line.a1.xy * line.per_m);
    for (int i = 0; i < 500 && piece.from_m < line.length_m; ++i) {
        piece.to_m = min(piece.from_m + cast_piece_m, line.length_m);
        vec2 end = at_tree.beyond + along(line, piece.to_m).xy;
        piece.per_m = (end - piece.at) / (piece.to_m - piece.from_m);
        if (!look_along(line, piece, start.error_m, level, search) || search.least <= -sun_radius_rad) break;
        piece.from_m = piece.to_m;
        piece.at = end;
    }
    return disc_share(search.least);
}
