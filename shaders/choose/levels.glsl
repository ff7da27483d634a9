// Which level of a region is drawn where, and how the edges between levels meet. Compiled as GLSL for the GPU and as C++ by
// core/lod/levels.cpp, so that what is tested against brute force is what runs: `precise`, so that both round alike. Needs shared.h.

// Edges of a node that is drawn beside one of the next coarser level.
ORO_CONST uint edge_north = 1u;
ORO_CONST uint edge_east = 2u;
ORO_CONST uint edge_south = 4u;
ORO_CONST uint edge_west = 8u;

// The error of a node that cannot stand for what it covers (see core/lod/node_deviations.h).
ORO_CONST float unfit_error_m = 1.0e30f;

// Upper bound of the distance on the screen, in pixels, between a point and another at most error_m away, when one of the two
// can be seen and either lies in the sphere around both. centre_view: the sphere's, in view coordinates; pixels_per_tangent: half
// the picture's height in pixels / the tangent of half its field of view; corner_tangent: the largest tangent between a ray of
// the picture and its axis. Infinite where nothing can be promised.
//
// From p to p + d the picture moves by f / (w + dw) * (d_xy - (p_xy / w) dw), w the depth: exactly at most
// f e sqrt(1 + t^2) / (w - e) with t = |p_xy| / w. In the sphere w >= z_min (a); and w >= |p| / sqrt(1 + t^2) (b).
// The factors are above the rounding of every term, the centre's own included when it came from a page's frame by floats: what is
// returned is not below the bound in exact arithmetic. core/lod/pyramid.cpp lets errors and radii grow by more than that from a level
// to the next, so that what holds for a node holds for those below it.
ORO_FUNCTION float projected_error_px(vec3 centre_view, float radius, float error_m, float pixels_per_tangent, float corner_tangent) {
    if (error_m <= 0.0f) return 0.0f;
    ORO_PRECISE float across_m = sqrt(centre_view.x * centre_view.x + centre_view.y * centre_view.y);
    ORO_PRECISE float distance_m = sqrt(across_m * across_m + centre_view.z * centre_view.z);
    ORO_PRECISE float slack_m = 1.0e-6f * distance_m + 1.0e-5f * radius;
    ORO_PRECISE float e = error_m * 1.00001f;
    ORO_PRECISE float px = 1.0e30f;
    ORO_PRECISE float z_min_m = -centre_view.z - radius - slack_m;
    if (z_min_m > e) {
        ORO_PRECISE float t = min((across_m + radius + slack_m) / z_min_m, corner_tangent);
        px = min(px, pixels_per_tangent * e * sqrt(1.0f + t * t) / (z_min_m - e));
    }
    ORO_PRECISE float stretch = sqrt(1.0f + corner_tangent * corner_tangent);
    ORO_PRECISE float d_min_m = distance_m - radius - slack_m;
    if (d_min_m > e * stretch) px = min(px, pixels_per_tangent * e * stretch * stretch / (d_min_m - e * stretch));
    return px;
}

// May a node stand for all that it covers? Level 0 always may. Nodes without triangles (radius < 0) are never drawn, and so never
// stand for anything.
ORO_FUNCTION bool node_acceptable(uint level, MeshletBounds bounds, vec3 centre_view, float pixels_per_tangent, float corner_tangent,
                                  float tau_px) {
    if (bounds.radius < 0.0f) return false;
    if (level == 0u) return true;
    return projected_error_px(centre_view, bounds.lod_radius, bounds.error_m, pixels_per_tangent, corner_tangent) <= tau_px;
}

// Whether a quad of a drawn node is split from its south-west to its north-east post, where its page says `rises`: not where two stitched
// edges meet in its south-east corner. Its north-west post is then half way between the two others, and those beside it keep that post.
// cell: (row, column) within the node; quads and edges as below.
ORO_FUNCTION bool drawn_sw_ne(bool sw_ne, uvec2 cell, uvec2 quads, uint edges) {
    const uint corner = edge_south | edge_east;
    return sw_ne && ((edges & corner) != corner || cell.x + 1u != quads.x || cell.y + 1u != quads.y);
}

// Where a post of a drawn node goes: posts that the coarser neighbour does not have go to the one before, by number, so that both
// sides have the same posts. post: (row, column) within the node; quads: (rows, columns) of the node, 8 or fewer where the region
// ends, and its last post stays: every level has it. edges: those beside a coarser node.
ORO_FUNCTION uvec2 stitched_post(uvec2 post, uvec2 quads, uint edges) {
    bool along_row = (post.x == 0u && (edges & edge_north) != 0u) || (post.x == quads.x && (edges & edge_south) != 0u);
    bool along_column = (post.y == 0u && (edges & edge_west) != 0u) || (post.y == quads.y && (edges & edge_east) != 0u);
    uvec2 to = post;
    if (along_row && post.y != quads.y) to.y = post.y & ~1u;
    if (along_column && post.x != quads.x) to.x = post.x & ~1u;
    return to;
}
