// Which ground is water, by its posts. Needs surface.glsl's readers of posts.

const float no_H = -1.0e9;

// H of a post, exaggerated; no_H of a void.
float exaggerated_H(PageBlocks block, FramePage page, ivec2 post) {
    int height = height_or(block, post, void_height);
    return height == void_height ? no_H : float(height) * height_step_m - undulation_at(region_post(page, vec2(post)));
}

// What rounding of heights and of N may make of equal posts.
float level_within_m() { return 0.01 + (FRAME.height_bits == 16u ? 2.0 * height_step_m * float(1u << FRAME.height_shift) : 0.0); }

// Which of a cell's four corners (north-west, north-east, south-west, south-east) lie in the middle of 3 x 3 posts of the sea.
vec4 corners_of_sea(PageBlocks block, FramePage page, ivec2 cell) {
    float H[16];
    for (int i = 0; i < 16; ++i) H[i] = exaggerated_H(block, page, cell + ivec2(i / 4, i % 4) - 1);
    float low_m = FRAME.style.water.sea_low_H_m * FRAME.exaggeration, high_m = FRAME.style.water.sea_high_H_m * FRAME.exaggeration;
    vec4 sea;
    for (int corner = 0; corner < 4; ++corner) {
        int first = corner / 2 * 4 + corner % 2;
        float lowest = H[first], highest = lowest, sum = 0.0;
        for (int k = 0; k < 9; ++k) {
            float one = H[first + k / 3 * 4 + k % 3];
            lowest = min(lowest, one);
            highest = max(highest, one);
            sum += one;
        }
        // Noise goes both ways: ground that rises from the shore is above it. Voids are below all.
        sea[corner] = lowest > 0.5 * no_H && lowest >= low_m && highest <= high_m && sum <= 9.0 * FRAME.exaggeration ? 1.0 : 0.0;
    }
    return sea;
}

float between_corners(vec4 corners, vec2 in_cell) { return mix(mix(corners.x, corners.y, in_cell.y), mix(corners.z, corners.w, in_cell.y), in_cell.x); }

ivec2 cell_of(vec2 post) { return clamp(whole_signed(floor(post)), ivec2(0), ivec2(int(page_quads) - 1)); }
// Of a cell's four posts at most one may be other than the rest: water ends between posts.
bool all_but_one_alike(int heights[4], int within) {
    int low_a = min(heights[0], heights[1]), high_a = max(heights[0], heights[1]);
    int low_b = min(heights[2], heights[3]), high_b = max(heights[2], heights[3]);
    int second = min(max(low_a, low_b), min(high_a, high_b)), third = max(min(high_a, high_b), max(low_a, low_b));
    return min(third - min(low_a, low_b), max(high_a, high_b) - second) <= within;
}
// Most ground is told by its cell alone: false where there is no water. N rises by less than a metre a kilometre.
bool may_be_water(FramePage page, vec2 post) {
    PageBlocks block = PageBlocks(page.block);
    ivec2 cell = cell_of(post);
    int heights[4];
    for (int i = 0; i < 4; ++i) {
        heights[i] = height_or(block, cell + ivec2(i >> 1, i & 1), void_height);
        if (heights[i] == void_height) return false;
    }
    float cell_m = power_of_two(page.level) * (block.at[0].row_spacing_m + block.at[0].column_spacing_m);
    float sea_m = max(FRAME.style.water.sea_high_H_m - max(FRAME.style.water.sea_low_H_m, -1.0e5), 0.0) * FRAME.exaggeration;
    float within_m = max(level_within_m(), sea_m) + 1.0e-3 * cell_m;
    return all_but_one_alike(heights, int(min(within_m / height_step_m, 1.0e9)));
}

// A cubic B-spline's shares of the four posts around a place, `on` of the way from the second to the third.
vec4 spline_shares(float on) {
    float off = 1.0 - on, on2 = on * on, off2 = off * off;
    return vec4(off2 * off, 4.0 - 3.0 * on2 * (2.0 - on), 4.0 - 3.0 * off2 * (2.0 - off), on2 * on) / 6.0;
}
const float shore_low = 0.845, shore_high = 0.895;

// Of the 4 x 4 posts around a cell: which are level with the cell; its H, exaggerated, that of two of its posts at least. Bit 4 * row + column.
uint level_posts(PageBlocks block, FramePage page, ivec2 cell, out float H_m) {
    float H[16];
    for (int i = 0; i < 16; ++i) H[i] = exaggerated_H(block, page, cell + ivec2(i / 4, i % 4) - 1);
    float within_m = level_within_m();
    H_m = abs(H[5] - H[6]) <= within_m || abs(H[5] - H[9]) <= within_m || abs(H[5] - H[10]) <= within_m ? H[5] : H[6];
    uint level = 0u;
    for (int i = 0; i < 16; ++i) level |= abs(H[i] - H_m) <= within_m ? 1u << uint(i) : 0u;
    return level;
}
// The spline's value of what is 1 at such posts and 0 at all others. Of four posts in the middle three must be level: so much of the cell is.
float level_share(uint level, vec2 in_cell) {
    if (level == 0xffffu) return 1.0;
    if (bitCount(level & 0x0660u) < 3) return 0.0;
    vec4 down = spline_shares(in_cell.x), right = spline_shares(in_cell.y);
    float sum = 0.0;
    for (uint i = 0u; i < 16u; ++i) sum += (level >> i & 1u) == 1u ? down[i / 4u] * right[i % 4u] : 0.0;
    return sum;
}
// Whether 3 x 3 posts of that H touch a cell.
bool has_level_square(PageBlocks block, FramePage page, ivec2 cell, float H_m) {
    uint above = 0u, two_above = 0u;
    for (int row = -2; row < 4; ++row) {
        uint there = 0u;
        for (int column = -2; column < 4; ++column) {
            ivec2 post = cell + ivec2(row, column);
            bool is_here = all(greaterThanEqual(post, ivec2(-1))) && all(lessThanEqual(post, ivec2(int(page_posts))));
            if (is_here && abs(exaggerated_H(block, page, post) - H_m) <= level_within_m()) there |= 1u << uint(column + 2);
        }
        there &= (there >> 1u) & (there >> 2u);
        if ((there & above & two_above) != 0u) return true;
        two_above = above;
        above = there;
    }
    return false;
}

float sea_share(PageBlocks block, FramePage page, ivec2 cell, vec2 in_cell) {
    if (FRAME.style.water.sea_high_H_m < FRAME.style.water.sea_low_H_m) return 0.0;
    return smoothstep(0.4, 0.6, between_corners(corners_of_sea(block, page, cell), in_cell));
}

// The share of water at a place of the page that it is shaded from. Level is what lies among equal posts, 5 of them at least in a row
// and in a column (3 where they are thinned out, or at sea level): flat fields have been rounded to equal heights over 3, and seldom
// over 5. The posts only say where water is and where none is; its shore is a smooth line between them, which touches the outermost
// posts of straight shores, and runs as far as half way to the next ones where land reaches into the water by a post.
float water_share(FramePage page, vec2 post) {
    if (!may_be_water(page, post)) return 0.0;
    ivec2 cell = cell_of(post);
    vec2 in_cell = post - vec2(cell);
    PageBlocks block = PageBlocks(page.block);
    float sea = sea_share(block, page, cell, in_cell), H_m;
    uint level = level_posts(block, page, cell, H_m);
    float share = smoothstep(shore_low, shore_high, level_share(level, in_cell));
    if (share <= sea) return sea;
    bool by_parent = page.level == 0u && page.parent != no_page && abs(H_m) > 0.02 * FRAME.exaggeration;
    if (!by_parent && level == 0xffffu) return share;
    if (by_parent) {
        cell = ivec2(int(page.quarter) / 2, int(page.quarter) % 2) * int(page_quads / 2u) + cell / 2;
        page = frame_pages().at[page.parent];
    }
    return has_level_square(PageBlocks(page.block), page, cell, H_m) ? share : sea;
}
