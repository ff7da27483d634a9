// Blades of grass in pictures: which stand in a clump, what they look like, how many are kept at a distance and how wide they are then, by
// the clump's own numbers alone. Compiled as GLSL for the GPU and as C++ by core/growth/meadow_blades.cpp. Needs shared_meadow.h,
// tree_rule.glsl and meadow_reach.glsl. Lengths are metres without more said; places are east, north and up of the clump's foot.
#ifndef OROGRAPH_SHADERS_GROWTH_BLADE_RULE
#define OROGRAPH_SHADERS_GROWTH_BLADE_RULE

// Chosen: a meadow before it is mown.
ORO_CONST float blade_height_m = 0.34f;  // of the longest, in a clump of size 1
ORO_CONST float blade_width_m = 0.0085f; // where it is widest, at its foot
ORO_CONST float clump_spread_m = 0.2f;   // feet are no farther from the clump's foot, along each axis
ORO_CONST float blade_leans_most = 0.92f; // its tip's distance beside its foot, wind included, over its length
ORO_CONST float clump_size_most = 1.45f;

// A quadratic Bezier curve, and the direction across the blade on level ground.
struct MeadowBlade {
    vec3 foot;
    vec3 middle;
    vec3 tip;
    vec2 side;
    float colour;  // -1 to 1: darker to lighter
    float dry;     // 0 to 1: green to straw
};

// Blades come in the order of their numbers where a meadow thins out: number `number` is there where more are kept, and grows to its size
// while the next ones would come.
ORO_FUNCTION float blade_grown(float kept, float number) {
    float x = (kept - number) / (0.25f * kept + 1.0f);
    x = x < 0.0f ? 0.0f : x > 1.0f ? 1.0f : x;
    return x * (2.0f - x);
}

// The share of the light of the sun and the sky that a blade's place shows, over the mean of all that is seen of a meadow; t: along it.
ORO_FUNCTION MeadowBlade blade_of_clump(uint clump, uint number, float size, vec2 slope, vec2 wind, float grown) {
    uint own = site_mixed(clump + (number + 1u) * 0x9e3779b9u);
    float turn = 6.2831853f * (site_number(clump, 4u) + 0.85f * (site_number(own, 1u) - 0.5f));
    vec2 to = vec2(cos(turn), sin(turn));
    float leaning = site_number(own, 2u), low = site_number(own, 3u);
    vec2 level = to * (0.12f + 0.22f * site_number(clump, 5u) + 0.45f * leaning * leaning) + wind;
    float lean = sqrt(level.x * level.x + level.y * level.y);
    if (lean > blade_leans_most) {
        level = level * (blade_leans_most / lean);
        lean = blade_leans_most;
    }
    float length_m = blade_height_m * size * (0.5f + 0.5f * (1.0f - low * low)) * (0.35f + 0.65f * grown), up = sqrt(1.0f - lean * lean);
    vec2 at = vec2(2.0f * site_number(own, 4u) - 1.0f, 2.0f * site_number(own, 5u) - 1.0f) * clump_spread_m;
    float twist = 1.5707963f + 1.4f * (site_number(own, 6u) - 0.5f);
    MeadowBlade blade;
    blade.foot = vec3(at.x, at.y, at.x * slope.x + at.y * slope.y);
    vec2 bent = level * (0.22f * length_m), end = level * length_m;
    blade.middle = blade.foot + vec3(bent.x, bent.y, 0.72f * up * length_m);
    blade.tip = blade.foot + vec3(end.x, end.y, up * length_m);
    blade.side = vec2(cos(turn + twist), sin(turn + twist));
    blade.colour = 1.3f * (site_number(own, 7u) - 0.5f) + 0.7f * (site_number(clump, 6u) - 0.5f);
    float dry = site_number(own, 8u);
    blade.dry = dry < 0.86f ? 0.0f : 1.0f;
    return blade;
}

ORO_FUNCTION vec3 place_on_blade(MeadowBlade blade, float t) {
    float rest = 1.0f - t;
    return blade.foot * (rest * rest) + blade.middle * (2.0f * t * rest) + blade.tip * (t * t);
}
// How wide it is there, over its width at the foot.
ORO_FUNCTION float blade_taper(float t) { return 1.0f - t * t; }
// The place along a blade that is so high above its foot: heights rise along it.
ORO_FUNCTION float along_blade(MeadowBlade blade, float up_m) {
    float middle_m = blade.middle.z - blade.foot.z, tip_m = blade.tip.z - blade.foot.z, a = tip_m - 2.0f * middle_m;
    float square = middle_m * middle_m + a * up_m;
    float t = up_m / (middle_m + sqrt(square < 0.0f ? 0.0f : square));
    return t < 0.0f ? 0.0f : t > 1.0f ? 1.0f : t;
}

// How wide blades are in the mean where none is narrower than a pixel, and how many of them then cover as much.
ORO_FUNCTION float mean_width_m(float pixel_m) {
    float width_m = 0.82f * blade_width_m;  // as they are seen, most of them at a slant
    if (pixel_m >= width_m) return pixel_m;
    float until = sqrt(1.0f - pixel_m / width_m);
    return width_m * (until - until * until * until * (1.0f / 3.0f)) + pixel_m * (1.0f - until);
}
ORO_FUNCTION float blades_kept(float pixel_m) { return float(blades_per_clump) * mean_width_m(0.0f) / mean_width_m(pixel_m); }

// How much lighter blades are in the mean that are nowhere narrower than a pixel: more of them is tip, which is lighter than the foot.
ORO_FUNCTION float widened_light(float pixel_m) {
    float x = pixel_m * (1.0f / (0.82f * blade_width_m)), more = 0.15f * x * x;
    return 1.0f + (more < 0.07f ? more : 0.07f);
}

// No blade of a clump reaches farther from the line that stands on its foot, nor higher above it.
ORO_FUNCTION float clump_reach_m(float size) { return 1.42f * clump_spread_m + blade_leans_most * blade_height_m * size + 0.5f * blade_width_m; }
ORO_FUNCTION float clump_height_m(float size) { return blade_height_m * size; }

// Wind from the west over cells as large as a tile of grass, which it drives along: -1 to 1 on average over them. row, column: of a tile;
// at: place in it, columns and rows, 0 to 1.
ORO_CONST float wind_tiles_per_s = 0.45f;
ORO_FUNCTION float gust_number(uint row, uint column) { return 2.0f * site_number(site_hash(row, column), 13u) - 1.0f; }
ORO_FUNCTION float gust_at(uint row, uint column, vec2 at, float time_s) {
    float gone = wind_tiles_per_s * time_s, whole = floor(gone), x = at.x - (gone - whole), y = at.y;
    uint west = column - uint(int(whole));
    if (x < 0.0f) {
        x += 1.0f;
        west -= 1u;
    }
    float a = x * x * (3.0f - 2.0f * x), b = y * y * (3.0f - 2.0f * y);
    float south = gust_number(row, west) * (1.0f - a) + gust_number(row, west + 1u) * a;
    float north = gust_number(row + 1u, west) * (1.0f - a) + gust_number(row + 1u, west + 1u) * a;
    return south * (1.0f - b) + north * b;
}
// What wind adds to how a clump's blades lean, east and north; strength: of the usual.
ORO_FUNCTION vec2 wind_on_clump(uint clump, uint row, uint column, vec2 at, float strength, float time_s) {
    if (strength <= 0.0f) return vec2(0.0f, 0.0f);
    float phase = 6.2831853f * site_number(clump, 7u), quick = sin(phase + 4.1f * (time_s - 1500.0f * floor(time_s / 1500.0f)));
    float blows = strength * (0.16f + 0.2f * gust_at(row, column, at, time_s) + 0.05f * quick);
    return vec2(0.93f * blows, 0.36f * blows);
}
#endif
