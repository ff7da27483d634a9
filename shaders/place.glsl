// Exact placement of posts in float32, relative to the eye. Needs frame.glsl and levels.glsl.
// Every expression is `precise`: the same post gives the same bits in every workgroup and shader that asks for it, and from every
// page and level that has it.

int post_height(PageBlocks block, uvec2 post) { return block.at[0].heights[(post.x + 1u) * height_stride + post.y + 1u]; }

// Position in the eye's meridian frame; within 1 mm up to 4 km away, and 1 mm and 3.2e-7 of the distance beyond (0.0005 px).
vec3 place_from_eye(FramePage page, uvec2 post, int height) {
    RowTerms t = RowTable(FRAME.row_terms).at[page.row_terms + post.x];
    ColumnTerms u = ColumnTable(FRAME.column_terms).at[page.column_terms + post.y];
    precise float dh = float(height - FRAME.reference_steps) * height_step_m;
    precise float r = t.P + dh * t.C;
    precise vec3 position;
    position.x = (t.R + dh * t.C) - r * u.V;
    position.y = r * u.W;
    position.z = t.Z + dh * t.S;
    return position;
}

// Position in view coordinates. post: (row, column) within the page.
vec3 place_in_view(FramePage page, uvec2 post, int height) {
    precise vec3 position = FRAME.view_from_eye * place_from_eye(page, post, height);
    return position;
}

// Reversed depth without a far plane: near is 1, infinity 0.
vec4 project(vec3 view) {
    precise vec4 clip;
    clip.w = -view.z;
    clip.x = FRAME.projection_scale.x * view.x + FRAME.projection_shift.x * clip.w;
    clip.y = FRAME.projection_scale.y * view.y + FRAME.projection_shift.y * clip.w;
    clip.z = FRAME.near_m;
    return clip;
}

// The post of a meshlet's vertex (row, column within the meshlet) in its page, after stitching.
uvec2 vertex_post(FramePage page, uint meshlet, uvec2 vertex, uint edges) {
    uvec2 corner = first_post(meshlet);
    if (edges == 0u) return corner + vertex;
    // Quads of the meshlet: 8, or fewer where the region ends.
    uvec2 last = uvec2(FRAME.last_row, FRAME.last_column) + (1u << page.level) - 1u;
    uvec2 quads = min((last >> page.level) - (uvec2(page.first_row, page.first_column) >> page.level) - corner, uvec2(meshlet_quads));
    return corner + stitched_post(vertex, quads, edges);
}
