// Slopes of the smoothed surface, from a page's posts: at each post by Horn's formula, as gdaldem computes them, and bilinear between
// posts. For styles that show the slope itself. Needs surface.glsl's readers of posts.
#ifdef AS_MAP

// A neighbour's height in steps: across from it where it is void, so that the slope goes on; the post's own where both are.
float height_across(PageBlocks block, ivec2 post, ivec2 step, int here) {
    int there = height_or(block, post + step, void_height);
    if (there != void_height) return float(there - here);
    int opposite = height_or(block, post - step, void_height);
    return opposite == void_height ? 0.0 : float(here - opposite);
}

// Rise towards (east, north), metres per metre, at a post of the page.
// Source: B. K. P. Horn, Hill shading and the reflectance map, Proceedings of the IEEE 69(1), 1981: weights 1, 2, 1.
vec2 rise_at_post(PageBlocks block, FramePage page, ivec2 post) {
    int here = height_or(block, post, void_height);
    if (here == void_height) return vec2(0.0);
    float north_west = height_across(block, post, ivec2(-1, -1), here), north = height_across(block, post, ivec2(-1, 0), here);
    float north_east = height_across(block, post, ivec2(-1, 1), here), east = height_across(block, post, ivec2(0, 1), here);
    float south_east = height_across(block, post, ivec2(1, 1), here), south = height_across(block, post, ivec2(1, 0), here);
    float south_west = height_across(block, post, ivec2(1, -1), here), west = height_across(block, post, ivec2(0, -1), here);
    vec2 rise = vec2((north_east + 2.0 * east + south_east) - (north_west + 2.0 * west + south_west),
                     (north_west + 2.0 * north + north_east) - (south_west + 2.0 * south + south_east)) * 0.25;
    // From the one side to the other, in posts of level 0: the last quad of a level is narrower where the region ends, and beyond the
    // end a post stands as far away as the one before it.
    vec2 at = region_post(page, vec2(post)), before = region_post(page, vec2(post - 1)), after = region_post(page, vec2(post + 1));
    vec2 back = at - before, on = after - at;
    vec2 posts = max(mix(on, back, lessThanEqual(on, vec2(0.0))) + mix(back, on, lessThanEqual(back, vec2(0.0))), vec2(1.0));
    float cosine = RowTable(FRAME.row_terms).at[page.row_terms + uint(post.x)].cosine;
    vec2 span_m = vec2(posts.y * max(abs(cosine) * block.at[0].column_spacing_m, 1.0e-3), posts.x * block.at[0].row_spacing_m);
    return height_step_m * rise / span_m;
}

// The same of the geoid's undulation, at a place of the region; metres from one of its posts to the next.
vec2 geoid_rise(vec2 region, vec2 post_m) {
    if (FRAME.undulation.N_m == uvec2(0u)) return vec2(0.0);
    float east = undulation_at(region + vec2(0.0, 1.0)), west = undulation_at(region - vec2(0.0, 1.0));
    float north = undulation_at(region - vec2(1.0, 0.0)), south = undulation_at(region + vec2(1.0, 0.0));
    return 0.5 * vec2(east - west, north - south) / post_m;
}

// Of the heights above sea level, as the data have them: a lake is level. What the steps of drawn heights round off is no slope.
vec3 horn_normal_at(PageBlocks block, FramePage page, vec2 post) {
    ivec2 cell = clamp(ivec2(floor(post)), ivec2(0), ivec2(int(page_quads) - 1));
    vec2 in_cell = post - vec2(cell);
    // One place in the code: four of them are much for a driver to compile.
    vec2 west, north, south;
    for (int i = 0; i < 4; ++i) {
        vec2 rise = rise_at_post(block, page, cell + ivec2(i / 2, i % 2));
        if (i % 2 == 0) west = rise;
        else if (i == 1) north = mix(west, rise, in_cell.y);
        else south = mix(west, rise, in_cell.y);
    }
    float cosine = RowTable(FRAME.row_terms).at[page.row_terms + uint(cell.x)].cosine;
    vec2 post_m = vec2(max(abs(cosine) * block.at[0].column_spacing_m, 1.0e-3), block.at[0].row_spacing_m);
    vec2 rise = mix(north, south, in_cell.x) - geoid_rise(region_post(page, post), post_m);
    float step_m = height_step_m * (FRAME.height_bits == 32u ? 1.0 : float(1u << FRAME.height_shift));
    if (all(lessThan(abs(rise) * 2.0 * post_m * float(1u << page.level), vec2(1.01 * step_m)))) rise = vec2(0.0);
    find_row_turn(block, post);
    return turned_east(normalize(vec3(-rise, 1.0)));
}
#else
vec3 horn_normal_at(PageBlocks block, FramePage page, vec2 post) { return vec3(0.0, 0.0, 1.0); }  // nobody asks for it
#endif
