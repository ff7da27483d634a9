// The air between the eye and what it sees, from a table for all lines of sight from the eye. Needs air.glsl and sky.glsl.
layout(buffer_reference, scalar, buffer_reference_align = 16) buffer AerialTable { uvec4 at[]; };

// Lines that meet this shell end there; it lies below all ground in the air.
const float air_floor_m = -500.0;

// A line of sight in the table: of those that meet the floor and of the others, its row; where it comes into the air, and how far it goes
// there.
struct AerialLine {
    float row;
    float column;
    float from_m;
    float length_m;
};

// Cosine and sine of the angle from the level down to the floor's horizon.
vec2 floor_dip(float radius_m, float h_m) {
    float r_m = radius_m + h_m;
    return vec2((radius_m + air_floor_m) / r_m, sqrt((h_m - air_floor_m) * (2.0 * radius_m + h_m + air_floor_m)) / r_m);
}
// The tangent of half the angle from there to straight down, and to straight up.
float half_down(vec2 dip) { return dip.x / (1.0 + dip.y); }
float half_up(vec2 dip) { return dip.x / max(1.0 - dip.y, 1.0e-6); }

void aerial_reach(AirRay ray, bool falls, out float from_m, out float length_m) {
    from_m = ray.h_m > air_top_m ? max(way_down_m(ray, air_top_m), 0.0) : 0.0;
    // A line that just touches the floor meets it, whatever rounding says.
    float r_m = ray.radius_m + ray.h_m, along = r_m * ray.rise, below = (ray.h_m - air_floor_m) * (2.0 * ray.radius_m + ray.h_m + air_floor_m);
    float to_m = falls ? below / (-along + sqrt(max(along * along - below, 0.0))) : way_out_m(ray, air_top_m);
    length_m = max(to_m - from_m, 1.0);
}

// Closest together at the floor's horizon, on both sides. Without arcs, whose precision Vulkan leaves open.
AerialLine aerial_line(AirRay ray) {
    vec2 dip = floor_dip(ray.radius_m, ray.h_m);
    float level = sqrt(max(1.0 - ray.rise * ray.rise, 0.0));
    float below = -(dip.y * level + dip.x * ray.rise), across = dip.x * level - dip.y * ray.rise;
    float half_angle = below / max(1.0 + across, 1.0e-6);
    bool falls = below > 0.0;
    float share;
    if (falls) {
        share = half_angle / half_down(dip);
    } else if (eye_above_air()) {
        float r_m = ray.radius_m + ray.h_m, passes_m = ray.h_m - r_m * ray.rise * ray.rise / (1.0 + level);
        share = (passes_m - air_floor_m) / (air_top_m - air_floor_m);
    } else {
        share = -half_angle / half_up(dip);
    }
    AerialLine line;
    line.row = sqrt(clamp(share, 0.0, 1.0)) * float(aerial_rises - 1u) + (falls ? 0.0 : float(aerial_rises));
    float sun_level = sqrt(max(1.0 - ray.sun_rise * ray.sun_rise, 0.0)), levels = level * sun_level;
    float turn = levels > 1.0e-6 ? clamp((ray.to_sun - ray.rise * ray.sun_rise) / levels, -1.0, 1.0) : 0.0;
    line.column = (0.5 + 0.5 * turn) * float(aerial_turns - 1u);
    aerial_reach(ray, falls, line.from_m, line.length_m);
    return line;
}

// The inverse, of a whole row and column.
AirRay aerial_ray(uint row, uint column) {
    float radius_m = FRAME.earth_radius_m, h_m = eye_in_air_m(), rise, level;
    float share = float(row % aerial_rises) / float(aerial_rises - 1u);
    share *= share;
    vec2 dip = floor_dip(radius_m, h_m);
    if (row >= aerial_rises && eye_above_air()) {
        float passes_m = mix(air_floor_m, air_top_m, min(share, last_share)), r_m = radius_m + h_m;
        rise = -sqrt((h_m - passes_m) * (2.0 * radius_m + h_m + passes_m)) / r_m;
        level = (radius_m + passes_m) / r_m;
    } else {
        float half_angle = row < aerial_rises ? share * half_down(dip) : -share * half_up(dip);
        float squared = half_angle * half_angle, below = 2.0 * half_angle / (1.0 + squared), across = (1.0 - squared) / (1.0 + squared);
        rise = -(dip.y * across + dip.x * below);
        level = dip.x * across - dip.y * below;
    }
    float sun_rise = FRAME.style.sun_enu.z, sun_level = sqrt(max(1.0 - sun_rise * sun_rise, 0.0));
    float turn = 2.0 * float(column) / float(aerial_turns - 1u) - 1.0;
    return AirRay(radius_m, h_m, rise, sun_rise, rise * sun_rise + level * sun_level * turn);
}

// Slices are thin at both ends, where the air is densest. The share of a line's way where a slice ends (x of 1), and the inverse.
float way_of_slice(float x) { return x < 0.5 ? 2.0 * x * x : 1.0 - 2.0 * (1.0 - x) * (1.0 - x); }
float slice_of_way(float share) { return share < 0.5 ? sqrt(0.5 * share) : 1.0 - sqrt(0.5 * (1.0 - share)); }

// An entry is light that comes to the eye but for what dust scatters, then that without the angle's share, then what is let through: six
// logarithms (at dusk light falls fast) in steps of 0.05 %, and three shares, in 16 bits each.
uint aerial_at(uint row, uint column, uint slice) { return aerial_first + 2u * ((row * aerial_turns + column) * aerial_slices + slice); }
const float aerial_log_step = (aerial_log_high - aerial_log_low) / 65535.0;
uint aerial_code(float value) { return uint(clamp((log(value) - aerial_log_low) / aerial_log_step + 0.5, 0.0, 65535.0)); }

// Two codes of a word, as 1 and the code's 65536th parts: without a conversion of integers, of which GPUs do few at a time.
float low_code(uint word) { return uintBitsToFloat((word << 7u & 0x7fff80u) | 0x3f800000u); }
float high_code(uint word) { return uintBitsToFloat((word >> 9u & 0x7fff80u) | 0x3f800000u); }
// The logarithm of such a number, or of a mean of several.
vec3 aerial_log(vec3 codes) { return codes * (65536.0 * aerial_log_step) + (aerial_log_low - 65536.0 * aerial_log_step); }

struct AerialEntry {
    vec3 light;
    vec3 dust;
    vec3 through;
};
void add_aerial(inout AerialEntry sum, AerialTable table, uint at, float share) {
    uvec4 first = table.at[at];
    uint last = table.at[at + 1u].x;
    sum.light += share * vec3(low_code(first.x), high_code(first.x), low_code(first.y));
    sum.dust += share * vec3(high_code(first.y), low_code(first.z), high_code(first.z));
    sum.through += share * vec3(low_code(first.w), high_code(first.w), low_code(last));
}
// Both ends of a slice.
void add_slice(inout AerialEntry near, inout AerialEntry far, AerialTable table, uint at, float share) {
    add_aerial(near, table, at, share);
    add_aerial(far, table, at + 2u, share);
}
// What comes to the eye of the air before a place, and what that lets through.
struct SeenAir {
    vec3 light;
    vec3 through;
};
SeenAir aerial_light(AirRay ray, float distance_m) {
    AerialLine line = aerial_line(ray);
    float share = clamp((distance_m - line.from_m) / line.length_m, 0.0, 1.0);
    if (share <= 0.0) return SeenAir(vec3(0.0), vec3(1.0));
    const float last = float(aerial_slices - 1u);
    uint slice = min(whole_number(floor(slice_of_way(share) * last)), aerial_slices - 2u);
    float number = as_float(slice), low = way_of_slice(number / last), high = way_of_slice((number + 1.0) / last);
    float on = clamp((share - low) / (high - low), 0.0, 1.0);
    uint first_row = line.row < float(aerial_rises) ? 0u : aerial_rises;
    uint row = min(whole_number(floor(line.row)) - first_row, aerial_rises - 2u) + first_row;
    uint column = min(whole_number(floor(line.column)), aerial_turns - 2u);
    vec2 part = vec2(line.row, line.column) - as_floats(uvec2(row, column));
    AerialEntry near = AerialEntry(vec3(0.0), vec3(0.0), vec3(0.0)), far = near;
    AerialTable table = AerialTable(FRAME.air);
    // No loop: a driver that leaves it one rounds other sums than one that unrolls it.
    add_slice(near, far, table, aerial_at(row, column, slice), (1.0 - part.x) * (1.0 - part.y));
    add_slice(near, far, table, aerial_at(row, column + 1u, slice), (1.0 - part.x) * part.y);
    add_slice(near, far, table, aerial_at(row + 1u, column, slice), part.x * (1.0 - part.y));
    add_slice(near, far, table, aerial_at(row + 1u, column + 1u, slice), part.x * part.y);
    // Within a slice as in even air: light comes to the eye as the air lets it through.
    vec3 through = (near.through - 1.0) * (65536.0 / 65535.0);
    vec3 let = clamp((far.through - 1.0) / max(near.through - 1.0, vec3(1.0e-30)), vec3(1.0e-6), vec3(1.0));
    vec3 here = exp(log(let) * on), come = mix((1.0 - here) / max(1.0 - let, vec3(1.0e-6)), vec3(on), greaterThan(let, vec3(0.999)));
    float by_dust = dust_towards(ray.to_sun);
    vec3 light = exp(aerial_log(near.light)) + by_dust * exp(aerial_log(near.dust));
    vec3 beyond = exp(aerial_log(far.light)) + by_dust * exp(aerial_log(far.dust));
    return SeenAir(mix(light, beyond, come), through * here);
}

// The light of the sun and of the sky at a place, which together cost as much as one of them: FrameStyle.air alone decides this table.
struct PlaceLight {
    vec3 from_sun;
    vec3 from_sky;
};
vec2 lit_place(float h_m, float sun_rise) { return light_place_of(h_m, sun_rise, vec2(lit_heights - 1u, lit_suns - 1u)); }
PlaceLight light_at(float h_m, float sun_rise) {
    vec2 at = clamp(lit_place(h_m, sun_rise), vec2(0.0), vec2(lit_heights - 1u, lit_suns - 1u));
    uvec2 low = min(whole_numbers(floor(at)), uvec2(lit_heights, lit_suns) - 2u);
    vec2 part = at - as_floats(low);
    AerialTable table = AerialTable(FRAME.air);
    vec3 sun = vec3(0.0), sky = vec3(0.0);
    for (uint k = 0u; k < 4u; ++k) {
        uvec4 codes = table.at[lit_first + (low.x + k / 2u) * lit_suns + low.y + k % 2u];
        float weight = (k / 2u == 1u ? part.x : 1.0 - part.x) * (k % 2u == 1u ? part.y : 1.0 - part.y);
        sun += weight * vec3(low_code(codes.x), high_code(codes.x), low_code(codes.y));
        sky += weight * vec3(high_code(codes.y), low_code(codes.z), high_code(codes.z));
    }
    return PlaceLight(exp(aerial_log(sun)) * sun_shown(h_m, sun_rise), exp(aerial_log(sky)));
}
