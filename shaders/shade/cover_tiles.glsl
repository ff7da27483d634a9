// Land cover over the ground, from files: tiles of the drape's pyramid whose texels are shares of grounds (core/drape/cover_tiles.h). What
// there is, and the grounds' colours, stand behind the table of tiles, in places of the same form: the first has a bit for images and one
// for cover in `name` and the cover's levels in `row` and `column`; then each ground's colour, linear light, as floats. Needs drape.glsl.

ORO_CONST uint cover_level_offset = 64u;  // names of its tiles are those of levels so much higher
ORO_CONST uint cover_unknown = 15u;       // a ground of which nothing is known

bool has_images() { return (DrapeTiles(FRAME.drape.tiles).at[FRAME.drape.tile_mask + 1u].name & 1u) != 0u; }
// Of a style that is coloured by cover.
bool has_cover() {
    return FRAME.style.colour_by == colour_by_cover && (DrapeTiles(FRAME.drape.tiles).at[FRAME.drape.tile_mask + 1u].name & 2u) != 0u;
}
ivec2 cover_levels() {
    DrapeTile head = DrapeTiles(FRAME.drape.tiles).at[FRAME.drape.tile_mask + 1u];
    return ivec2(int(head.row), int(head.column));
}
DrapeSpot cover_spot(ivec2 whole, vec2 part, int level) {
    DrapeSpot spot = drape_spot(whole, part, level);
    spot.name += cover_level_offset;
    return spot;
}

// Two numbers of -1 to 1 that change smoothly from quad to quad of a level.
vec2 cover_noise(ivec2 whole, vec2 part, int level) {
    ivec2 quad;
    vec2 rest;
    quad_at(whole, part, level, quad, rest);
    vec2 share = rest * rest * (3.0 - 2.0 * rest), sum = vec2(0.0);
    for (int i = 0; i < 4; ++i) {
        uvec2 corner = uvec2(quad + ivec2(i & 1, i >> 1));
        uint hash = drape_hash(uint(level), corner.x, corner.y, 1u);
        vec2 value = vec2(float(hash & 0xffffu), float(hash >> 16u)) / 32767.5 - 1.0;
        sum += value * ((i & 1) == 0 ? 1.0 - share.x : share.x) * ((i >> 1) == 0 ? 1.0 - share.y : share.y);
    }
    return sum;
}

// The place of a tap where cover is looked for: moved by up to a cell of the files, most often by less than half of one, so that the edges
// of cells are no steps of squares.
void cover_tap(SurfacePoint point, DrapeFootprint footprint, int tap, ivec2 levels, out ivec2 whole, out vec2 part) {
    drape_tap(point, footprint, tap, whole, part);
    // A cell is two to four texels of the finest level, so one to two of its quads.
    vec2 moved = part + exp2(float(levels.x)) * (0.5 * cover_noise(whole, part, levels.x + 1) + 0.5 * cover_noise(whole, part, levels.x));
    ivec2 posts = ivec2(floor(moved)), last = ivec2(FRAME.last_row, FRAME.last_column) - 1;
    part = moved - vec2(posts);
    whole += posts;
    part = mix(part, vec2(0.0), lessThan(whole, ivec2(0)));
    part = mix(part, vec2(0.999), greaterThan(whole, last));
    whole = clamp(whole, ivec2(0), last);
}

#ifdef IN_AIR
// Of a ground's mean colour, its materials and limits (DrapeStore): what that place of it has, and how much of that is forest (materials.glsl).
float forest_share;  // of the place that was coloured last
vec2 map_forest;     // over a pixel: the sum of its forest's shares, and of all that the map knows
vec3 textured(vec3 colour, uint materials, uint limits);
#endif

// Colour, linear light, times the share of what is known, and that share.
vec4 cover_of_texel(uint texel) {
    vec4 sum = vec4(0.0);
    for (; texel != 0u; texel >>= 8u) {
        uint ground = texel & 15u;
        if (ground == cover_unknown) continue;
        DrapeTile entry = DrapeTiles(FRAME.drape.tiles).at[FRAME.drape.tile_mask + 2u + ground];
        vec3 colour = uintBitsToFloat(uvec3(entry.name, entry.row, entry.column));
#ifdef IN_AIR
        if (of_materials) colour = textured(colour, entry.texels.x, entry.texels.y);
#endif
        float share = float((texel >> 4u) & 15u) / 15.0;
#ifdef IN_AIR
        if (of_materials) map_forest += share * vec2(forest_share, 1.0);
#endif
        sum += share * vec4(colour, 1.0);
    }
    return sum;
}

// As it is in the file: nothing is mixed.
vec4 cover_nearest(uvec2 address, vec2 texel) {
    uvec2 at = uvec2(clamp(texel + 1.0, vec2(0.0), vec2(float(drape_stride) - 1.0)));  // the first is the border's
    return cover_of_texel(DrapeTexels(address).at[at.x * drape_stride + at.y]);
}

vec4 cover_bilinear(uvec2 address, vec2 texel) {
    DrapeTexels texels = DrapeTexels(address);
    vec2 at = clamp(texel + 0.5, vec2(0.0), vec2(float(drape_stride) - 1.001));
    uvec2 low = uvec2(at);
    vec2 share = at - vec2(low);
    uint first = low.x * drape_stride + low.y;
    uvec4 four = uvec4(texels.at[first], texels.at[first + 1u], texels.at[first + drape_stride], texels.at[first + drape_stride + 1u]);
    if (four == uvec4(four.x)) return cover_of_texel(four.x);
    return mix(mix(cover_of_texel(four.x), cover_of_texel(four.y), share.y), mix(cover_of_texel(four.z), cover_of_texel(four.w), share.y),
               share.x);
}

// At a level, or at the first coarser one that is here.
vec4 cover_at(ivec2 whole, vec2 part, int level, ivec2 levels) {
    for (int at = level; at <= levels.y; ++at) {
        DrapeSpot spot = cover_spot(whole, part, at);
        uvec2 texels;
        if (!drape_find(spot, texels)) continue;
        if (texels == uvec2(0u)) return vec4(0.0);
        return at == levels.x ? cover_nearest(texels, spot.texel) : cover_bilinear(texels, spot.texel);
    }
    return vec4(0.0);
}

vec4 cover_sample(SurfacePoint point) {
    ivec2 levels = cover_levels();
    DrapeFootprint footprint = drape_footprint(drape_per_px(point), levels);
    vec4 sum = vec4(0.0);
    for (int tap = 0; tap < footprint.taps; ++tap) {
        ivec2 whole;
        vec2 part;
        cover_tap(point, footprint, tap, levels, whole, part);
        vec4 cover = cover_at(whole, part, footprint.level, levels);
        if (footprint.share > 0.0) cover = mix(cover, cover_at(whole, part, footprint.level + 1, levels), footprint.share);
        sum += cover;
    }
    return sum / float(footprint.taps);
}
