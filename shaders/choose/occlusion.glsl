// Whether the ground that is drawn hides a box: by the pyramid of the farthest depths (pyramid.comp). Conservative: what is hidden may be
// kept, nothing that would show in a pixel is lost. Needs frame.glsl and bend.glsl.

// Values that are looked at for a box: the finest level that has no more of them under it.
const uint most_squares = 32u;
// Where a rasteriser puts a triangle's corners: on 1/256 px, or, by the graphics pipeline, on 1/16 px at worst.
const float corner_slack_px = 0.0725;
// What it makes of the depths between corners, of themselves and of the span between them: floats of thin triangles.
const float depth_slack = 1.0e-5;
const float depth_span_slack = 0.01;

uvec2 pyramid_size(uint level) { return (uvec2(FRAME.width_px, FRAME.height_px) + ((1u << level) - 1u)) >> level; }

// The place of a level's first value.
uint pyramid_first(uint level) {
    uint first = 0u;
    for (uint below = pyramid_finest; below < level; ++below) {
        uvec2 size = pyramid_size(below);
        first += size.x * size.y;
    }
    return first;
}

// Pixels whose centres may be in it: first and last column and row, within the picture; and the nearest depth.
struct BoxOnPicture {
    ivec4 pixels;
    float nearest;
};

// A box around a point of view coordinates with three half axes. slack_m: how far what is in it may lie beyond. False where it comes to
// the near plane: it may be anywhere on the picture then.
bool box_on_picture(vec3 centre, mat3 half_axes, float slack_m, out BoxOnPicture box) {
    vec2 half_size = 0.5 * vec2(FRAME.width_px, FRAME.height_px);
    vec2 low = vec2(1.0e30), high = vec2(-1.0e30);
    float w_min = 1.0e30, w_max = 0.0;
    for (uint i = 0u; i < 8u; ++i) {
        vec3 corner = centre + ((i & 1u) != 0u ? half_axes[0] : -half_axes[0]) + ((i & 2u) != 0u ? half_axes[1] : -half_axes[1]) +
                      ((i & 4u) != 0u ? half_axes[2] : -half_axes[2]);
        if (FRAME.refraction_per_m != 0.0) corner = bent(corner);
        float w = -corner.z;
        w_min = min(w_min, w);
        w_max = max(w_max, w);
        vec2 at = FRAME.projection_scale * corner.xy / max(w, 1.0e-20);
        low = min(low, at);
        high = max(high, at);
    }
    float nearest_m = w_min - slack_m;
    if (!(nearest_m > 1.001 * FRAME.near_m)) return false;
    // A point that is moved by slack_m moves on the picture by no more than that.
    vec2 margin = slack_m / nearest_m * (abs(FRAME.projection_scale) + max(abs(low), abs(high))) * half_size + corner_slack_px;
    vec2 first = (low + FRAME.projection_shift + 1.0) * half_size - margin, last = (high + FRAME.projection_shift + 1.0) * half_size + margin;
    vec2 end = vec2(FRAME.width_px, FRAME.height_px);
    box.pixels.xy = ivec2(ceil(clamp(first, vec2(-1.0), end + 1.0) - 0.5));
    box.pixels.zw = ivec2(floor(clamp(last, vec2(-1.0), end + 1.0) - 0.5));
    box.pixels.xy = max(box.pixels.xy, ivec2(0));
    box.pixels.zw = min(box.pixels.zw, ivec2(end) - 1);
    float nearest = FRAME.near_m / nearest_m, farthest = FRAME.near_m / (w_max + slack_m);
    box.nearest = nearest * (1.0 + depth_slack) + depth_span_slack * (nearest - farthest);
    return true;
}

// Whether all that is drawn in those pixels is nearer.
bool is_behind(BoxOnPicture box) {
    if (any(greaterThan(box.pixels.xy, box.pixels.zw))) return true;  // no pixel's centre
    uint level = pyramid_finest;
    uvec4 squares;
    uvec2 count;
    for (; level <= pyramid_coarsest; ++level) {
        squares = uvec4(box.pixels) >> level;
        count = squares.zw - squares.xy + 1u;
        if (count.x * count.y <= most_squares) break;
    }
    if (level > pyramid_coarsest) return false;
    Floats pyramid = Floats(FRAME.pyramid);
    uint first = pyramid_first(level), width = pyramid_size(level).x;
    for (uint y = squares.y; y <= squares.w; ++y) {
        for (uint x = squares.x; x <= squares.z; ++x) {
            if (!(pyramid.at[first + y * width + x] > box.nearest)) return false;
        }
    }
    return true;
}

// Whether a page's node is hidden, and all that is no farther than more_m from it.
bool is_hidden(FramePage page, uint node, float more_m) {
    PageBlocks block = PageBlocks(page.block);
    vec3 centre_m = block.at[0].meshlets[node].centre;
    float radius_m = block.at[0].meshlets[node].radius;
    uint steps = block.at[0].boxes[node];
    vec2 up = block.at[0].up;
    vec3 half_m = vec3(steps & 1023u, steps >> 10u & 1023u, steps >> 20u & 1023u) * (radius_m / 1023.0);
    vec3 centre = page.view_from_page * centre_m + page.origin_view;
    mat3 axes = page.view_from_page * mat3(vec3(0.0, 1.0, 0.0), vec3(-up.y, 0.0, up.x), vec3(up.x, 0.0, up.y));
    mat3 half_axes = mat3(axes[0] * half_m.x, axes[1] * half_m.y, axes[2] * half_m.z);
    // Floats: of the centre, of placing (place.glsl: 1 mm and 3.2e-7 of the distance); and what light bends a box out of the shape
    // that its corners span.
    vec3 size_m = abs(centre_m) + abs(page.origin_view);
    float slack_m = FRAME.placing_slack_m + 1.0e-2 + 1.0e-6 * (size_m.x + size_m.y + size_m.z + radius_m);
    slack_m += 0.5 * abs(FRAME.refraction_per_m) * radius_m * radius_m + more_m;
    BoxOnPicture box;
    return box_on_picture(centre, half_axes, slack_m, box) && is_behind(box);
}
