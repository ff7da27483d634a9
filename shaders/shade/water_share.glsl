// Which ground is water, by its posts. Needs surface.glsl's readers of posts.

const float no_H = -1.0e9;

// H of a post, exaggerated; no_H of a void.
float exaggerated_H(PageBlocks block, FramePage page, ivec2 post) {
    int height = height_or(block, post, void_height);
    return height == void_height ? no_H : float(height) * height_step_m - undulation_at(region_post(page, vec2(post)));
}

// What rounding of heights and of N may make of equal posts.
float level_within_m() { return 0.01 + (FRAME.height_bits == 16u ? 2.0 * height_step_m * float(1u << FRAME.height_shift) : 0.0); }

// Of the 4 x 4 posts around a cell: which of its four corners (north-west, north-east, south-west, south-east) lie in the middle of
// 3 x 3 equal posts; and which of those that are the sea's. H of its north-west post, exaggerated.
float corners_of_water(PageBlocks block, FramePage page, ivec2 cell, out vec4 level, out vec4 sea) {
    float H[16];
    for (int i = 0; i < 16; ++i) H[i] = exaggerated_H(block, page, cell + ivec2(i / 4, i % 4) - 1);
    float low_m = FRAME.style.water.sea_low_H_m * FRAME.exaggeration, high_m = FRAME.style.water.sea_high_H_m * FRAME.exaggeration;
    float within_m = level_within_m();
    for (int corner = 0; corner < 4; ++corner) {
        int first = corner / 2 * 4 + corner % 2;
        float lowest = H[first], highest = lowest, sum = 0.0;
        for (int k = 0; k < 9; ++k) {
            float one = H[first + k / 3 * 4 + k % 3];
            lowest = min(lowest, one);
            highest = max(highest, one);
            sum += one;
        }
        bool whole = lowest > 0.5 * no_H;
        level[corner] = whole && highest - lowest <= within_m ? 1.0 : 0.0;
        // Noise goes both ways: ground that rises from the shore is above it.
        sea[corner] = whole && lowest >= low_m && highest <= high_m && sum <= 9.0 * FRAME.exaggeration ? 1.0 : 0.0;
    }
    return H[5];
}

float between_corners(vec4 corners, vec2 in_cell) { return mix(mix(corners.x, corners.y, in_cell.y), mix(corners.z, corners.w, in_cell.y), in_cell.x); }

ivec2 cell_of(vec2 post) { return clamp(whole_signed(floor(post)), ivec2(0), ivec2(int(page_quads) - 1)); }
// Most ground is told by its cell alone: false where there is no water. N rises by less than a metre a kilometre.
bool may_be_water(FramePage page, vec2 post) {
    PageBlocks block = PageBlocks(page.block);
    ivec2 cell = cell_of(post);
    int lowest = height_or(block, cell, void_height), highest = lowest;
    for (int i = 0; i < 4; ++i) {
        int height = height_or(block, cell + ivec2(i >> 1, i & 1), void_height);
        if (height == void_height) return false;
        lowest = min(lowest, height);
        highest = max(highest, height);
    }
    float cell_m = power_of_two(page.level) * (block.at[0].row_spacing_m + block.at[0].column_spacing_m);
    float sea_m = max(FRAME.style.water.sea_high_H_m - max(FRAME.style.water.sea_low_H_m, -1.0e5), 0.0) * FRAME.exaggeration;
    return float(highest - lowest) * height_step_m <= max(level_within_m(), sea_m) + 1.0e-3 * cell_m;
}

// The share of water at a place of the page that it is shaded from. Level is what lies among equal posts, 5 of them at least in a row
// and in a column (3 where they are thinned out, or at sea level): flat fields have been rounded to equal heights over 3, and seldom
// over 5.
float water_share(FramePage page, vec2 post) {
    if (!may_be_water(page, post)) return 0.0;
    ivec2 cell = cell_of(post);
    vec2 in_cell = post - vec2(cell);
    float low, high;
    // In its page, then in the one above. One place in the code: two of them are much for a driver to compile.
    for (int i = 0; i < 2; ++i) {
        vec4 level, sea;
        float H_m = corners_of_water(PageBlocks(page.block), page, cell, level, sea) / FRAME.exaggeration;
        if (i == 0) low = smoothstep(0.4, 0.6, between_corners(sea, in_cell));
        if (level == vec4(0.0)) return low;
        if (i == 0) high = smoothstep(0.2, 0.3, between_corners(level, in_cell));
        if (page.level != 0u || page.parent == no_page || abs(H_m) <= 0.02) break;
        cell = ivec2(int(page.quarter) / 2, int(page.quarter) % 2) * int(page_quads / 2u) + cell / 2;
        page = frame_pages().at[page.parent];
    }
    return max(low, high);
}
