// Where the ground that a pixel shows ends before its neighbour, from the triangles themselves. Needs frame.glsl, levels.glsl,
// place.glsl and surface.glsl.

// A straight rim of the ground on the picture: pixels, from the middle of the pixel that shows the ground.
struct Rim {
    vec2 at;
    vec2 inward;  // unit vector, towards the ground
};
const int rim_triangles = 16;  // that are followed

// A triangle of a page's grid: two in each cell, as quad_posts has them.
struct GridTriangle {
    ivec2 cell;  // row, column
    uint odd;
};

const uint corners_here = 0u;
const uint corners_none = 1u;     // no such triangle is drawn
const uint corners_unknown = 2u;  // another page has it, or it is behind the eye

// Where posts of a page are on the picture, in pixels from `origin`.
uint corners_px(FramePage page, uvec2 posts[3], vec2 origin, out vec2 corners[3]) {
    vec2 half_size = 0.5 * vec2(FRAME.width_px, FRAME.height_px);
    for (int i = 0; i < 3; ++i) corners[i] = vec2(0.0);
    for (int i = 0; i < 3; ++i) {
        int height = post_height(PageBlocks(page.block), posts[i]);
        if (height == void_height) return corners_none;
        vec4 clip = project(place_in_view(page, posts[i], height));
        if (clip.w < FRAME.near_m) return corners_unknown;
        corners[i] = clip.xy / clip.w * half_size + (half_size - origin);
    }
    return corners_here;
}

// Of a quad that another page may have: as if it fell.
bool sw_ne_in(FramePage page, ivec2 cell) {
    return all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, ivec2(page_quads))) && sw_ne_at(PageBlocks(page.block), uvec2(cell));
}

uint corners_of_grid_px(FramePage page, GridTriangle triangle, vec2 origin, out vec2 corners[3]) {
    ivec2 in_region = ivec2(page.first_row, page.first_column) + (triangle.cell << page.level);
    if (any(lessThan(in_region, ivec2(0))) || any(greaterThanEqual(in_region, ivec2(FRAME.last_row, FRAME.last_column))))
        return corners_none;
    if (any(lessThan(triangle.cell, ivec2(0))) || any(greaterThanEqual(triangle.cell, ivec2(page_quads)))) return corners_unknown;
    uvec2 posts[3];
    quad_posts(uvec2(triangle.cell), sw_ne_in(page, triangle.cell), triangle.odd, posts[0], posts[1], posts[2]);
    return corners_px(page, posts, origin, corners);
}

float crossed(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }
// Twice the area; its sign tells which side of the ground is seen.
float doubled_area_px(vec2 corners[3]) { return crossed(corners[1] - corners[0], corners[2] - corners[0]); }

// The triangle beyond an edge, which goes from corner `edge` to the next.
GridTriangle beyond(FramePage page, GridTriangle triangle, int edge) {
    // Of cells that fall, the western and the eastern triangle, then of those that rise.
    const ivec2 steps[12] = {ivec2(0, -1), ivec2(1, 0), ivec2(0),    ivec2(0),    ivec2(0, 1), ivec2(-1, 0),
                             ivec2(0, -1), ivec2(0),    ivec2(-1, 0), ivec2(1, 0), ivec2(0, 1), ivec2(0)};
    ivec2 to = steps[(sw_ne_in(page, triangle.cell) ? 6u : 0u) + triangle.odd * 3u + uint(edge)];
    // What is beyond a northern edge has it as its southern one.
    uint odd = 1u - triangle.odd;
    if (to.x != 0) odd = sw_ne_in(page, triangle.cell + to) == (to.x < 0) ? 1u : 0u;
    return GridTriangle(triangle.cell + to, odd);
}

// The edge by which the way from the origin along `towards` leaves a triangle, if it does within a pixel; else -1. side: the sign of
// its area.
int edge_out(vec2 corners[3], float side, vec2 towards) {
    int edge = -1;
    float way_px = 1.0 + 1.0 / 128.0;  // triangles are drawn on a grid of 1/256 px
    for (int i = 0; i < 3; ++i) {
        vec2 along = side * (corners[(i + 1) % 3] - corners[i]);
        float falls = -crossed(along, towards), inside = -crossed(along, corners[i]);
        if (falls <= 0.0 || inside >= way_px * falls) continue;
        way_px = inside / falls;
        edge = i;
    }
    return edge;
}

// The edge that goes through the origin, within the grid that triangles are drawn on (1/256 px), or -1.
int edge_at_middle(vec2 corners[3]) {
    for (int i = 0; i < 3; ++i) {
        vec2 along = corners[(i + 1) % 3] - corners[i];
        if (abs(crossed(along, corners[i])) <= length(along) / 128.0) return i;
    }
    return -1;
}

// The triangle that a pixel shows, and where it is in a page's grid.
#ifdef CLUSTERS
// Of a cluster: the triangle of the page that the place is shaded from, at most tau away.
uint first_of_rim(uint id, vec2 middle, out FramePage page, out GridTriangle triangle, out vec2 corners[3]) {
    uvec2 posts[3];
    vec3 at[3];
    float heights_m[3], scale;
    page = corners_of(id, posts, heights_m, at);
    vec2 clip = middle * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    vec2 shares = met_shares(vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0), at, scale);
    float share_a = 1.0 - shares.x - shares.y;
    vec2 post = place_on_page(page, id, posts, vec3(share_a, shares));
    page = frame_pages().at[descend(page_number(id), page, post, length(share_a * at[0] + shares.x * at[1] + shares.y * at[2]))];
    ivec2 cell = clamp(ivec2(floor(post)), ivec2(0), ivec2(int(page_quads) - 1));
    vec2 in_cell = post - vec2(cell);
    bool west = sw_ne_in(page, cell) ? in_cell.x + in_cell.y <= 1.0 : in_cell.x >= in_cell.y;
    triangle = GridTriangle(cell, west ? 0u : 1u);
    return corners_of_grid_px(page, triangle, middle, corners);
}
#else
uint first_of_rim(uint id, vec2 middle, out FramePage page, out GridTriangle triangle, out vec2 corners[3]) {
    uint node = id / meshlet_triangles, meshlet = node % meshlets_per_page, in_node = id % meshlet_triangles;
    page = frame_pages().at[node / meshlets_per_page];
    uvec2 posts[3], cell = first_post(meshlet) + uvec2((in_node >> 1u) / meshlet_quads, (in_node >> 1u) % meshlet_quads);
    triangle_posts(page, meshlet, in_node, edges_of(node), posts[0], posts[1], posts[2]);
    for (int i = 0; i < 3; ++i) posts[i] = vertex_post(page, meshlet, posts[i], edges_of(node));
    triangle = GridTriangle(ivec2(cell), id & 1u);
    return corners_px(page, posts, middle, corners);
}
#endif

// Goes from the middle of a pixel that shows triangle `id` (triangle_id() - 1) to the middle of its neighbour, `towards` a unit vector,
// from triangle to triangle, as far as the first edge beyond which the ground turns its other side to the eye or ends. False where
// there is none, and where it cannot be told: a page ends, or there are too many triangles.
// The first triangle is as it is drawn; those after it are of the page's grid, whatever level is drawn there and however it is
// stitched: all are within tau of the posts.
bool finds_rim(uint id, vec2 middle, vec2 towards, out Rim rim) {
    FramePage page;
    GridTriangle triangle;
    vec2 corners[3];
    uint state = first_of_rim(id, middle, page, triangle, corners);
    float side = sign(FRAME.projection_scale.x * FRAME.projection_scale.y), area = doubled_area_px(corners);
    // A pixel's middle on a rim may show either of its two triangles: both tell the same.
    bool is_behind = state == corners_here && area * side < 0.0;
    for (int i = is_behind ? -1 : 0; i < rim_triangles && state == corners_here && (i < 0 || area * side > 0.0); ++i) {
        int edge = i < 0 ? edge_at_middle(corners) : edge_out(corners, side, towards);
        if (edge < 0) return false;
        vec2 at = corners[edge], along = side * (corners[(edge + 1) % 3] - at);
        // Beside a mesh's triangle there is none of its page's grid.
        if (draws_meshes()) {
            state = corners_none;
            area = 0.0;
        } else {
            triangle = beyond(page, triangle, edge);
            state = corners_of_grid_px(page, triangle, middle, corners);
            area = doubled_area_px(corners);
        }
        if (i >= 0 && (state == corners_none || (state == corners_here && area * side < 0.0))) {
            rim = Rim(at, vec2(-along.y, along.x) / length(along));
            return true;
        }
    }
    return false;
}

// The share of a pixel on the ground's side of a rim. middle: the pixel's, as the rim's place.
float inside_rim(Rim rim, vec2 middle) {
    float away = dot(rim.inward, middle - rim.at), off = abs(away);
    vec2 size = abs(rim.inward);
    float high = max(size.x, size.y), low = min(size.x, size.y), reach = 0.5 * (high + low);
    float share;
    if (off <= 0.5 * (high - low)) share = 0.5 + off / high;
    else if (off >= reach) share = 1.0;
    else share = 1.0 - (reach - off) * (reach - off) / (2.0 * high * low);
    return away >= 0.0 ? share : 1.0 - share;
}
