// Blades of grass: where a clump stands, what its blades look like, which of them a picture needs. Compiled as GLSL for the GPU and as C++
// by render/grass/blade_rule.cpp, so that what is tested against brute force is what runs. Needs shared_grass.h. Without more said, lengths
// are metres. The same numbers give the same blade in every program: `precise`.

// Sizes of blades. What is drawn by lot lies within these.
ORO_CONST float blade_height_least_m = 1.0f;
ORO_CONST float blade_height_most_m = 2.0f;
ORO_CONST float blade_width_m = 0.12f;    // at the foot; it tapers to nothing at the tip
ORO_CONST float blade_lean_least = 0.35f;  // how far the tip stands beside the foot, over the height
ORO_CONST float blade_lean_most = 0.85f;
ORO_CONST float blade_wind_lean = 0.25f;   // what wind adds at most
ORO_CONST float blade_curve = 0.25f;       // how far the middle control point lies off the chord, over the height
ORO_CONST float clump_radius_m = 0.3f;     // largest distance of a foot from the clump's along an axis
// Ground under them.
ORO_CONST float grass_ground_m = 26.0f;
ORO_CONST float grass_relief_m = 3.0f;
// Wind: cells of its noise, and how fast it drives them.
ORO_CONST float wind_cell_m = 9.0f;
ORO_CONST float wind_speed_m_per_s = 3.0f;
ORO_CONST float grass_near_m = 0.1f;

// Source: C. Wellons, "Prospecting for Hash Functions" (lowbias32), 2018.
ORO_FUNCTION uint mixed_bits(uint bits) {
    bits ^= bits >> 16u;
    bits *= 0x7feb352du;
    bits ^= bits >> 15u;
    bits *= 0x846ca68bu;
    bits ^= bits >> 16u;
    return bits;
}
// From 0 to below 1, of the upper 24 bits: exact.
ORO_FUNCTION float lot(uint bits) { return float(bits >> 8u) * (1.0f / 16777216.0f); }

ORO_FUNCTION float grass_ground_at_m(float x, float y) {
    ORO_PRECISE float height = grass_ground_m + grass_relief_m * sin(x * 0.031f) * cos(y * 0.027f);
    return height;
}

ORO_FUNCTION GrassClump clump_at(GrassField field, uint number) {
    uint seed = mixed_bits(number + 0x9e3779b9u);
    uint row = number / field.columns;
    uint column = number - row * field.columns;
    ORO_PRECISE float x = (float(column) + lot(mixed_bits(seed ^ 1u)) - 0.5f * float(field.columns)) * field.spacing_m;
    ORO_PRECISE float y = (float(row) + lot(mixed_bits(seed ^ 2u)) - 0.5f * float(field.rows)) * field.spacing_m;
    GrassClump clump;
    clump.foot = vec3(x, y, grass_ground_at_m(x, y));
    clump.seed = seed;
    return clump;
}

// Noise of the plane from 0 to 1, smooth, that wind drives to the east. 0.5 in no wind.
ORO_FUNCTION float wind_lot(int x, int y) { return lot(mixed_bits(uint(x) * 0x8da6b343u ^ mixed_bits(uint(y)))); }
ORO_FUNCTION float wind_at(float x, float y, float time_s) {
    if (time_s < 0.0f) return 0.5f;
    ORO_PRECISE float u = (x - wind_speed_m_per_s * time_s) / wind_cell_m;
    ORO_PRECISE float v = y / wind_cell_m;
    ORO_PRECISE float s = u - floor(u);
    ORO_PRECISE float t = v - floor(v);
    int column = int(floor(u));
    int row = int(floor(v));
    ORO_PRECISE float a = s * s * (3.0f - 2.0f * s);
    ORO_PRECISE float b = t * t * (3.0f - 2.0f * t);
    ORO_PRECISE float south = wind_lot(column, row) * (1.0f - a) + wind_lot(column + 1, row) * a;
    ORO_PRECISE float north = wind_lot(column, row + 1) * (1.0f - a) + wind_lot(column + 1, row + 1) * a;
    ORO_PRECISE float wind = south * (1.0f - b) + north * b;
    return wind;
}

// A blade's control points, and half its width at the foot along the side it shows.
struct GrassBlade {
    vec3 foot;
    vec3 middle;
    vec3 tip;
    vec3 side;
};
// What a clump's radius grows by where its blades are wider than they are: it then stands for those around it that are left out.
ORO_FUNCTION float clump_spread(float width) {
    ORO_PRECISE float spread = sqrt(width / blade_width_m);
    return spread;
}
// width: at the foot, blade_width_m or more.
ORO_FUNCTION GrassBlade blade_of(GrassClump clump, uint number, float width, float time_s) {
    uint bits = mixed_bits(clump.seed + (number + 1u) * 0x85ebca6bu);
    ORO_PRECISE float radius = clump_radius_m * clump_spread(width);
    ORO_PRECISE float east = (2.0f * lot(bits) - 1.0f) * radius;
    bits = mixed_bits(bits);
    ORO_PRECISE float north = (2.0f * lot(bits) - 1.0f) * radius;
    bits = mixed_bits(bits);
    // Blades of a clump point apart, whatever way the clump is turned.
    ORO_PRECISE float angle = 6.2831853f * (lot(clump.seed) + 0.25f * float(number) + 0.2f * lot(bits));
    bits = mixed_bits(bits);
    ORO_PRECISE float height = blade_height_least_m + (blade_height_most_m - blade_height_least_m) * lot(bits);
    bits = mixed_bits(bits);
    ORO_PRECISE float lean = blade_lean_least + (blade_lean_most - blade_lean_least) * lot(bits) +
                             blade_wind_lean * (2.0f * wind_at(clump.foot.x, clump.foot.y, time_s) - 1.0f);
    ORO_PRECISE float cosine = cos(angle);
    ORO_PRECISE float sine = sin(angle);
    ORO_PRECISE float off = blade_curve * height / sqrt(1.0f + lean * lean);
    ORO_PRECISE float beside_middle = 0.5f * lean * height - off;
    ORO_PRECISE float above_middle = 0.5f * height + off * lean;
    ORO_PRECISE float beside_tip = lean * height;
    ORO_PRECISE float half_width = 0.5f * width;
    ORO_PRECISE vec3 foot = vec3(clump.foot.x + east, clump.foot.y + north, clump.foot.z);
    ORO_PRECISE vec3 middle = vec3(foot.x + cosine * beside_middle, foot.y + sine * beside_middle, foot.z + above_middle);
    ORO_PRECISE vec3 tip = vec3(foot.x + cosine * beside_tip, foot.y + sine * beside_tip, foot.z + height);
    GrassBlade blade;
    blade.foot = foot;
    blade.middle = middle;
    blade.tip = tip;
    blade.side = vec3(half_width * sine, -half_width * cosine, 0.0f);
    return blade;
}

// A vertex of a blade that has so many: they go up it in pairs, left and right.
ORO_FUNCTION vec3 blade_vertex(GrassBlade blade, uint number, uint vertices) {
    ORO_PRECISE float t = float(number / 2u) / float(vertices / 2u - 1u);
    ORO_PRECISE float rest = 1.0f - t;
    ORO_PRECISE float side = number % 2u == 0u ? -rest : rest;
    ORO_PRECISE vec3 place =
        blade.foot * (rest * rest) + blade.middle * (2.0f * t * rest) + blade.tip * (t * t) + blade.side * side;
    return place;
}

// How many vertices a blade has so far from the eye: from the most, beside it, to the fewest at the switch distance, and those beyond.
ORO_FUNCTION uint blade_vertices(float distance, float switch_distance) {
    ORO_PRECISE float share = min(distance / switch_distance, 1.0f);
    return blade_vertices_most - 2u * uint(share * float(blade_level_count - 1u) + 0.5f);
}
// ... as the discrete levels of the vertex way have it: of its two lists.
ORO_FUNCTION uint grass_list_of(float distance, float switch_distance) { return distance < switch_distance ? 0u : 1u; }

ORO_FUNCTION float eye_distance(GrassView view, GrassClump clump) {
    ORO_PRECISE vec3 from_eye = clump.foot - view.eye;
    ORO_PRECISE float distance = sqrt(from_eye.x * from_eye.x + from_eye.y * from_eye.y + from_eye.z * from_eye.z);
    return distance;
}
// What a pixel covers at a place's depth; at the eye and behind it, nothing.
ORO_FUNCTION float pixel_size(GrassView view, uint height_px, vec3 place) {
    return max(dot(view.forward, place - view.eye), 0.0f) * 2.0f / (float(height_px) * view.scale.y);
}

// How wide the blades of a clump are: where blades thin, at least as a pixel there.
ORO_FUNCTION float clump_blade_width(GrassView view, uint height_px, uint flags, GrassClump clump) {
    if ((flags & grass_thins) == 0u) return blade_width_m;
    ORO_PRECISE float width = max(blade_width_m, pixel_size(view, height_px, clump.foot));
    return width;
}
// In what order clumps are left out where they thin: those of rank below a share are that share of all, evenly spread, and hold those of
// every smaller share. From 0 to below 1. Of a checker of sites one colour goes first, then every second row of what is left, and so on.
ORO_FUNCTION float clump_rank(GrassField field, uint number) {
    uint row = number / field.columns;
    uint column = number - row * field.columns;
    uint checker = row ^ column;
    uint rank = 0u;
    for (uint i = 0u; i < 12u; ++i) rank = rank << 2u | (checker >> i & 1u) << 1u | (row >> i & 1u);
    return float(rank) * (1.0f / 16777216.0f);
}
// Whether a clump with blades so wide is kept: as many fewer as they are wider.
ORO_FUNCTION bool clump_is_kept(GrassField field, uint number, float width) {
    return clump_rank(field, number) * width < blade_width_m;
}

// A box around all that the blades of a clump may cover, in wind or not: half axes along x, y, z, and how far its centre is above the foot.
ORO_FUNCTION vec3 clump_half_axes(float width) {
    float reach = clump_radius_m * clump_spread(width) + blade_height_most_m * max(blade_lean_most + blade_wind_lean, blade_curve) + 0.5f * width;
    float half_height = 0.5f * blade_height_most_m * max(1.0f, 0.5f + blade_curve);
    return vec3(reach, reach, half_height);
}
// How far a box lies on the inner side of a plane through the eye, at most; lengths in those of `inward`.
ORO_FUNCTION float farthest_inside(vec3 inward, vec3 from_eye, vec3 half_axes) {
    return dot(inward, from_eye) + dot(abs(inward), half_axes);
}
// Whether a clump may be in the picture. By its box: false only where none of its blades covers anything. By its foot alone: blades that
// lean into the picture are lost, but for those of clumps within the margin.
ORO_FUNCTION bool clump_in_view(GrassView view, GrassClump clump, float width, float margin, uint flags) {
    bool by_box = (flags & grass_by_boxes) != 0u;
    vec3 half_axes = by_box ? clump_half_axes(width) : vec3(0.0f, 0.0f, 0.0f);
    vec3 from_eye = clump.foot - view.eye;
    from_eye.z += half_axes.z;
    // More than all these sums round.
    float slack = by_box ? 1.0e-5f * (abs(from_eye.x) + abs(from_eye.y) + abs(from_eye.z) + 1.0f) : 0.0f;
    float across = sqrt(1.0f + view.scale.x * view.scale.x);
    float down = sqrt(1.0f + view.scale.y * view.scale.y);
    float inside = farthest_inside(view.forward - view.right * view.scale.x, from_eye, half_axes) + (margin + slack) * across;
    inside = min(inside, farthest_inside(view.forward + view.right * view.scale.x, from_eye, half_axes) + (margin + slack) * across);
    inside = min(inside, farthest_inside(view.forward - view.up * view.scale.y, from_eye, half_axes) + (margin + slack) * down);
    inside = min(inside, farthest_inside(view.forward + view.up * view.scale.y, from_eye, half_axes) + (margin + slack) * down);
    inside = min(inside, farthest_inside(view.forward, from_eye, half_axes) + slack - grass_near_m);
    return inside >= 0.0f;
}

// A place in clip coordinates: depth reversed, without an end.
ORO_FUNCTION vec4 grass_clip(GrassView view, vec3 place) {
    ORO_PRECISE vec3 p = place - view.eye;
    ORO_PRECISE float x = (view.right.x * p.x + view.right.y * p.y + view.right.z * p.z) * view.scale.x;
    ORO_PRECISE float y = (view.up.x * p.x + view.up.y * p.y + view.up.z * p.z) * -view.scale.y;
    ORO_PRECISE float w = view.forward.x * p.x + view.forward.y * p.y + view.forward.z * p.z;
    return vec4(x, y, grass_near_m, w);
}
