// From a triangle id and a pixel's ray back to the place on the surface. Needs frame.glsl and place.glsl.

struct SurfacePoint {
    vec3 view;      // metres
    vec2 post;      // (row, column) within the page, fractional
    float H_m;      // orthometric, not exaggerated
    float h_m;      // above the ellipsoid, as drawn
    vec3 normal;    // east, north, up at the place
};

float dh_or(PageBlocks block, ivec2 post, float otherwise) {
    float dh = block.at[0].dh[uint(post.x + 1) * height_stride + uint(post.y + 1)];
    return is_void(dh) ? otherwise : dh;
}

// Slope at a post towards (south, east), per post. One-sided beside a void.
vec2 slope_at_post(PageBlocks block, ivec2 post) {
    float here = dh_or(block, post, 0.0);
    float north = dh_or(block, post + ivec2(-1, 0), void_dh_m), south = dh_or(block, post + ivec2(1, 0), void_dh_m);
    float west = dh_or(block, post + ivec2(0, -1), void_dh_m), east = dh_or(block, post + ivec2(0, 1), void_dh_m);
    float down_scale = (is_void(north) ? 0.0 : 1.0) + (is_void(south) ? 0.0 : 1.0);
    float right_scale = (is_void(west) ? 0.0 : 1.0) + (is_void(east) ? 0.0 : 1.0);
    float down = (is_void(south) ? here : south) - (is_void(north) ? here : north);
    float right = (is_void(east) ? here : east) - (is_void(west) ? here : west);
    return vec2(down / max(down_scale, 1.0), right / max(right_scale, 1.0));
}

// Normal of the smoothed surface: slopes at the cell's four posts, bilinear between them.
vec3 normal_at(PageBlocks block, vec2 post) {
    ivec2 cell = clamp(ivec2(floor(post)), ivec2(0), ivec2(int(page_quads) - 1));
    vec2 in_cell = post - vec2(cell);
    vec2 north = mix(slope_at_post(block, cell), slope_at_post(block, cell + ivec2(0, 1)), in_cell.y);
    vec2 south = mix(slope_at_post(block, cell + ivec2(1, 0)), slope_at_post(block, cell + ivec2(1, 1)), in_cell.y);
    vec2 slope = mix(north, south, in_cell.x);
    float column_spacing_m = max(block.at[0].rows[uint(cell.x)].P * block.at[0].column_spacing_rad, 1.0e-3);
    return normalize(vec3(-slope.y / column_spacing_m, slope.x / block.at[0].row_spacing_m, 1.0));
}

float undulation_at(PageBlocks block, vec2 post) {
    vec2 share = post / float(page_quads);
    float north = mix(block.at[0].N_m[0], block.at[0].N_m[1], share.y);
    float south = mix(block.at[0].N_m[2], block.at[0].N_m[3], share.y);
    return mix(north, south, share.x);
}

SurfacePoint surface_at(uint id, vec3 ray) {
    uint triangle = id % meshlet_triangles;
    uint meshlet = (id / meshlet_triangles) % meshlets_per_page;
    FramePage page = frame_pages().at[id / (meshlet_triangles * meshlets_per_page)];
    PageBlocks block = PageBlocks(page.block);
    uvec2 corner = uvec2(meshlet / meshlets_per_side, meshlet % meshlets_per_side) * meshlet_quads;
    uvec2 posts[3];
    triangle_posts(triangle, posts[0], posts[1], posts[2]);
    vec3 at[3];
    float dh[3];
    for (int i = 0; i < 3; ++i) {
        posts[i] += corner;
        dh[i] = post_dh(block, posts[i].x, posts[i].y);
        at[i] = place_in_view(block, page, posts[i].x, posts[i].y, dh[i]);
    }
    // Where the ray from the eye (the origin of view coordinates) crosses the triangle's plane.
    // Source: T. Möller, B. Trumbore, Fast, minimum storage ray/triangle intersection, J. Graphics Tools 2(1), 1997.
    vec3 edge_b = at[1] - at[0], edge_c = at[2] - at[0];
    vec3 p = cross(ray, edge_c);
    float determinant = dot(edge_b, p);
    float scale = determinant == 0.0 ? 0.0 : 1.0 / determinant;
    float share_b = clamp(dot(-at[0], p) * scale, 0.0, 1.0);
    float share_c = clamp(dot(ray, cross(-at[0], edge_b)) * scale, 0.0, 1.0 - share_b);
    float share_a = 1.0 - share_b - share_c;

    SurfacePoint point;
    point.view = share_a * at[0] + share_b * at[1] + share_c * at[2];
    point.post = share_a * vec2(posts[0]) + share_b * vec2(posts[1]) + share_c * vec2(posts[2]);
    float h_m = block.at[0].h0_m + share_a * dh[0] + share_b * dh[1] + share_c * dh[2];
    point.h_m = h_m;
    point.H_m = (h_m - undulation_at(block, point.post)) / block.at[0].exaggeration;
    point.normal = normal_at(block, point.post);
    return point;
}
