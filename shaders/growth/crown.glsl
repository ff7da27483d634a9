// Where a line of sight meets a tree: cones and ellipsoids with gaps between their leaves. Needs growth.glsl.

// Smooth noise of 0 to 1.
float leaf_at_corner(uint h) {
    h ^= h >> 15u;
    h *= 0x846ca68bu;
    h ^= h >> 16u;
    return float(h >> 8u);
}
float leaf_noise(vec3 at, uint seed) {
    vec3 cell = floor(at), part = at - cell, on = part * part * (3.0 - 2.0 * part), off = 1.0 - on;
    uvec3 step = uvec3(0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du), low = uvec3(ivec3(cell)) * step, high = low + step;
    vec4 across = vec4(off.x * off.y, on.x * off.y, off.x * on.y, on.x * on.y);
    uvec4 corners = uvec4(low.x + low.y, high.x + low.y, low.x + high.y, high.x + high.y) + (low.z + seed);
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) sum += across[i] * off.z * leaf_at_corner(corners[i]);
    for (int i = 0; i < 4; ++i) sum += across[i] * on.z * leaf_at_corner(corners[i] + step.z);
    return sum * (1.0 / 16777216.0);
}

struct CrownHit {
    float depth_m;  // along the ray, of its length
    vec3 at;        // in the crown's frame, from its foot
    float inside;   // 0: among its outermost leaves; 1: at its stem
    bool is_stem;
};

// A line from p by d. The first place of a shell that it enters, as a multiple of d; no_hit: none.
const float no_hit = 1.0e30;
float enters_cone(vec3 p, vec3 d, float low_m, float high_m, float radius_m) {
    float k = radius_m / (high_m - low_m), kk = k * k, down = high_m - p.z;
    float a = dot(d.xy, d.xy) - kk * d.z * d.z, b = dot(p.xy, d.xy) + kk * down * d.z, c = dot(p.xy, p.xy) - kk * down * down;
    float best = no_hit, square = b * b - a * c;
    if (square > 0.0 && abs(a) > 1.0e-9) {
        float root = sqrt(square);
        for (int i = 0; i < 2; ++i) {
            float s = (-b + (i == 0 ? -root : root)) / a, z = p.z + s * d.z;
            if (z >= low_m && z <= high_m) best = min(best, s);
        }
    }
    if (d.z > 0.0) {
        float s = (low_m - p.z) / d.z;
        vec2 at = p.xy + s * d.xy;
        if (dot(at, at) <= radius_m * radius_m) best = min(best, s);
    }
    return best;
}
float enters_ellipsoid(vec3 p, vec3 d, float low_m, float high_m, float radius_m) {
    vec3 scale = 1.0 / vec3(radius_m, radius_m, 0.5 * (high_m - low_m)), from = (p - vec3(0.0, 0.0, 0.5 * (low_m + high_m))) * scale, along = d * scale;
    float a = dot(along, along), b = dot(from, along), c = dot(from, from) - 1.0, square = b * b - a * c;
    return square > 0.0 ? (-b - sqrt(square)) / a : no_hit;
}
float enters_stem(vec3 p, vec3 d, float high_m, float radius_m) {
    float a = dot(d.xy, d.xy), b = dot(p.xy, d.xy), c = dot(p.xy, p.xy) - radius_m * radius_m, square = b * b - a * c;
    if (square <= 0.0 || a <= 0.0) return no_hit;
    float s = (-b - sqrt(square)) / a, z = p.z + s * d.z;
    return z >= 0.0 && z <= high_m ? s : no_hit;
}

// How far out a place is in its crown: 0 at the stem, 1 on the cone or the ellipsoid around all of it.
float out_in_crown(Crown crown, vec3 at) {
    float length_m = crown.high_m - crown.low_m;
    if (crown.kind == site_needle) return crown.shell * length(at.xy) / max(crown.radius_m * (crown.high_m - at.z) / length_m, 0.05);
    return crown.shell * length((at - vec3(0.0, 0.0, 0.5 * (crown.low_m + crown.high_m))) / vec3(crown.radius_m, crown.radius_m, 0.5 * length_m));
}

// Negative among leaves: these reach out as far as noise says. Broad-leaved trees have bunches of bunches of them, needle trees branches
// that hang down. detail, leaves: 1 where bunches,
// and where leaves, are larger than pixels, 0 where they are not; the crown's mean size stays.
float outside_leaves(Crown crown, vec3 at, float detail, vec2 leaves) {
    float out_share = out_in_crown(crown, at);
    if (detail <= 0.0) return out_share - 0.9;
    // A tip that is finer than the steps of rays would be in pieces.
    if (crown.kind == site_needle && crown.shell > 1.0 && at.z > mix(crown.low_m, crown.high_m, 0.97)) return max(out_share, 0.5);
    // Small trees have small branches.
    at *= clamp(7.0 / (crown.high_m - crown.low_m), 1.0, 3.0);
    float reach;
    if (crown.kind == site_needle) {
        vec3 branch = vec3(at.xy * 1.1, (at.z + 0.6 * length(at.xy)) * 1.7);
        reach = 0.42 + 0.75 * leaf_noise(branch, crown.hash) + 0.3 * leaf_noise(branch * 3.3, crown.hash + 1u) - 0.1;
    } else {
        reach = 0.4 + 0.78 * leaf_noise(at * 0.62, crown.hash) + 0.36 * leaf_noise(at * 1.9, crown.hash + 1u) - 0.1;
    }
    if (leaves.x > 0.0) reach += leaves.x * 0.42 * (leaf_noise(at * 6.7, crown.hash + 2u) - 0.5);
    if (leaves.y > 0.0) reach += leaves.y * 0.3 * (leaf_noise(at * 19.0, crown.hash + 3u) - 0.5);
    return out_share - mix(0.9, reach, detail);
}

vec3 normal_of_crown(Crown crown, vec3 at, float detail, vec2 leaves) {
    float e = 0.12 + 0.3 * (1.0 - detail) - 0.08 * leaves.x - 0.025 * leaves.y, here = outside_leaves(crown, at, detail, leaves);
    vec3 change = vec3(outside_leaves(crown, at + vec3(e, 0.0, 0.0), detail, leaves), outside_leaves(crown, at + vec3(0.0, e, 0.0), detail, leaves),
                       outside_leaves(crown, at + vec3(0.0, 0.0, e), detail, leaves)) - here;
    return dot(change, change) > 0.0 ? normalize(change) : vec3(0.0, 0.0, 1.0);
}

float detail_at(float pixel_m) { return clamp(1.5 - 1.15 * pixel_m, 0.0, 1.0); }
// Of leaves, and of what of them is seen from near.
vec2 leaves_at(float pixel_m) { return clamp(vec2(1.4, 1.5) - vec2(18.0, 60.0) * pixel_m, 0.0, 1.0); }

const int crown_steps = 16, near_crown_steps = 22;
// A line from a place along a ray, both in view coordinates, from a depth on; what it meets beyond another depth, `most`, may be left out.
// pixel_m: what a pixel covers at the tree.
bool meets_crown(Crown crown, vec3 from, vec3 ray, float pixel_m, float least, float most, out CrownHit hit) {
    vec3 middle = crown.foot + 0.5 * crown.high_m * crown.axes[2] - from;
    float begin = dot(middle, ray) / dot(ray, ray);
    vec3 p = (ray * begin + (from - crown.foot)) * crown.axes, d = ray * crown.axes;
    float detail = detail_at(pixel_m), size = detail > 0.0 ? 1.0 : 0.9, best = no_hit;
    vec2 leaves = leaves_at(pixel_m);
    bool is_needle = crown.kind == site_needle, is_near = crown.shell > 1.0;
    int steps = is_near ? near_crown_steps : crown_steps;
    float s = is_needle ? enters_cone(p, d, crown.low_m, crown.high_m, crown.radius_m * size) : enters_ellipsoid(p, d, crown.low_m, crown.high_m, crown.radius_m);
    hit.is_stem = false;
    hit.inside = 0.0;
    if (begin + s > most) s = no_hit;
    if (s < no_hit && detail <= 0.0) best = s;
    if (detail > 0.0 && s < no_hit) s = max(s, least - begin);
    // Along the line through what is convex, until it is among leaves.
    float step_m = 0.5 * crown.radius_m / length(d), before = 1.0, last = s, per_m = 1.0 / (crown.high_m - crown.low_m);
    for (int i = 0; s < no_hit && detail > 0.0 && i < steps && begin + last <= most; ++i) {
        vec3 at = p + s * d;
        float outside = outside_leaves(crown, at, detail, leaves);
        if (outside < 0.0) {
            best = mix(last, s, clamp(before / max(before - outside, 1.0e-6), 0.0, 1.0));
            break;
        }
        if (i > 0 && (out_in_crown(crown, at) > 1.001 * crown.shell || at.z < crown.low_m || at.z > crown.high_m)) break;
        before = outside;
        last = s;
        // Towards a cone's tip steps are as small as it is there.
        s += step_m * clamp(outside, 0.12, 0.5) * (is_needle && is_near ? clamp((crown.high_m - at.z) * per_m, 0.04, 1.0) : 1.0);
    }
    if (pixel_m < stem_least_px_m) {
        float on_stem = enters_stem(p, d, stem_m(crown), stem_radius_m(crown));
        if (on_stem < best) {
            best = on_stem;
            hit.is_stem = true;
        }
    }
    if (best == no_hit) return false;
    hit.at = p + best * d;
    hit.inside = clamp((0.95 - out_in_crown(crown, hit.at)) / 0.55, 0.0, 1.0);
    hit.depth_m = begin + best;
    return true;
}
// Through a pixel. Leaves at the eye are met where rays begin, or less by what is rounded.
bool hits_crown(Crown crown, vec3 ray, float pixel_m, float most_m, out CrownHit hit) {
    const float rounded_m = 0.001;
    return meets_crown(crown, vec3(0.0), ray, pixel_m, ray_begin_m, most_m, hit) && hit.depth_m >= ray_begin_m - rounded_m;
}
