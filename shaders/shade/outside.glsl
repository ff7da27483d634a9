// Where no terrain is: outside the region the bare Earth at the sea's level, inside it voids. Needs surface.glsl and daylight.glsl.

// Where a direction meets the sea's level near the eye (the geoid there; of an eye that is far from the region, at its rim), as
// bare_earth_m.
float bare_sea_m(vec3 direction, out float horizon) {
    float rise = dot(direction, FRAME.up_view);
    float h_m = max(FRAME.eye_h_m - undulation_at(FRAME.eye_post.post), 1.0), r_m = FRAME.earth_radius_m + FRAME.eye_h_m;
    float along = r_m * rise, c = h_m * (2.0 * r_m - h_m), square = along * along - c;
    horizon = -sqrt(c) / r_m;
    return along < 0.0 && square > 0.0 ? c / (-along + sqrt(square)) : -1.0;
}

// The post (row, column, fractional) below a place near the ellipsoid, of the region or beyond it. Angles from the eye come from
// differences, so that none is taken of two large numbers: error below 1e-6 of the distance, and 15 m where the place is 4 km high.
vec2 region_post_at(vec3 view) {
    EyePost eye = FRAME.eye_post;
    if (HAS_NET) return post_on_net(net_uv(angles_from_eye(view)));
    vec3 straight = view;
    if (FRAME.refraction_per_m != 0.0) straight -= 0.5 * FRAME.refraction_per_m * squared_across(view) * FRAME.up_view;
    // From the foot of the eye's vertical, in its meridian frame: outward, east, along the axis.
    vec3 from_foot = (straight + FRAME.eye_h_m * FRAME.up_view) * FRAME.view_from_eye;
    float cosine = eye.latitude.x, sine = eye.latitude.y;
    if (FRAME.earth_radius_m > 1.0e9) {
        float north_m = from_foot.z * cosine - from_foot.x * sine;
        return eye.post + vec2(-north_m / eye.meridian_m, from_foot.y / (eye.normal_m * cosine)) * eye.per_rad;
    }
    float rho_m = eye.normal_m * cosine, out_m = rho_m + from_foot.x;
    float farther_m = (from_foot.x * (rho_m + out_m) + from_foot.y * from_foot.y) / (length(vec2(out_m, from_foot.y)) + rho_m);
    // On the ellipsoid tan(latitude) = z / (rho (1 - e2)).
    float higher_m = from_foot.z / (1.0 - eye.e2);
    float north_rad = atan(higher_m * cosine - farther_m * sine, eye.normal_m + farther_m * cosine + higher_m * sine);
    return eye.post + vec2(-north_rad, atan(from_foot.y, out_m)) * eye.per_rad;
}

bool is_in_region(vec2 post) {
    float column = post.y - FRAME.eye_post.turn * floor(post.y / FRAME.eye_post.turn);
    return post.x >= 0.0 && post.x <= float(FRAME.last_row) && column <= float(FRAME.last_column);
}

// How far a post lies to the south-east, metres along the diagonal: what the hatch counts by.
float along_diagonal_m(vec2 post) { return dot(post * FRAME.eye_post.post_m, vec2(0.70710678)); }

// How dark a line `off` from its middle is, in pixels.
float line_px(float off_px, float half_width_px) { return clamp(half_width_px + 0.5 - off_px, 0.0, 1.0); }

// The share of stripes in a direction: lines across azimuth and elevation, 12 px apart in the middle of a picture. They come from the
// direction alone, a whole number of them once round, so that tiles of a picture meet.
float stripe_share(vec3 direction) {
    const float apart_px = 17.0;  // along the horizon, and up
    vec3 east = FRAME.view_from_eye * vec3(0.0, 1.0, 0.0), north = cross(FRAME.up_view, east);
    vec2 level = vec2(dot(direction, east), dot(direction, north));
    float up = dot(direction, FRAME.up_view), across = max(length(level), 1.0e-3);
    float round_about = max(round(2.0 * pi * FRAME.pixels_per_tangent / apart_px), 1.0);
    float stripes = atan(level.x, level.y) * round_about / (2.0 * pi) + atan(up, across) * FRAME.pixels_per_tangent / apart_px;
    float px_apart = apart_px * across / sqrt(1.0 + across * across);
    return line_px(abs(stripes - round(stripes)) * px_apart, 0.9);
}

// The share of hatch lines at a place of a direction: lines across the diagonal, tied to latitude and longitude, 14 to 28 px apart
// wherever they are seen from (every second line fades out between), and no closer than posts, so that a void of one post has one.
// Towards the horizon, where they would flicker, and on ground so near that they are far apart, stripes tied to the eye instead.
float hatch_share(vec3 direction, vec3 view, vec2 post) {
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    float rise = -dot(direction, up), on_ground = smoothstep(0.03, 0.12, rise);
    float stripes = rise < 0.8 ? stripe_share(direction) : 0.0;
    if (on_ground <= 0.0) return stripes;
    vec2 pixel = 2.0 / (vec2(FRAME.width_px, FRAME.height_px) * FRAME.projection_scale);
    vec3 ray = direction / -direction.z;
    float horizon, here_m = along_diagonal_m(post), per_px_m = 0.0;
    for (int i = 0; i < 2; ++i) {
        vec3 next_ray = normalize(ray + (i == 0 ? vec3(pixel.x, 0.0, 0.0) : vec3(0.0, pixel.y, 0.0)));
        float distance_m = bare_sea_m(next_ray, horizon);
        if (distance_m < 0.0) return stripes;
        float step_m = along_diagonal_m(region_post_at(distance_m * next_ray)) - here_m;
        per_px_m += step_m * step_m;
    }
    per_px_m = max(sqrt(per_px_m), 1.0e-6);
    float least_m = max(FRAME.eye_post.post_m.x, FRAME.eye_post.post_m.y);
    float octave = max(log2(14.0 * per_px_m), log2(least_m));
    float apart_m = exp2(ceil(octave)), between = ceil(octave) - octave;
    float half_width_px = max(0.9, 0.03 * apart_m / per_px_m);
    float in_lines = here_m / apart_m, off = abs(in_lines - round(in_lines)) * apart_m / per_px_m;
    float off_between = abs(in_lines - floor(in_lines) - 0.5) * apart_m / per_px_m;
    float lines = max(line_px(off, half_width_px), between * line_px(off_between, half_width_px));
    // Azimuths run together below the eye: there lines stay on the ground.
    float far_apart = smoothstep(40.0, 80.0, apart_m / per_px_m) * (1.0 - smoothstep(0.5, 0.8, rise));
    return mix(stripes, lines, on_ground * (1.0 - far_apart));
}

// Drawn h of the region's surface at a post (row, column, fractional), from the finest page that is here; false on a void. The root is
// above every page.
bool surface_h_m(vec2 region, out float h_m) {
    h_m = 0.0;
    if (FRAME.page_count == 0u) return false;
    FramePage page = frame_pages().at[0];
    while (page.parent != no_page) page = frame_pages().at[page.parent];
    vec2 post = page_post(page, region);
    for (;;) {
        uvec2 part = uvec2(greaterThanEqual(post, vec2(float(page_quads) * 0.5)));
        uint child = page.children[part.x * 2u + part.y];
        if (child == no_page) break;
        page = frame_pages().at[child];
        post = clamp(page_post(page, region), vec2(0.0), vec2(float(page_quads)));
    }
    ivec2 cell = clamp(ivec2(floor(post)), ivec2(0), ivec2(int(page_quads) - 1));
    vec2 in_cell = post - vec2(cell);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i / 2, i % 2);
        float weight = (corner.x == 1 ? in_cell.x : 1.0 - in_cell.x) * (corner.y == 1 ? in_cell.y : 1.0 - in_cell.y);
        if (weight < 1.0e-4) continue;
        int height = height_or(PageBlocks(page.block), cell + corner, void_height);
        if (height == void_height) return false;
        h_m += weight * float(height) * height_step_m;
    }
    return true;
}

// A place on a line of sight: its post, with columns counted on from those of the region's middle, and its height.
vec2 post_along(vec3 direction, float distance_m, out float h_m) {
    float r_m = FRAME.earth_radius_m + FRAME.eye_h_m, rise = dot(direction, FRAME.up_view);
    float square = r_m * r_m + distance_m * (2.0 * r_m * rise + distance_m);
    h_m = FRAME.eye_h_m + distance_m * (2.0 * r_m * rise + distance_m) / (sqrt(max(square, 0.0)) + r_m);
    vec2 post = region_post_at(distance_m * direction);
    float turn = FRAME.eye_post.turn, middle = 0.5 * float(FRAME.last_column);
    return vec2(post.x, post.y - turn * round((post.y - middle) / turn));
}

// Where a line of sight, on its way down to the bare ellipsoid at end_m, goes in below the rim of the region's surface: 1 at a wall, its
// distance, and its normal (east, north, up); 0 where it goes in above the ground at the rim, or where that is void; -1 where it
// does not come over the region.
int wall_on_way(vec3 direction, float end_m, out float distance_m, out vec3 normal) {
    const float ceiling_m = 9000.0;
    float r_m = FRAME.earth_radius_m + FRAME.eye_h_m, along = r_m * dot(direction, FRAME.up_view), first_m = 0.0;
    float above_m = FRAME.eye_h_m - ceiling_m * max(FRAME.exaggeration, 1.0);
    if (above_m > 0.0) {
        float c = above_m * (2.0 * r_m - above_m);
        first_m = c / (-along + sqrt(max(along * along - c, 0.0)));
    }
    float h_m, last_h_m;
    vec2 from = post_along(direction, first_m, h_m), to = post_along(direction, end_m, last_h_m);
    float middle = 0.5 * float(FRAME.last_column), turn = FRAME.eye_post.turn;
    from.y -= turn * round((from.y - to.y) / turn);
    vec2 last = vec2(FRAME.last_row, FRAME.last_column), step = to - from;
    // Round the Earth there is no rim in the west and in the east.
    if (last.y > turn - 0.5) { from.y = to.y = middle; step.y = 0.0; }
    step = mix(step, vec2(1.0e-6), lessThan(abs(step), vec2(1.0e-6)));
    vec2 one = -from / step, other = (last - from) / step, near = min(one, other), far = max(one, other);
    int axis = near.x > near.y ? 0 : 1;
    float share = near[axis];
    distance_m = end_m;
    normal = vec3(0.0, 0.0, 1.0);
    if (share > min(min(far.x, far.y), 1.0) || min(far.x, far.y) < 0.0) return -1;
    if (share <= 0.0) return 0;
    // On a straight line the post is not quite linear in the distance.
    float rim = step[axis] > 0.0 ? 0.0 : last[axis];
    vec2 post = from;
    for (int i = 0; i < 4; ++i) {
        distance_m = mix(first_m, end_m, clamp(share, 0.0, 1.0));
        post = post_along(direction, distance_m, h_m);
        post.y -= turn * round((post.y - to.y) / turn);
        share += (rim - post[axis]) / step[axis];
    }
    post[axis] = rim;
    float surface_m;
    if (!surface_h_m(clamp(post, vec2(0.0), last), surface_m)) return 0;
    if (h_m > surface_m + distance_m / FRAME.pixels_per_tangent) return 0;
    float outward = step[axis] > 0.0 ? -1.0 : 1.0;
    normal = axis == 0 ? vec3(0.0, -outward, 0.0) : vec3(outward, 0.0, 0.0);
    if (HAS_NET) normal.xy = mat2(FRAME.net.turn.x, FRAME.net.turn.y, -FRAME.net.turn.y, FRAME.net.turn.x) * normal.xy;
    return 1;
}

// What there is where no ground is: the bare ellipsoid, quiet; hatched where the region has no height; and below its rim, where one
// would see under the ground, a wall that makes a block of it. `view`: the ellipsoid there; moves to the wall.
void look_outside(vec3 direction, inout vec3 view, inout vec3 colour, inout vec3 normal, out float water) {
    water = 0.0;
    float distance_m;
    vec3 wall_normal;
    if (wall_on_way(direction, length(view), distance_m, wall_normal) == 1) {
        if ((FRAME.style.voids.on & voids_with_skirt) == 0u) return;
        view = distance_m * direction;
        normal = wall_normal;
        colour = mix(FRAME.style.voids.colour, FRAME.style.voids.lines, 0.5);
        return;
    }
    vec2 post = region_post_at(view);
    if (!is_in_region(post)) return;
    if (FRAME.style.water.voids_are_sea == 1u) water = 1.0;
    else if ((FRAME.style.voids.on & voids_hatched) != 0u)
        colour = mix(FRAME.style.voids.colour, FRAME.style.voids.lines, hatch_share(direction, view, post));
}

LitPlace bare_place(vec3 direction, float distance_m) {
    vec3 view = distance_m * direction, colour = FRAME.style.no_data_colour, normal = vec3(0.0, 0.0, 1.0);
    float water = 0.0;
    if (FRAME.style.voids.on != 0u || FRAME.style.water.voids_are_sea != 0u) look_outside(direction, view, colour, normal, water);
    vec3 sun = sun_at(view);
    return LitPlace(GroundLight(colour, colour * facing(normal, sun), colour * (0.5 + 0.5 * normal.z)), view, 0.0, sun, water);
}
