// Exact placement of posts in float32. Needs frame.glsl and select.glsl.
// Every expression is `precise`: the same post gives the same bits in every workgroup and shader that asks for it.

float post_dh(PageBlocks block, uint row, uint column) {
    return block.at[0].dh[(row + 1u) * height_stride + column + 1u];
}

bool is_void(float dh) { return dh < void_dh_limit_m; }

// Position in the page frame, relative to the page's origin; within 1 mm on pages up to 4 km, 2 mm up to 12 km.
vec3 place_in_page(PageBlocks block, uint row, uint column, float dh) {
    RowTerms t = block.at[0].rows[row];
    ColumnTerms u = block.at[0].columns[column];
    precise float r = t.P + dh * t.C;
    precise vec3 position;
    position.x = (t.R + dh * t.C) - r * u.V;
    position.y = r * u.W;
    position.z = t.Z + dh * t.S;
    return position;
}

// Position of a rim post relative to the eye, ECEF axes: the same bits whichever of its pages asks.
vec3 place_on_rim(PageBlocks block, uint row, uint column) {
    BorderPost post = block.at[0].borders[border_index(row, column)];
    precise vec3 offset = (post.high - FRAME.eye_high) + (post.low - FRAME.eye_low);
    return offset;
}

bool on_rim(uint row, uint column) {
    return row == 0u || column == 0u || row == page_quads || column == page_quads;
}

// Position in view coordinates. row and column count within the page.
vec3 place_in_view(PageBlocks block, FramePage page, uint row, uint column, float dh) {
    precise vec3 position;
    if (on_rim(row, column)) {
        position = FRAME.view_from_ecef * place_on_rim(block, row, column);
    } else {
        position = page.view_from_page * place_in_page(block, row, column, dh) + page.origin_view;
    }
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
