// Where lines to the sun begin, and what is kept of them. Needs shadow.glsl.

// Where a line begins: a place, its ground, and on which level of casters that was found.
struct CastStart {
    CastPoint point;
    CastFrame at;
    float error_m;  // that casters may have
    uint level;
    CasterCell cell;
    bool west;  // of the cell's two triangles
};

// The sun's rise where the place is decides how much its casters may be off.
float caster_error_m(CastFrame at, float distance_m) {
    return CASTERS.error_per_m * distance_m * clamp(at.sun.z / max(length(at.sun.xy), 1.0e-3), 0.02, 1.0);
}

// On the grid's own ground, as its casters have it; false where they have none.
bool starts_on_ground(CastPoint point, out CastStart start) {
    start.point = point;
    start.at = cast_frame(point, 0.0);
    start.error_m = caster_error_m(start.at, point.distance_m);
    start.level = point.level;
    CasterNode node;
    if (!caster_at(point.post, start.error_m, start.level, node)) return false;
    start.cell = caster_cell(PageBlocks(node.block), start.level, point.post);
    vec2 share = clamp((as_floats(point.post - start.cell.from) + point.beyond) / as_floats(start.cell.to - start.cell.from), 0.0, 1.0);
    start.west = west_of_diagonal(start.cell, share) >= 0.0;
    start.at.h_m = above_base(start.cell, share, start.west, 0);
    return start.at.h_m != no_ground_m;
}

// What a line meets that begins there.
CastSearch search_from(CastStart start) {
    return CastSearch(start.point.post, int(round(start.at.h_m / height_step_m)), 0.02, nothing_hidden_rad, 0.0, 0.0, start.level, 0.0, 0.0, 1.0, true);
}

// How wide the side of a cell is in the picture, and from where on the ground is shaded smoothly (smooth.glsl).
float side_px(CasterCell cell, float distance_m) { return float(cell.to.x - cell.from.x) * CASTERS.row_rad * 6371000.0 * FRAME.pixels_per_tangent / distance_m; }
const float smooth_from_px = 5.0;

// The sun's light on the triangle that a line begins on, 0 to 63; below 0 where it is turned away; 0 where it is shaded smoothly.
float light_on_start(CastStart start) {
    if (side_px(start.cell, start.point.distance_m) > smooth_from_px) return 0.0;
    return floor(63.0 * clamp(-rise_over(begins_per_m(start.at), start.cell, start.west), -1.0, 1.0));
}

// As shares.comp keeps it. A part of the sun stays one, whatever is added to it.
float kept_share(CastSearch search, float light) {
    if (light < 0.0 && search.least <= -sun_radius_rad) return turned_share;
    bool is_part = abs(search.least) < sun_radius_rad;
    return (is_part ? clamp(disc_share(search.least), 1.0e-4, 0.9999) : step(0.0, search.least)) + max(light, 0.0) * share_step;
}
