// Where on the picture a crown may be, by what is around it: ellipsoids of revolution, whose axis is the crown's. Needs growth.glsl.

// Half axes: across the crown's stem and along it. Discs and places are ellipsoids, too.
struct CrownPart {
    vec3 middle;  // view coordinates
    float across_m;
    float along_m;
};

// What rounding moves a ray, or a crown.
float rounded_at(Crown crown) { return 0.01 + 2.0e-6 * length(crown.foot); }

// Around all leaves.
CrownPart leaves_of(Crown crown) {
    float length_m = crown.high_m - crown.low_m, rounded_m = rounded_at(crown);
    // The least around a cone: its middle is a quarter of the way from the base to the tip.
    if (crown.kind == site_needle)
        return CrownPart(crown.foot + (crown.low_m + 0.25 * length_m) * crown.axes[2], 1.0607 * crown.radius_m + rounded_m, 0.75 * length_m + rounded_m);
    return CrownPart(crown.foot + 0.5 * (crown.low_m + crown.high_m) * crown.axes[2], crown.radius_m + rounded_m, 0.5 * length_m + rounded_m);
}

// What a crown is the convex hull of, or less than that: its stem goes up among its leaves.
const int crown_parts = 3;
CrownPart part_of(Crown crown, int number) {
    float rounded_m = rounded_at(crown);
    if (number == 0 && crown.kind != site_needle) return leaves_of(crown);
    if (number == 0) return CrownPart(crown.foot + crown.low_m * crown.axes[2], crown.radius_m + rounded_m, rounded_m);
    if (number == 1) return CrownPart(crown.foot + crown.high_m * crown.axes[2], rounded_m, rounded_m);
    return CrownPart(crown.foot, stem_radius_m(crown) + rounded_m, rounded_m);
}

// How far a part reaches from its middle along a direction, of its length.
float reach_along(CrownPart part, vec3 axis, vec3 direction) {
    float along = dot(axis, direction), across = max(dot(direction, direction) - along * along, 0.0);
    return sqrt(part.across_m * part.across_m * across + part.along_m * part.along_m * along * along);
}

// Metres before the eye where a crown begins, and where it ends.
vec2 depths_of(Crown crown) {
    vec2 depths = vec2(1.0e30, -1.0e30);
    for (int i = 0; i < crown_parts; ++i) {
        CrownPart part = part_of(crown, i);
        float reach_m = reach_along(part, crown.axes[2], vec3(0.0, 0.0, 1.0));
        depths = vec2(min(depths.x, -part.middle.z - reach_m), max(depths.y, -part.middle.z + reach_m));
    }
    return depths;
}

// Whether leaves may be where rays begin: then any pixel may show them, whichever way it looks. No leaves are farther out than this
// (outside_leaves() of crown.glsl).
const float outermost_leaves = 1.85;
bool is_at_eye(Crown crown) {
    vec2 slope = (1.0 + abs(FRAME.projection_shift)) / abs(FRAME.projection_scale);
    float begin_m = ray_begin_m * sqrt(1.0 + dot(slope, slope)) + 0.01, length_m = crown.high_m - crown.low_m, reach = outermost_leaves / crown.shell;
    vec3 eye = -crown.foot * crown.axes;
    if (crown.kind == site_needle)
        return length(eye.xy) - begin_m < reach * max(crown.radius_m * (crown.high_m - eye.z + begin_m) / length_m, 0.05);
    vec3 out_share = (eye - vec3(0.0, 0.0, 0.5 * (crown.low_m + crown.high_m))) / vec3(crown.radius_m, crown.radius_m, 0.5 * length_m);
    return length(out_share) < reach + begin_m / min(crown.radius_m, 0.5 * length_m);
}

// How far before the eye a crown's nearest leaves are.
float begins_before_eye(Crown crown) {
    const float least_m = 0.999 * ray_begin_m - 0.001;
    return is_at_eye(crown) ? least_m : max(depths_of(crown).x, least_m);
}

// Whether all of a crown lies beyond one side of the picture.
bool is_beyond_side(Crown crown) {
    bvec4 beyond = bvec4(true);
    for (int i = 0; i < crown_parts; ++i) {
        CrownPart part = part_of(crown, i);
        for (int side = 0; side < 4; ++side) {
            float sign = side < 2 ? 1.0 : -1.0;
            int axis = side % 2;
            vec3 out_of = vec3(0.0, 0.0, 1.0 - sign * FRAME.projection_shift[axis]);
            out_of[axis] = sign * FRAME.projection_scale[axis];
            beyond[side] = beyond[side] && dot(out_of, part.middle) > reach_along(part, crown.axes[2], out_of);
        }
    }
    return any(beyond);
}

// Least and largest slope, x or y over the depth, of a part that lies before the eye: where planes through the eye touch it.
vec2 slopes_of(CrownPart part, vec3 axis, int number) {
    float square = part.across_m * part.across_m, more = part.along_m * part.along_m - square, c = part.middle[number], z = part.middle.z;
    float own = square + more * axis[number] * axis[number], mixed = more * axis[number] * axis.z, deep = square + more * axis.z * axis.z;
    float root = sqrt(max(own * z * z - 2.0 * mixed * c * z + deep * c * c + mixed * mixed - own * deep, 0.0));
    return (mixed - c * z + vec2(-root, root)) / (z * z - deep);
}

// The pixels of the picture that may show a crown: an empty box where there are none; all where it is beside the eye.
ivec4 pixels_of_crown(Crown crown) {
    const ivec4 none = ivec4(0, 0, -1, -1);
    ivec2 end = ivec2(FRAME.width_px, FRAME.height_px);
    if (is_at_eye(crown)) return ivec4(ivec2(0), end - 1);
    vec2 depths = depths_of(crown);
    if (depths.y < 0.29 || is_beyond_side(crown)) return none;
    if (depths.x < ray_begin_m) return ivec4(ivec2(0), end - 1);
    vec2 low = vec2(1.0e30), high = vec2(-1.0e30);
    for (int i = 0; i < crown_parts; ++i) {
        CrownPart part = part_of(crown, i);
        for (int axis = 0; axis < 2; ++axis) {
            vec2 clip = slopes_of(part, crown.axes[2], axis) * FRAME.projection_scale[axis] + FRAME.projection_shift[axis];
            low[axis] = min(low[axis], min(clip.x, clip.y));
            high[axis] = max(high[axis], max(clip.x, clip.y));
        }
    }
    vec2 first = floor((low + 1.0) * 0.5 * vec2(end)), last = floor((high + 1.0) * 0.5 * vec2(end));
    ivec4 box = ivec4(ivec2(clamp(first, vec2(-1.0), vec2(end))), ivec2(clamp(last, vec2(-1.0), vec2(end))));
    return ivec4(max(box.xy, ivec2(0)), min(box.zw, end - 1));
}

// Through a place of the picture, in pixels.
vec3 ray_at(vec2 at) {
    vec2 clip = at * 2.0 / vec2(FRAME.width_px, FRAME.height_px) - 1.0;
    return vec3((clip - FRAME.projection_shift) / FRAME.projection_scale, -1.0);
}

// Whether rays between two corners of the picture may meet an ellipsoid: where that is a ball of radius 1, they lie in a cone.
bool may_meet(CrownPart part, mat3 axes, vec2 first, vec2 end) {
    vec3 scale = 1.0 / vec3(part.across_m, part.across_m, part.along_m), middle = part.middle * axes * scale;
    vec3 towards = normalize(ray_at(0.5 * (first + end)) * axes * scale);
    float sine = 0.0, least = 1.0;
    for (int i = 0; i < 4; ++i) {
        vec3 corner = normalize(ray_at(vec2(i % 2 == 0 ? first.x : end.x, i < 2 ? first.y : end.y)) * axes * scale);
        sine = max(sine, length(cross(towards, corner)));
        least = min(least, dot(towards, corner));
    }
    if (least < 0.2) return true;
    float cosine = sqrt(1.0 - sine * sine), along = dot(middle, towards), across = length(middle - along * towards);
    const float near = 1.0001;
    if (along * cosine + across * sine < 0.0) return dot(middle, middle) < near * near;
    return across * cosine - along * sine < near;
}

// ... or a stem: it lies beyond one of the planes through the eye and a side, or behind the eye, where they do not.
bool may_meet_stem(Crown crown, vec2 first, vec2 end) {
    vec3 foot = crown.foot, top = crown.foot + stem_m(crown) * crown.axes[2], one = ray_at(first), other = ray_at(end);
    float radius_m = stem_radius_m(crown) + rounded_at(crown);
    if (max(-foot.z, -top.z) + radius_m < 0.29) return false;
    vec2 low = min(one.xy, other.xy), high = max(one.xy, other.xy);
    bvec2 below = lessThan(max(foot.xy + low * foot.z, top.xy + low * top.z), -radius_m * sqrt(1.0 + low * low));
    bvec2 above = greaterThan(min(foot.xy + high * foot.z, top.xy + high * top.z), radius_m * sqrt(1.0 + high * high));
    return !any(below) && !any(above);
}

// Whether pixels of a box may show a crown.
bool may_show_crown(Crown crown, ivec4 box) {
    vec2 first = vec2(box.xy), end = vec2(box.zw + 1);
    if (may_meet(leaves_of(crown), crown.axes, first, end)) return true;
    if (pixel_m_at(crown.foot) < stem_least_px_m * 1.01 && may_meet_stem(crown, first, end)) return true;
    return is_at_eye(crown);
}
