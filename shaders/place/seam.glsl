// What a page of a seam (core/seam) holds beside the places of its quads' posts: in the row and the column after each quad, unit vectors
// along the axes of ECEF. Needs frame.glsl.

uvec2 quad_of_post(uvec2 post) { return post / seam_stride * seam_stride; }

vec3 vector_of_quad(FramePage page, uvec2 post) {
    PlacesOfPages places = PlacesOfPages(page.places);
    uint first = 3u * (post.x * page_posts + post.y);
    return vec3(places.at[0].steps[first], places.at[0].steps[first + 1u], places.at[0].steps[first + 2u]) / seam_unit;
}

// How far what closes gaps reaches beyond its own posts: by as many pixels as what lies on both sides may be off, one way for a quad's
// first row, another for its second. position: from the eye, along the axes of ECEF, metres.
vec3 gap_reach_m(FramePage page, uvec2 post, vec3 position) {
    uvec2 quad = quad_of_post(post);
    // A metre is the more pixels the farther it lies from the picture's middle: levels leave out the less (levels.glsl).
    precise float away_m = length(position), depth_m = -(FRAME.view_from_ecef * position).z;
    precise float stretch = min(depth_m > 0.0 ? away_m * away_m / (depth_m * depth_m) : 1.0e30, 1.0 + FRAME.corner_tangent * FRAME.corner_tangent);
    precise float reach_m = max(FRAME.tau_px, least_gap_px) / FRAME.pixels_per_tangent * away_m / stretch;
    return reach_m * vector_of_quad(page, quad + uvec2(2u, post.x == quad.x ? 1u : 2u));
}

// The smooth ground's normal at a post of a quad, along the axes of ECEF.
vec3 seam_normal(FramePage page, uvec2 post) {
    uvec2 quad = quad_of_post(post), in_quad = post - quad;
    bool second = (page.cull & is_skirt) != 0u ? in_quad.y == 1u : in_quad.x == 1u;
    if ((page.cull & is_skirt) == 0u && in_quad == uvec2(1u, 1u)) return vector_of_quad(page, quad + uvec2(2u, 0u));
    return vector_of_quad(page, quad + uvec2(second ? 1u : 0u, 2u));
}
