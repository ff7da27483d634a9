// What a pixel's colour is made of, averaged over the ground that the pixel covers: FrameStyle.footprint. The squares that it averages
// (PageMeans) are the same whatever level the triangles have, and pass into each other from level to level and across pages. Needs
// surface.glsl's readers of posts.
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer MeansOfPages { PageMeans at[]; };

struct GroundSum {
    vec3 normal;
    vec3 second;  // products of its east and north: xx, xy, yy
    float h_m;    // those of heights are from an origin near by, so that their squares keep their digits
    float hh_m2;
    float share;  // without voids
};
GroundSum no_ground() { return GroundSum(vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0); }

// A square of a page of this frame, (row, column); beyond the four around the page the nearest of them.
void add_square(inout GroundSum sum, uvec2 means, ivec2 square, float share, float origin_m, bool are_posts) {
    uvec2 at = uvec2(clamp(square + int(means_apron), ivec2(0), ivec2(int(means_stride) - 1)));
    uint place = at.x * means_stride + at.y;
    MeansSquare square_of = MeansOfPages(means).at[0].squares[place];
    uint normal = square_of.normal, spread = square_of.spread;
    if (normal == 0u) return;
    vec2 height = unpackHalf2x16(square_of.height);
    uvec2 level = (uvec2(normal, normal >> 11u) & 2047u) ^ 1024u;  // from -1024 on
    vec3 mean = vec3(as_floats(level) - 1024.0, as_float(normal >> 22u)) / means_normal_steps;
    float h_m = height.x - origin_m;
    sum.normal += share * mean;
    sum.h_m += share * h_m;
    sum.share += share;
    if (are_posts) return;  // one by one nothing is spread
    vec2 apart = as_floats(uvec2(spread, spread >> 11u) & 2047u) / means_spread_steps;
    float correlation = float(int(spread) >> 22) / means_correlation_steps;
    sum.second += share * (mean.xxy * mean.xyy + apart.xxy * apart.xyy * vec3(1.0, correlation, 1.0));
    sum.hh_m2 += share * (h_m * h_m + height.y * height.y);
}

// Bilinear between the squares' middles.
void add_squares(inout GroundSum sum, uvec2 means, vec2 place, float origin_m, bool are_posts) {
    vec2 low = floor(place), on = place - low;
    ivec2 first = whole_signed(low);
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i >> 1, i & 1);
        float share = (corner.x == 1 ? on.x : 1.0 - on.x) * (corner.y == 1 ? on.y : 1.0 - on.y);
        add_square(sum, means, first + corner, share, origin_m, are_posts);
    }
}

// Where posts are larger than pixels: quadratic B-splines of the posts' normals, whose slopes have no edge anywhere.
void add_smooth(inout GroundSum sum, uvec2 means, vec2 place, float origin_m) {
    vec2 middle = floor(place + 0.5), off = place - middle;
    vec2 weights[3] = {0.5 * (0.5 - off) * (0.5 - off), 0.75 - off * off, 0.5 * (0.5 + off) * (0.5 + off)};
    ivec2 first = whole_signed(middle) - 1;
    for (int i = 0; i < 9; ++i)
        add_square(sum, means, first + ivec2(i / 3, i % 3), weights[i / 3].x * weights[i % 3].y, origin_m, true);
}

// A page of this frame, and where its squares are: its first post in the region, and how many of those there are from one of its own to the
// next.
struct MeansPage {
    uint number;
    uint level;
    vec2 first;
    float spacing;
};
MeansPage means_page(uint number) {
    uint level = frame_pages().at[number].level;
    return MeansPage(number, level, vec2(frame_pages().at[number].first_row, frame_pages().at[number].first_column), power_of_two(level));
}
uvec2 means_of(MeansPage page) { return frame_pages().at[page.number].means; }

// The page of that level over a place of the region, of those in this frame: the nearest level below and above that is here.
MeansPage page_over(MeansPage page, uint level, vec2 region) {
    while (page.level < level) {
        uint parent = frame_pages().at[page.number].parent;
        if (parent == no_page) break;
        page = means_page(parent);
    }
    while (page.level > level) {
        float half_page = float(page_quads / 2u) * page.spacing;
        bvec2 part = greaterThanEqual(region + 0.5 - page.first, vec2(half_page));
        uint child = frame_pages().at[page.number].children[(part.x ? 2u : 0u) + (part.y ? 1u : 0u)];
        if (child == no_page) break;
        page = MeansPage(child, page.level - 1u, page.first + vec2(part) * half_page, 0.5 * page.spacing);
    }
    return page;
}

// Where a place of the region is among a page's squares.
vec2 among_squares(MeansPage page, vec2 region) { return (region - page.first + 0.5) / page.spacing - 0.5; }

// The ground under a pixel: a parallelogram of posts (row, column).
struct Footprint {
    vec2 region;     // its middle
    vec2 along;      // its longer side
    vec2 across;     // at a right angle to that
    float across_posts;
    float round_posts;  // its width on ground that faces the eye
    mat2 to_next;       // metres east and north to what the next pixels show, to the right and below
};

// East, north and up at a place, as columns, in view coordinates.
mat3 axes_at(vec3 view) {
    vec3 up = normalize(view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    vec3 east = cross(FRAME.view_from_eye * vec3(0.0, 0.0, 1.0), up);
    if (dot(east, east) < 1.0e-12) east = FRAME.view_from_eye * vec3(0.0, 1.0, 0.0);
    east = normalize(east);
    return mat3(east, cross(up, east), up);
}

// From the mean slope there, not the triangle's: triangles smaller than a pixel have any.
Footprint footprint_at(vec3 view, vec2 region, vec3 normal, mat3 axes, vec2 post_m) {
    vec3 ray = view / -view.z, across = axes * normal;
    float facing = dot(across, ray), least = -0.12 * length(ray) * length(across);
    facing = min(facing, least);
    vec2 pixel = 2.0 / (vec2(FRAME.width_px, FRAME.height_px) * FRAME.projection_scale);
    vec3 x = vec3(pixel.x, 0.0, 0.0), y = vec3(0.0, pixel.y, 0.0);
    x = -view.z * (x - ray * (dot(across, x) / facing));
    y = -view.z * (y - ray * (dot(across, y) / facing));
    Footprint foot;
    foot.to_next = mat2(vec2(dot(x, axes[0]), dot(x, axes[1])), vec2(dot(y, axes[0]), dot(y, axes[1])));
    vec2 to_x = posts_along(foot.to_next[0], post_m), to_y = posts_along(foot.to_next[1], post_m);
    float area = abs(to_x.x * to_y.y - to_x.y * to_y.x);
    foot.region = region;
    foot.round_posts = length(view) / (FRAME.pixels_per_tangent * post_m.x);
    foot.along = dot(to_x, to_x) > dot(to_y, to_y) ? to_x : to_y;
    float long_posts = max(length(foot.along), 1.0e-6);
    vec2 direction = foot.along / long_posts;
    foot.across_posts = max(area / long_posts, foot.round_posts);
    foot.along = direction * max(long_posts, foot.round_posts);
    foot.across = vec2(-direction.y, direction.x) * foot.across_posts;
    return foot;
}

// A pixel's mean ground as a plane, and the rays that meet it. Heights are as squares have them: without the exaggeration.
struct MeanPlane {
    vec2 region;    // a place,
    float h_m;      // ... its height there,
    vec2 rise_m;    // and how much it rises from a row to the next, and from a column
    vec2 on_per_m;  // so many rows and columns nearer to the eye a ray meets ground that is a metre higher
    float most_posts;  // no part is moved farther
    float shown;       // how much of it the eye sees: of ground that it looks straight down on 1
};
// to_eye: east, north, up; normal and post_m as for footprint_at().
MeanPlane mean_plane(Footprint foot, vec3 normal, float h_m, vec3 to_eye, vec2 post_m) {
    float facing = max(dot(normal, to_eye), 0.12 * length(normal)), ex = FRAME.exaggeration;
    vec2 rise = -normal.xy / (normal.z * ex), turn = row_turn;
    MeanPlane plane;
    plane.region = foot.region;
    plane.h_m = h_m;
    plane.rise_m = post_m * vec2(turn.y * rise.x - turn.x * rise.y, turn.x * rise.x + turn.y * rise.y);
    plane.on_per_m = ex * normal.z / facing * posts_along(to_eye.xy, post_m);
    // Seen at a grazing angle ground hides what is behind it, and tells less of where rays meet it.
    plane.most_posts = 0.25 * foot.across_posts * smoothstep(0.12, 0.4, facing / length(normal));
    plane.shown = max(dot(normal, to_eye) / normal.z, 0.02);
    return plane;
}
// How far from where a ray meets the plane it meets ground that is so much higher, as steep as the plane.
vec2 on_ray(MeanPlane plane, float higher_m) {
    vec2 on = higher_m * plane.on_per_m;
    return on * min(plane.most_posts / max(length(on), 1.0e-6), 1.0);
}

// How far apart `count` samples of squares lie that together weigh a length of ground as a box of that length does, by the square of its
// spread (a bilinear sample of squares of a length c has c * c / 4). Of posts they are places.
float samples_apart(float posts, float square, int count) {
    float n = float(count);
    if (square < 2.0) return posts / n;
    return count == 1 ? 0.0 : sqrt(max(posts * posts - 3.0 * square * square, 0.0) / (n * n - 1.0));
}

// Of a page of the finest posts that are here: a map's angles by Horn's formula, and light without edges between posts.
vec3 normal_on(MeansPage finest, vec2 region, float origin_m) {
    if (as_map && shows_angles()) {
        FramePage page = frame_pages().at[finest.number];
        return horn_normal_at(PageBlocks(page.block), page, clamp(page_post(page, region), vec2(0.0), vec2(float(page_quads))));
    }
    GroundSum here = no_ground();
    add_smooth(here, means_of(finest), among_squares(finest, region), origin_m);
    return here.share > 0.0 ? normalize(here.normal) : vec3(0.0, 0.0, 1.0);
}
vec3 finest_normal(MeansPage near_page, vec2 region, float origin_m) { return normal_on(page_over(near_page, 0u, region), region, origin_m); }

// Where the parts of a pixel's footprint are among the squares of one level, (row, column).
struct PartsOfLevel {
    uvec2 means;
    bool are_posts;
    vec2 corner;  // the page's first post in the region
    vec2 first;
    vec2 along;   // from a part to the next
    vec2 across;  // ... row
    float spacing;  // how many of the region's posts from a square to the next
};

// What the pixel's colour is a mean of: parts of its footprint, in rows along its longer side.
struct PixelGround {
    mat2 to_next;  // of the footprint
    vec3 to_eye;
    float on;  // towards the next level
    int rows;
    bool are_few;       // so that each may have Horn's slope
    bool smooth_posts;  // where several are beside each other in a pixel nobody sees how they are joined
    MeansPage page;
    MeanPlane plane;
    float origin_m;
    float undulation_m;  // not exaggerated
    PartsOfLevel finer;
    PartsOfLevel coarser;
};
PixelGround pixel_ground;

// Their colours have the strongest contrasts.
bool shows_slopes() { return as_map && FRAME.style.colour_by == colour_by_slope; }
// How large squares are at most.
float squares_px() { return shows_slopes() ? slope_means_px : means_spacing_px; }

PartsOfLevel parts_of_level(Footprint foot, MeansPage near_page, uint level, int rows, int steps) {
    MeansPage page = page_over(near_page, level, foot.region);
    float square = page.spacing, long_posts = length(foot.along);
    vec2 along = foot.along * (samples_apart(long_posts, square, steps) / (long_posts * square));
    vec2 across = foot.across * (samples_apart(foot.across_posts, square, rows) / (foot.across_posts * square));
    vec2 first = among_squares(page, foot.region) - 0.5 * (float(steps - 1) * along + float(rows - 1) * across);
    return PartsOfLevel(means_of(page), square == 1.0, page.first, first, along, across, square);
}

// What a pixel shows of high ground is nearer to the eye than its mean plane has it, and of low ground farther away. How far from a place of
// the plane, in squares, by the ground there.
vec2 shown_from(PartsOfLevel of, vec2 place) {
    // Of a pixel within a post the posts around it say nothing.
    if (of.are_posts && pixel_ground.smooth_posts) return vec2(0.0);
    place = clamp(place, vec2(-float(means_apron)), vec2(float(means_stride - means_apron - 1u)));
    vec2 low = floor(place), on = place - low;
    ivec2 first = whole_signed(low) + int(means_apron);
    float h_m = 0.0;
    for (int i = 0; i < 4; ++i) {
        uvec2 at = min(uvec2(first + ivec2(i >> 1, i & 1)), uvec2(means_stride - 1u));
        MeansSquare there = MeansOfPages(of.means).at[0].squares[at.x * means_stride + at.y];
        if (there.normal == 0u) return vec2(0.0);
        h_m += (i >> 1 == 1 ? on.x : 1.0 - on.x) * ((i & 1) == 1 ? on.y : 1.0 - on.y) * (unpackHalf2x16(there.height).x - pixel_ground.origin_m);
    }
    vec2 region = (place + 0.5) * of.spacing + of.corner - 0.5;
    float plane_m = pixel_ground.plane.h_m + dot(pixel_ground.plane.rise_m, region - pixel_ground.plane.region);
    return on_ray(pixel_ground.plane, h_m - plane_m) / of.spacing;
}

// One of them, from the squares of one level.
GroundSum part_of_level(PartsOfLevel of, int part) {
    int step = part / pixel_ground.rows;
    vec2 place = of.first + float(step) * of.along + float(part - step * pixel_ground.rows) * of.across;
    place += shown_from(of, place);
    GroundSum sum = no_ground();
    if (of.are_posts && pixel_ground.smooth_posts) add_smooth(sum, of.means, place, pixel_ground.origin_m);
    else add_squares(sum, of.means, place, pixel_ground.origin_m, of.are_posts);
    if (!of.are_posts || sum.share <= 0.0) return sum;
    // Posts: one slope and one height.
    vec3 normal = normalize(sum.normal);
    if (as_map && shows_angles() && pixel_ground.are_few)
        normal = finest_normal(pixel_ground.page, of.corner + place, pixel_ground.origin_m);
    sum.normal = sum.share * normal;
    sum.second = sum.share * normal.xxy * normal.xyy;
    sum.hh_m2 = sum.h_m * sum.h_m / sum.share;
    return sum;
}

// Means; the share is that without voids.
GroundSum part_of_pixel(int part) {
    GroundSum sum = no_ground();
    float on = pixel_ground.on;
    for (int i = 0; i < (on > 0.0 ? 2 : 1); ++i) {
        PartsOfLevel level = pixel_ground.finer;
        if (i == 1) level = pixel_ground.coarser;
        GroundSum one = part_of_level(level, part);
        float share = i == 0 ? 1.0 - on : on;
        sum.normal += share * one.normal;
        sum.second += share * one.second;
        sum.h_m += share * one.h_m;
        sum.hh_m2 += share * one.hh_m2;
        sum.share += share * one.share;
    }
    if (sum.share <= 0.0) return sum;
    float scale = 1.0 / sum.share;
    return GroundSum(sum.normal * scale, sum.second * scale, sum.h_m * scale, sum.hh_m2 * scale, sum.share);
}

// The symmetric root of the covariance of a part's normals, east and north: a point of the unit circle's spread, turned into theirs.
mat2 normals_apart(GroundSum part) {
    vec3 of = part.second - part.normal.xxy * part.normal.xyy;
    of.xz = max(of.xz, 0.0);
    float root = sqrt(max(of.x * of.z - of.y * of.y, 0.0));
    float scale = of.x + of.z + 2.0 * root;
    return scale < 1.0e-5 ? mat2(0.0) : mat2(of.x + root, of.y, of.y, of.z + root) / sqrt(scale);
}

vec3 normal_of(vec2 level) {
    float squared = min(dot(level, level), 0.998);
    return normalize(vec3(level * inversesqrt(max(dot(level, level) / squared, 1.0)), sqrt(1.0 - squared)));
}

// Ice lies on level ground that is wide; a level crest has slopes on both sides. From how steep all ground around is on average.
float wide_level_at(SurfacePoint point) {
    float wide_posts = 500.0 / point.post_m;
    MeansPage page = page_over(means_page(point.page), uint(max(log2(wide_posts), 0.0)), point.region);
    float square = page.spacing;
    vec2 middle = among_squares(page, point.region);
    GroundSum around = no_ground();
    uvec2 means = means_of(page);
    // A small region may have no level of such squares.
    int sides = square < 0.5 * wide_posts ? 4 : 1;
    for (int i = 0; i < sides * sides; ++i) {
        vec2 off = (vec2(i / sides, i % sides) - 0.5 * float(sides - 1)) * (wide_posts / (float(sides) * square));
        add_squares(around, means, middle + off, 0.0, false);
    }
    if (around.share <= 0.0) return 1.0;
    float sine2 = min((around.second.x + around.second.z) / around.share, 1.0), up2 = FRAME.exaggeration * FRAME.exaggeration;
    sine2 /= max(sine2 + up2 * (1.0 - sine2), 1.0e-6);
    return 1.0 - smoothstep(0.015, 0.05, sine2);  // 7 and 13 degrees
}

// True where the smooth slope in its middle stands for all of a pixel: the style asks for no more, or, in air, the footprint is narrower than
// from post to post.
bool one_place_will_do(MeansPage near_page, vec2 region, float origin_m, vec2 post_m, inout SurfacePoint point) {
    bool is_asked = FRAME.style.footprint == footprint_finest;
    float round_posts = length(point.view) / (FRAME.pixels_per_tangent * min(post_m.x, post_m.y));
    if (!is_asked && (!in_air || round_posts >= 1.0)) return false;
    MeansPage finest = page_over(near_page, 0u, region);
    if (!is_asked && finest.level > 0u) return false;
    point.normal = normal_on(finest, region, origin_m);
    return is_asked || round_posts < dot(point.normal, normalize(-point.view) * axes_at(point.view));
}

// Takes what the pixel's triangle says of its middle and puts the mean of its footprint in its place. number: of the triangle's page.
void average_over_pixel(uint number, vec2 region, float undulation_m, inout SurfacePoint point) {
    float H_ex = FRAME.exaggeration, origin_m = (point.h_m) / H_ex;
    uvec2 block = frame_pages().at[number].block;
    uint row = min(whole_number(floor(max(point.post.x, 0.0))), page_posts - 1u);
    float cosine = abs(RowTable(FRAME.row_terms).at[frame_pages().at[number].row_terms + row].cosine);
    vec2 post_m = vec2(PageBlocks(block).at[0].row_spacing_m, max(cosine * PageBlocks(block).at[0].column_spacing_m, 1.0e-3));
    find_row_turn(PageBlocks(block), point.post);
    point.page = number;
    point.region = region;
    point.post_m = post_m.x;
    point.column_m = post_m.y;
    MeansPage near_page = means_page(number);
    point.is_one_place = one_place_will_do(near_page, region, origin_m, post_m, point);
    point.is_left = parts_follow && !point.is_one_place;
    if (point.is_one_place || parts_follow) return;
    mat3 axes = axes_at(point.view);
    vec3 to_eye = normalize(-point.view) * axes;
    float round_posts = length(point.view) / (FRAME.pixels_per_tangent * post_m.x);
    uint slope_level = whole_number(floor(log2(max(round_posts, 1.0))));
    MeansPage slope_page = page_over(near_page, slope_level, region);
    GroundSum slope = no_ground();
    add_squares(slope, means_of(slope_page), among_squares(slope_page, region), origin_m, true);
    if (slope.share <= 0.0) {
        point.normal = vec3(0.0, 0.0, 1.0);
        return;
    }
    point.normal = normalize(slope.normal);
    Footprint foot = footprint_at(point.view, region, slope.normal, axes, post_m);
    MeanPlane plane = mean_plane(foot, slope.normal, slope.h_m / slope.share, to_eye, post_m);
    // The pixel's middle is on a peak or in a hollow.
    foot.region += on_ray(plane, plane.h_m);
    float level = log2(squares_px() * foot.across_posts);
    if (as_map && shows_angles() && foot.across_posts < 1.3333) {
        point.normal = finest_normal(near_page, region, origin_m);
        return;
    }
    float whole = max(floor(level), 0.0), on = level < 0.0 ? 0.0 : smoothstep(0.75, 1.0, level - whole);
    float square = exp2(whole);
    int rows = whole_signed(clamp(ceil(foot.across_posts / square - 0.8), 1.0, shows_slopes() ? 11.0 : 6.0));
    int steps = whole_signed(clamp(ceil(length(foot.along) / square - 0.8), float(rows), shows_slopes() ? 16.0 : 8.0));
    PartsOfLevel finer, coarser;
    for (uint i = 0u; i < (on > 0.0 ? 2u : 1u); ++i) {
        PartsOfLevel parts = parts_of_level(foot, slope_page, whole_number(whole) + i, rows, steps);
        if (i == 0u) finer = parts;
        coarser = parts;
    }
    pixel_ground = PixelGround(foot.to_next, to_eye, on, rows, rows * steps <= 40, foot.across_posts < 1.0 && steps < 3, slope_page, plane, origin_m, undulation_m / H_ex, finer, coarser);
    point.parts = rows * steps;
}

// The mean normal of the ground, drawn `relief` times as steep.
vec3 steeper(vec3 normal, float relief) { return normalize(vec3(normal.xy * relief, normal.z)); }

// Cosine between a direction and the ground, 0 where it is turned away.
float facing(vec3 normal, vec3 direction) { return max(dot(normal, direction), 0.0); }
