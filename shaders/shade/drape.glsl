// Images over the ground: FrameConstants.drape. Needs surface.glsl and, to mix them with the ground's colour, srgb.glsl.

layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer DrapeTiles { DrapeTile at[]; };
layout(buffer_reference, scalar, buffer_reference_align = 16) readonly buffer DrapeTexels { uint at[]; };

// Where a tap falls in a level: its tile, and the place there in texels.
struct DrapeSpot {
    uint name;
    uvec2 tile;
    vec2 texel;
};
// A place in quads of a level, whole ones and the rest.
void quad_at(ivec2 whole, vec2 part, int level, out ivec2 quad, out vec2 rest) {
    if (level >= 0) {
        quad = whole >> level;
        rest = (vec2(whole - (quad << level)) + part) / float(1 << level);
    } else {
        vec2 finer = part * float(1 << -level);
        vec2 quads = floor(finer);
        quad = (whole << -level) + ivec2(quads);
        rest = finer - quads;
    }
}
DrapeSpot drape_spot(ivec2 whole, vec2 part, int level) {
    // 128 quads are a tile.
    ivec2 quad;
    vec2 rest;
    quad_at(whole, part, level, quad, rest);
    DrapeSpot spot;
    spot.name = uint(level - drape_finest + 1);
    spot.tile = uvec2(quad >> 7);
    spot.texel = (vec2(quad & 127) + rest) * 2.0;
    return spot;
}

// How the picture's pixel is taken from the images: taps along the longer axis of its footprint, each between two levels.
struct DrapeFootprint {
    int taps;
    vec2 step;   // posts, from a tap to the next
    int level;   // the finer of the two
    float share; // of the coarser
};
ORO_CONST int drape_taps_max = 8;

// What a pixel to the right, and one down, adds to the place of a point, in posts: on the smooth surface, so that levels do not show the
// triangles, and the two ways of drawing agree where they differ in the triangle of an edge.
mat2 drape_per_px(SurfacePoint point) {
    vec3 up = normalize(point.view + (FRAME.earth_radius_m + FRAME.eye_h_m) * FRAME.up_view);
    vec3 east = cross(FRAME.view_from_eye * vec3(0.0, 0.0, 1.0), up);
    east = dot(east, east) < 1.0e-12 ? FRAME.view_from_eye * vec3(0.0, 1.0, 0.0) : normalize(east);
    vec3 north = cross(up, east), slope = point.smooth_normal;
    vec3 normal = slope.x * east + slope.y * north + slope.z * up, ray = point.view / -point.view.z;
    // Slopes that turn away from the eye, and those at a rim, are taken for ones that it sees at 7 degrees: their triangles face it, and a
    // longer footprint would reach over the ridge.
    float facing = min(dot(normal, ray), -0.125 * length(ray));
    vec2 px = 2.0 / (vec2(FRAME.width_px, FRAME.height_px) * FRAME.projection_scale);
    mat2 per_px;
    for (int i = 0; i < 2; ++i) {
        vec3 turn = i == 0 ? vec3(px.x, 0.0, 0.0) : vec3(0.0, px.y, 0.0);
        vec3 step_m = -point.view.z * (turn - ray * (dot(normal, turn) / facing));
        per_px[i] = posts_along(vec2(dot(step_m, east), dot(step_m, north)), point.drape_post_m);
    }
    return per_px;
}

// levels: the finest and the coarsest that there are.
DrapeFootprint drape_footprint(mat2 per_px, ivec2 levels) {
    // The footprint is an ellipse: the image of a circle of one pixel. Its axes are the singular vectors of per_px.
    vec2 x = per_px[0], y = per_px[1];
    float a = x.x * x.x + y.x * y.x, b = x.x * x.y + y.x * y.y, c = x.y * x.y + y.y * y.y;
    float middle = 0.5 * (a + c), spread = sqrt(0.25 * (a - c) * (a - c) + b * b);
    float longer = sqrt(middle + spread), shorter = sqrt(max(middle - spread, 0.0));
    vec2 axis = a >= c ? vec2(middle + spread - c, b) : vec2(b, middle + spread - a);
    float axis_length = length(axis);
    axis = axis_length > 0.0 ? axis / axis_length : vec2(1.0, 0.0);
    float finest_texel = exp2(float(levels.x - 1));
    float across = max(max(shorter, longer / float(drape_taps_max)), finest_texel);
    DrapeFootprint footprint;
    // Anything that is no number ends at the coarsest level.
    float level = log2(across) + 1.0;
    level = level >= float(levels.x) ? min(level, float(levels.y)) : float(levels.x);
    footprint.level = min(int(floor(level)), levels.y);
    footprint.share = level - float(footprint.level);
    footprint.taps = clamp(int(ceil(longer / across - 0.01)), 1, drape_taps_max);
    footprint.step = axis * (longer / float(footprint.taps));
    if (!(longer < 1.0e9)) {
        footprint.taps = 1;
        footprint.step = vec2(0.0);
        footprint.level = levels.y;
        footprint.share = 0.0;
    }
    return footprint;
}

// The place of a tap, kept within the region.
void drape_tap(SurfacePoint point, DrapeFootprint footprint, int tap, out ivec2 whole, out vec2 part) {
    vec2 off = point.drape_part + footprint.step * (float(tap) - 0.5 * float(footprint.taps - 1));
    vec2 posts = floor(off);
    whole = point.drape_post + ivec2(posts);
    part = off - posts;
    ivec2 last = ivec2(FRAME.last_row, FRAME.last_column);
    part = mix(part, vec2(0.0), lessThan(whole, ivec2(0)));
    part = mix(part, vec2(0.999), greaterThanEqual(whole, last));
    whole = clamp(whole, ivec2(0), last - 1);
}

// Finds a tile in the table: false where it is not on the GPU.
bool drape_find(DrapeSpot spot, out uvec2 texels) {
    DrapeTiles tiles = DrapeTiles(FRAME.drape.tiles);
    uint place = drape_hash(spot.name, spot.tile.x, spot.tile.y, 0u) & FRAME.drape.tile_mask;
    for (uint i = 0u; i <= FRAME.drape.tile_mask; ++i) {
        uint name = tiles.at[place].name;
        if (name == 0u) return false;
        if (name == spot.name && tiles.at[place].row == spot.tile.x && tiles.at[place].column == spot.tile.y) {
            texels = tiles.at[place].texels;
            return true;
        }
        place = (place + 1u) & FRAME.drape.tile_mask;
    }
    return false;
}

// Codes times alpha, and alpha.
vec4 drape_bilinear(uvec2 address, vec2 texel) {
    DrapeTexels texels = DrapeTexels(address);
    vec2 at = clamp(texel + 0.5, vec2(0.0), vec2(float(drape_stride) - 1.001));  // the first is the border's
    uvec2 low = uvec2(at);
    vec2 share = at - vec2(low);
    uint first = low.x * drape_stride + low.y;
    vec4 north = mix(unpackUnorm4x8(texels.at[first]), unpackUnorm4x8(texels.at[first + 1u]), share.y);
    vec4 south = mix(unpackUnorm4x8(texels.at[first + drape_stride]), unpackUnorm4x8(texels.at[first + drape_stride + 1u]), share.y);
    return mix(north, south, share.x);
}

// At a level, or at the first coarser one that is here.
vec4 drape_at(ivec2 whole, vec2 part, int level) {
    for (; level <= FRAME.drape.coarsest; ++level) {
        DrapeSpot spot = drape_spot(whole, part, level);
        uvec2 texels;
        if (!drape_find(spot, texels)) continue;
        return texels == uvec2(0u) ? vec4(0.0) : drape_bilinear(texels, spot.texel);
    }
    return vec4(0.0);
}

vec4 drape_sample(SurfacePoint point) {
    DrapeFootprint footprint = drape_footprint(drape_per_px(point), ivec2(FRAME.drape.finest, FRAME.drape.coarsest));
    vec4 sum = vec4(0.0);
    for (int tap = 0; tap < footprint.taps; ++tap) {
        ivec2 whole;
        vec2 part;
        drape_tap(point, footprint, tap, whole, part);
        vec4 colour = drape_at(whole, part, footprint.level);
        if (footprint.share > 0.0) colour = mix(colour, drape_at(whole, part, footprint.level + 1), footprint.share);
        sum += colour;
    }
    return sum / float(footprint.taps);
}
