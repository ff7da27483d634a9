// From a triangle id and a pixel's ray back to the place on the surface. Needs frame.glsl, levels.glsl and place.glsl.

struct SurfacePoint {
    vec3 view;      // metres
    vec2 post;      // (row, column) within the page, fractional
    float H_m;      // orthometric, not exaggerated
    float h_m;      // above the ellipsoid, as drawn
    vec3 normal;    // east, north, up at the place
    float lat_deg;  // where the style asks for it
    float snow_line_m; // H, likewise; of look_for_snow()
    float wide_level;  // likewise: 1 on ground that is level for half a kilometre around, 0 on slopes and crests
    float hollow_m;    // likewise: how much lower it is than the ground around it
    uint shaded_page;  // that it is shaded from,
    vec2 shaded_post;  // ... and where in it: (row, column), fractional
    uint page;         // of the triangle,
    vec2 region;       // the place in the region,
    float post_m;      // and metres from its row to the next: where the pixel has means,
    float column_m;    // ... and from its column to the next
    float mean_H_m; // as H_m, of a part of the pixel's footprint
    int parts;      // of the footprint (footprint.glsl, pixel_ground); 0: the place alone colours the pixel
    bool is_one_place; // one slope stands for its footprint (footprint.glsl, one_place_will_do)
    bool is_left;   // to the other program of the two that share the pixels
    float H_per_px; // how fast H changes on the picture; 0 where no contours are asked for
    float water;    // share of water; 0 where none is looked for
    ivec2 drape_post;  // for images over the ground: (row, column) in the region, whole posts ...
    vec2 drape_part;   // ... and the rest,
    vec2 drape_post_m; // ... metres from a post to the next
    vec3 smooth_normal; // ... and the smooth surface's normal, whatever `normal` is
};

int height_or(PageBlocks block, ivec2 post, int otherwise) {
    int height = stored_height(block, uvec2(post + 1));
    return height == void_height ? otherwise : height;
}

// Number in the region of a place in a page (row, column, fractional): the last quad is narrower where the region ends.
vec2 region_post(FramePage page, vec2 post) {
    vec2 first = vec2(page.first_row, page.first_column), last = vec2(FRAME.last_row, FRAME.last_column);
    float spacing = power_of_two(page.level);
    vec2 whole = floor(post);
    vec2 from = min(first + whole * spacing, last), to = min(first + (whole + 1.0) * spacing, last);
    return from + (post - whole) * (to - from);
}

// The inverse, of a page that begins at a post of the region and has so many of the region's posts from one to the next.
vec2 post_of_page(vec2 first, float spacing, vec2 region) {
    vec2 last = vec2(FRAME.last_row, FRAME.last_column), whole = floor((region - first) / spacing);
    vec2 from = first + whole * spacing, to = min(from + spacing, last);
    return whole + (region - from) / max(to - from, vec2(1.0e-3));
}
vec2 page_post(FramePage page, vec2 region) { return post_of_page(vec2(page.first_row, page.first_column), power_of_two(page.level), region); }

// Goes down to the page that a place is shaded from: posts close enough on the screen, or the finest that is here. Its number; what it
// asks memory for waits for what it asked before, so it asks for the children alone.
uint descend(uint number, FramePage page, inout vec2 post, float distance_m) {
    float spacing_px = PageBlocks(page.block).at[0].row_spacing_m * power_of_two(page.level) * FRAME.pixels_per_tangent / distance_m;
    vec2 region = region_post(page, post), first = vec2(page.first_row, page.first_column);
    float spacing = power_of_two(page.level);
    while (spacing_px > shading_spacing_px) {
        bvec2 part = greaterThanEqual(post, vec2(float(page_quads) * 0.5));
        uint child = frame_pages().at[number].children[(part.x ? 2u : 0u) + (part.y ? 1u : 0u)];
        if (child == no_page) break;
        number = child;
        first += vec2(part) * (spacing * float(page_quads / 2u));
        spacing *= 0.5;
        post = clamp(post_of_page(first, spacing, region), vec2(0.0), vec2(float(page_quads)));
        spacing_px *= 0.5;
    }
    return number;
}

// Slope at a post towards (south, east), metres from one of the region's posts to the next. One-sided beside a void. here: its height;
// around: those of its neighbours in the north, south, west and east.
vec2 slope_at_post(FramePage page, ivec2 post, int here, ivec4 around) {
    bvec4 there = notEqual(around, ivec4(void_height));
    // A void post, where a cell has one: between its neighbours, or none.
    if (here == void_height) there = bvec4(bvec2(there.x && there.y), bvec2(there.z && there.w));
    // A region that goes round the Earth has posts beyond its last: there the spacing is the same on both sides.
    vec2 at = region_post(page, vec2(post));
    vec2 before = region_post(page, vec2(post - 1)), after = region_post(page, vec2(post + 1));
    float spacing = power_of_two(page.level);
    vec2 to_after = vec2(after.x > at.x ? after.x - at.x : spacing, after.y > at.y ? after.y - at.y : spacing);
    vec2 to_before = vec2(at.x > before.x ? at.x - before.x : spacing, at.y > before.y ? at.y - before.y : spacing);
    float down = float((there.y ? around.y : here) - (there.x ? around.x : here));
    float right = float((there.w ? around.w : here) - (there.z ? around.z : here));
    float down_posts = (there.y ? to_after.x : 0.0) + (there.x ? to_before.x : 0.0);
    float right_posts = (there.w ? to_after.y : 0.0) + (there.z ? to_before.y : 0.0);
    return height_step_m * vec2(down / max(down_posts, 1.0), right / max(right_posts, 1.0));
}

// How the rows of the pixel's page are turned from east, towards north: cosine, sine (PageBlock.turn).
vec2 row_turn = vec2(1.0, 0.0);
void find_row_turn(PageBlocks block, vec2 post) {
    if (!HAS_NET) return;
    float angle = dot(block.at[0].turn, vec3(1.0, post));
    row_turn = vec2(cos(angle), sin(angle));
}
// From along the row and back along the column to east and north.
vec3 turned_east(vec3 normal) {
    if (!HAS_NET) return normal;
    return vec3(row_turn.x * normal.x - row_turn.y * normal.y, row_turn.y * normal.x + row_turn.x * normal.y, normal.z);
}
// How many rows and columns so many metres eastwards and northwards are.
vec2 posts_along(vec2 east_north, vec2 post_m) {
    if (!HAS_NET) return vec2(-east_north.y, east_north.x) / post_m;
    return vec2(row_turn.y * east_north.x - row_turn.x * east_north.y, row_turn.x * east_north.x + row_turn.y * east_north.y) / post_m;
}

int height_at(PageBlocks block, ivec2 cell, int row, int column) { return stored_height(block, uvec2(cell + ivec2(row + 1, column + 1))); }

// Normal of the smoothed surface: slopes at the cell's four posts, bilinear between them.
vec3 normal_at(PageBlocks block, FramePage page, vec2 post) {
    ivec2 cell = clamp(whole_signed(floor(post)), ivec2(0), ivec2(int(page_quads) - 1));
    vec2 in_cell = post - vec2(cell);
    // Each height is read once: unpacking it takes some twenty operations.
    int heights[16];
    [[unroll]] for (int i = 0; i < 16; ++i) heights[i] = height_at(block, cell, i / 4 - 1, i % 4 - 1);
    vec2 west, north, south;
    [[unroll]] for (int i = 0; i < 4; ++i) {
        int at = 5 + i / 2 * 4 + i % 2;
        vec2 slope = slope_at_post(page, cell + ivec2(i / 2, i % 2), heights[at], ivec4(heights[at - 4], heights[at + 4], heights[at - 1], heights[at + 1]));
        if (i % 2 == 0) west = slope;
        else if (i == 1) north = mix(west, slope, in_cell.y);
        else south = mix(west, slope, in_cell.y);
    }
    vec2 slope = mix(north, south, in_cell.x);
    float cosine = RowTable(FRAME.row_terms).at[page.row_terms + uint(cell.x)].cosine;
    float column_spacing_m = max(abs(cosine) * block.at[0].column_spacing_m, 1.0e-3);
    find_row_turn(block, post);
    return turned_east(normalize(vec3(-slope.y / column_spacing_m, slope.x / block.at[0].row_spacing_m, 1.0)));
}

// The geoid's undulation at a post of the region.
float undulation_at(vec2 post) {
    if (FRAME.undulation.N_m == uvec2(0u)) return 0.0;
    vec2 size = vec2(FRAME.undulation.rows, FRAME.undulation.columns);
    vec2 node = clamp(FRAME.undulation.first + post * FRAME.undulation.per_post, vec2(0.0), size - 1.0);
    uvec2 low = whole_numbers(min(floor(node), max(size - 2.0, 0.0)));
    uvec2 high = min(low + 1u, uvec2(size) - 1u);
    vec2 share = node - as_floats(low);
    Floats N_m = Floats(FRAME.undulation.N_m);
    uint columns = FRAME.undulation.columns;
    float north = mix(N_m.at[low.x * columns + low.y], N_m.at[low.x * columns + high.y], share.y);
    float south = mix(N_m.at[high.x * columns + low.y], N_m.at[high.x * columns + high.y], share.y);
    return mix(north, south, share.x);
}

#include "shaders/shade/slopes.glsl"

// A map's angle is that of Horn's formula; light alone takes the sharper one.
bool shows_angles() {
    return FRAME.style.colour_by != colour_by_height || FRAME.style.light == light_hillshade || FRAME.style.light == light_relief;
}

#include "shaders/shade/water_share.glsl"
#include "shaders/shade/footprint.glsl"

vec3 across(vec3 along, vec3 v) { return v - dot(v, along) * along; }
// Shares of a triangle's second and third post at the point of its rim that is nearest to a ray from the eye: for pixels at a rim, whose
// ray may pass just beside it (1/256 px). To bound the shares of the plane's point one by one would move it far along a slim triangle.
vec2 rim_shares(vec3 ray, vec3 first, vec3 edge_b, vec3 edge_c) {
    vec3 along = normalize(ray);
    vec3 a = across(along, first), b = across(along, edge_b), c = across(along, edge_c);
    vec3 bc = c - b;
    float on_b = clamp(-dot(a, b) / max(dot(b, b), 1.0e-12), 0.0, 1.0);
    float on_c = clamp(-dot(a, c) / max(dot(c, c), 1.0e-12), 0.0, 1.0);
    float on_bc = clamp(-dot(a + b, bc) / max(dot(bc, bc), 1.0e-12), 0.0, 1.0);
    vec3 off_b = a + on_b * b, off_c = a + on_c * c, off_bc = a + b + on_bc * bc;
    float far_b = dot(off_b, off_b), far_c = dot(off_c, off_c), far_bc = dot(off_bc, off_bc);
    if (far_b <= far_c && far_b <= far_bc) return vec2(on_b, 0.0);
    if (far_c <= far_bc) return vec2(0.0, on_c);
    return vec2(1.0 - on_bc, on_bc);
}

#ifdef CLUSTERS
#include "shaders/clusters/surface_of_cluster.glsl"
#else
// The frame's page that a triangle (triangle_id() - 1) is of.
uint page_number(uint id) { return id / (meshlet_triangles * meshlets_per_page); }

// The corners of a triangle (triangle_id() - 1): posts within the page, heights in metres, and where they are drawn.
FramePage corners_of(uint id, out uvec2 posts[3], out float heights_m[3], out vec3 at[3]) {
    uint meshlet = (id / meshlet_triangles) % meshlets_per_page;
    FramePage page = frame_pages().at[id / (meshlet_triangles * meshlets_per_page)];
    PageBlocks block = PageBlocks(page.block);
    uint edges = edges_of(id / meshlet_triangles);
    triangle_posts(page, meshlet, id % meshlet_triangles, edges, posts[0], posts[1], posts[2]);
    for (int i = 0; i < 3; ++i) {
        posts[i] = vertex_post(page, meshlet, posts[i], edges);
        int height = post_height(block, posts[i]);
        heights_m[i] = float(height) * height_step_m;
        at[i] = place_in_view(page, posts[i], height);
    }
    return page;
}

// A place on a triangle, in its page.
vec2 place_on_page(inout FramePage page, uint id, uvec2 posts[3], vec3 shares) {
    return shares.x * as_floats(posts[0]) + shares.y * as_floats(posts[1]) + shares.z * as_floats(posts[2]);
}
#endif

// What a step of the ray adds to a point's shares of its triangle, times the determinant.
vec2 shares_change(vec3 ray_step, vec3 first, vec3 edge_b, vec3 edge_c, vec2 shares) {
    vec3 p = cross(ray_step, edge_c);
    return vec2(dot(-first, p), dot(ray_step, cross(-first, edge_b))) - shares * dot(edge_b, p);
}

// A place in a page (row, column, fractional) in the region, without the rounding that a large number would bring. Of a seam that of
// region_place().
void drape_place(FramePage page, vec2 post, vec2 region, out ivec2 whole, out vec2 part) {
    if (!has_posts()) {
        vec2 seam_post = floor(region);
        whole = ivec2(seam_post);
        part = region - seam_post;
        return;
    }
    ivec2 first = ivec2(page.first_row, page.first_column), last = ivec2(FRAME.last_row, FRAME.last_column);
    vec2 quad = floor(post);
    ivec2 from = min(first + (ivec2(quad) << page.level), last), to = min(from + (1 << page.level), last);
    vec2 along = (post - quad) * vec2(to - from), posts = floor(along);
    whole = from + ivec2(posts);
    part = along - posts;
}

// Where the ray from the eye (the origin of view coordinates) crosses a triangle's plane, as shares of its second and third post; of a
// ray that passes beside it, where it is nearest. scale: of what changes the shares.
// Source: T. Möller, B. Trumbore, Fast, minimum storage ray/triangle intersection, J. Graphics Tools 2(1), 1997.
vec2 met_shares(vec3 ray, vec3 at[3], out float scale) {
    vec3 edge_b = at[1] - at[0], edge_c = at[2] - at[0];
    vec3 p = cross(ray, edge_c);
    float determinant = dot(edge_b, p);
    scale = determinant == 0.0 ? 0.0 : 1.0 / determinant;
    vec2 shares = vec2(dot(-at[0], p), dot(ray, cross(-at[0], edge_b))) * scale;
    bool within = determinant != 0.0 && shares.x >= 0.0 && shares.y >= 0.0 && shares.x + shares.y <= 1.0;
    return within ? shares : rim_shares(ray, at[0], edge_b, edge_c);
}

// Of a seam: what stands in the page is no place in the region, and its normals are those of its corners.
vec2 region_place(FramePage page, vec2 post, vec3 view) {
    if (!has_posts()) return post_on_net(net_uv(angles_from_eye(view)));
    return region_post(page, post);
}
vec2 pixel_look = vec2(0.0);  // of a pixel that shows a mesh: mesh_look_..., and the tone of its feature
vec3 pixel_file_colour = vec3(0.0);  // ... and the colour there of one whose file states colours: linear light
// Of a mesh's triangle: the light is that of the eye's side.
vec3 normal_of_mesh(FramePage page, uint id, vec3 shares, vec3 at[3]) {
    MeshSurface surface = mesh_surface(MeshWords(page.block), id / meshlet_triangles % meshlets_per_page, id % meshlet_triangles);
    vec3 normal = shares.x * surface.normals[0] + shares.y * surface.normals[1] + shares.z * surface.normals[2];
    vec3 view = shares.x * at[0] + shares.y * at[1] + shares.z * at[2];
    normal = FRAME.view_from_ecef * normal;
    pixel_look = vec2(surface.look, surface.tone);
#ifdef FILE_COLOURS
    if (surface.look == mesh_look_coloured)
        for (int i = 0; i < 3; ++i) {
            uvec3 codes = uvec3(surface.codes[i], surface.codes[i] >> 8, surface.codes[i] >> 16) & 255u;
            pixel_file_colour += shares[i] * linear_from_srgb(vec3(codes) / 255.0);
        }
#endif
    vec3 facing = cross(at[1] - at[0], at[2] - at[0]);
    facing = dot(facing, view) > 0.0 ? -facing : facing;
    normal = dot(normal, facing) < 0.0 ? -normal : normal;
    vec3 on_ground = normalize(normal) * axes_at(view);
    return normalize(vec3(on_ground.xy, max(on_ground.z, 1.0e-3)));
}
vec3 normal_of_seam(FramePage page, uint id, uvec2 posts[3], vec3 shares, float heights_m[3], vec3 at[3]) {
    if (draws_meshes()) return normal_of_mesh(page, id, shares, at);
    vec3 normal = shares.x * seam_normal(page, posts[0]) + shares.y * seam_normal(page, posts[1]) + shares.z * seam_normal(page, posts[2]);
    vec3 view = shares.x * at[0] + shares.y * at[1] + shares.z * at[2];
    normal = FRAME.view_from_ecef * normal;
    float reach_m = FRAME.tau_px / FRAME.pixels_per_tangent * length(view);
    // A step that is more than a line: between a top and the foot below it.
    float step_m = abs(posts[0].y == posts[1].y ? heights_m[0] - heights_m[1] : heights_m[1] - heights_m[2]);
    if ((page.cull & is_skirt) != 0u && step_m > 2.0 * reach_m) {
        vec3 upright = cross(at[1] - at[0], at[2] - at[0]);
        normal = dot(upright, view) > 0.0 ? -upright : upright;
    }
    vec3 on_ground = normalize(normal) * axes_at(view);
    return normalize(vec3(on_ground.xy, max(on_ground.z, 1.0e-3)));
}

// How much H changes from pixel to pixel on a triangle. The shares are quotients of terms linear in the ray: they change, and the height
// with them.
float H_change_per_px(vec3 at[3], vec2 shares, float scale, float heights_m[3]) {
    vec3 edge_b = at[1] - at[0], edge_c = at[2] - at[0];
    vec3 pixel = vec3(2.0 / (vec2(FRAME.width_px, FRAME.height_px) * FRAME.projection_scale), 0.0);
    vec2 along_x = shares_change(vec3(pixel.x, 0.0, 0.0), at[0], edge_b, edge_c, shares) * scale;
    vec2 along_y = shares_change(vec3(0.0, pixel.y, 0.0), at[0], edge_b, edge_c, shares) * scale;
    vec2 rise_m = vec2(heights_m[1] - heights_m[0], heights_m[2] - heights_m[0]);
    return length(vec2(dot(along_x, rise_m), dot(along_y, rise_m))) / FRAME.exaggeration;
}

#ifdef IN_AIR
// Of what a pixel covers: the mean of its four quarters, or the place alone.
float water_of_pixel(FramePage page, vec2 post, SurfacePoint point) {
    bool in_quarters = by_means && point.parts > 0;
    mat2 to_next = mat2(0.0);  // posts of the page to what the next pixels show, to the right and below
    if (in_quarters) {
        vec2 post_m = power_of_two(page.level) * vec2(point.post_m, point.column_m);
        to_next = mat2(posts_along(pixel_ground.to_next[0], post_m), posts_along(pixel_ground.to_next[1], post_m));
    }
    float sum = 0.0;
    for (int i = 0; i < (in_quarters ? 4 : 1); ++i) {
        vec2 at = post;
        if (in_quarters) at = clamp(post + to_next * (0.5 * vec2(i & 1, i >> 1) - 0.25), vec2(0.0), vec2(float(page_quads)));
        sum += water_share(page, at);
    }
    return in_quarters ? 0.25 * sum : sum;
}
#endif

SurfacePoint surface_at(uint id, vec3 ray) {
    uvec2 posts[3];
    vec3 at[3];
    float heights_m[3], scale;
    FramePage page = corners_of(id, posts, heights_m, at);
    vec2 shares = met_shares(ray, at, scale);
    float share_b = shares.x, share_c = shares.y;
    float share_a = 1.0 - share_b - share_c;

    SurfacePoint point;
    point.view = share_a * at[0] + share_b * at[1] + share_c * at[2];
    point.post = place_on_page(page, id, posts, vec3(share_a, share_b, share_c));
    point.h_m = share_a * heights_m[0] + share_b * heights_m[1] + share_c * heights_m[2];
    vec2 region = region_place(page, point.post, point.view);
    float undulation_m = undulation_at(region);
    point.H_m = (point.h_m - undulation_m) / FRAME.exaggeration;
    if (draped) drape_place(page, point.post, region, point.drape_post, point.drape_part);
    point.mean_H_m = point.H_m;
    point.parts = 0;
    point.is_one_place = point.is_left = false;
    uint number = page_number(id);
    if (by_means) average_over_pixel(number, region, undulation_m, point);
    if (point.is_left) return point;
    vec2 post = point.post;
    if (!by_means || in_air || draped) {
        uint shaded = descend(number, page, post, length(point.view));
        if (shaded != number) page = frame_pages().at[shaded];
        number = shaded;
    }
    point.shaded_page = number;
    point.shaded_post = post;
    bool shows_angle = as_map && shows_angles();
    if (draped || (!by_means && !shows_angle)) point.smooth_normal = normal_at(PageBlocks(page.block), page, post);
    if (!by_means && shows_angle) point.normal = horn_normal_at(PageBlocks(page.block), page, post);
    else if (!by_means) point.normal = point.smooth_normal;
    if (!has_posts()) point.normal = point.smooth_normal = normal_of_seam(page, id, posts, vec3(share_a, share_b, share_c), heights_m, at);
    point.lat_deg = point.snow_line_m = point.hollow_m = 0.0;
    point.wide_level = 1.0;
    if ((as_map || in_air) && FRAME.style.colour_by == colour_by_cover) {
        RowTerms row = RowTable(FRAME.row_terms).at[page.row_terms + whole_number(floor(clamp(post.x, 0.0, float(page_quads))))];
        point.lat_deg = degrees(atan(row.S, row.C));
        if (!has_posts()) point.lat_deg = degrees(atan(FRAME.eye_post.latitude.y, FRAME.eye_post.latitude.x) + angles_from_eye(point.view).x);
    }
    point.water = 0.0;
#ifdef IN_AIR
    bool has_water = FRAME.style.water.on == 1u && has_posts();
    // Of near ground all but what may be water is left to the one program, and that to the other.
    if (parts_follow || (parts_alone && point.is_one_place)) point.is_left = (has_water && may_be_water(page, post)) == parts_follow;
    if (point.is_left) return point;
    if (!parts_follow && has_water) point.water = water_of_pixel(page, post, point);
#endif
    if (draped) {
        PageBlocks block = PageBlocks(page.block);
        float cosine = abs(RowTable(FRAME.row_terms).at[page.row_terms + uint(post.x)].cosine);
        point.drape_post_m = vec2(block.at[0].row_spacing_m, max(cosine * block.at[0].column_spacing_m, 1.0e-3));
    }
    point.H_per_px = 0.0;
    if (as_map && FRAME.style.contours.interval_m > 0.0) point.H_per_px = H_change_per_px(at, shares, scale, heights_m);
    return point;
}
